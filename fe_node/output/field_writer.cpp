#include "fe_node/output/field_writer.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "common/error.h"
#include "fe_node/output/tissue_metrics.h"

namespace crosswalk::fe {
namespace {

/// VTK cell types.
std::uint8_t cell_type(ElementKind kind) {
  switch (kind) {
    case ElementKind::Hex8:
      return 12;
    case ElementKind::Tet4:
      return 10;
    case ElementKind::Tet10:
      return 24;
    case ElementKind::Quad4:
      return 9;
    case ElementKind::Tri3:
      return 5;
    case ElementKind::Line2:
      return 3;
  }
  return 0;
}

/// Arrays of one file, appended raw; each is preceded by its length in bytes (UInt64).
class Appended {
 public:
  template <class T>
  std::string array(const std::string& name, const char* type, int components,
                    const std::vector<T>& values) {
    const std::size_t offset = bytes_.size();
    const std::uint64_t size = values.size() * sizeof(T);
    append(&size, sizeof size);
    append(values.data(), size);
    return fmt::format(
        R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)"
        "\n",
        type, name, components, offset);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

struct CellFields {
  std::vector<float> pressure, von_mises, strain, plastic_strain;
};

struct Cells {
  std::vector<std::int32_t> connectivity, offsets, part;
  std::vector<std::uint8_t> types;
  std::array<int, kElementKinds.size()> first{};  ///< cell of element 0 of each kind
};

Cells cells_of(const Mesh& mesh) {
  Cells cells;
  for (ElementKind kind : kElementKinds) {
    cells.first[static_cast<std::size_t>(kind)] = static_cast<int>(cells.types.size());
    const ElementTable& table = mesh.table(kind);
    cells.connectivity.insert(cells.connectivity.end(), table.nodes.begin(), table.nodes.end());
    for (int e = 0; e < table.size(); ++e) {
      cells.offsets.push_back((cells.offsets.empty() ? 0 : cells.offsets.back()) +
                              corner_count(kind));
      cells.types.push_back(cell_type(kind));
      cells.part.push_back(mesh.parts[table.part[e]].id.value);
    }
  }
  return cells;
}

CellFields sample_cells(const Model& model, const State& state, const Cells& cells) {
  CellFields fields;
  for (std::vector<float>* field :
       {&fields.pressure, &fields.von_mises, &fields.strain, &fields.plastic_strain})
    field->assign(cells.types.size(), 0.0F);
  const StepContext context{state.nodes, state.spin, state.time, 0, false};
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const ElementBlock& block = *model.blocks[b];
    if (block.kind() == ElementKind::Line2) continue;
    for (int e = 0; e < block.element_count(); ++e) {
      const ElementSample s = block.sample(context, state.history[b], e);
      const std::size_t cell =
          cells.first[static_cast<std::size_t>(block.kind())] + block.mesh_element(e);
      const Mat3 deviator = s.stress - s.stress.trace() / 3 * Mat3::Identity();
      fields.pressure[cell] = static_cast<float>(-s.stress.trace() / 3);
      fields.von_mises[cell] = static_cast<float>(std::sqrt(1.5) * deviator.norm());
      fields.strain[cell] = static_cast<float>(first_principal_strain(s.deformation));
      fields.plastic_strain[cell] = static_cast<float>(s.plastic_strain);
    }
  }
  return fields;
}

void require_written(const std::ofstream& file, const std::filesystem::path& path) {
  if (!file)
    throw UserError(
        Problem{{path.string()}, "field file", "room and permission to write", "neither", {}});
}

}  // namespace

FieldWriter::FieldWriter(const Model& model, std::filesystem::path folder)
    : model_(model), folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw UserError(Problem{
        {folder_.string()}, "folder of the fields", "one that can be made", error.message(), {}});
}

std::filesystem::path FieldWriter::write(const State& state) {
  const Cells cells = cells_of(model_.mesh);
  const CellFields fields = sample_cells(model_, state, cells);
  std::vector<float> points, velocity;
  for (const NodeRecord& node : state.nodes)
    for (int i = 0; i < 3; ++i) {
      points.push_back(static_cast<float>(node.x[i]));
      velocity.push_back(static_cast<float>(node.v[i]));
    }

  Appended data;
  std::string head = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
      state.nodes.size(), cells.types.size());
  head += data.array("Points", "Float32", 3, points);
  head += "</Points>\n<Cells>\n";
  head += data.array("connectivity", "Int32", 1, cells.connectivity);
  head += data.array("offsets", "Int32", 1, cells.offsets);
  head += data.array("types", "UInt8", 1, cells.types);
  head += "</Cells>\n<PointData>\n";
  head += data.array("velocity_m_s", "Float32", 3, velocity);
  head += "</PointData>\n<CellData>\n";
  head += data.array("part", "Int32", 1, cells.part);
  head += data.array("pressure_Pa", "Float32", 1, fields.pressure);
  head += data.array("von_mises_Pa", "Float32", 1, fields.von_mises);
  head += data.array("principal_strain", "Float32", 1, fields.strain);
  head += data.array("plastic_strain", "Float32", 1, fields.plastic_strain);
  head += "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

  const std::string name = fmt::format("frame_{:04}.vtu", frames_.size());
  std::ofstream file(folder_ / name, std::ios::binary);
  file << head << data.bytes() << "\n</AppendedData>\n</VTKFile>\n";
  file.close();
  require_written(file, folder_ / name);

  frames_.push_back({state.time, name});
  std::ofstream index(folder_ / "fields.pvd");
  index << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const Frame& frame : frames_)
    fmt::print(index, "<DataSet timestep=\"{:.9g}\" file=\"{}\"/>\n", frame.time, frame.file);
  index << "</Collection>\n</VTKFile>\n";
  index.close();
  require_written(index, folder_ / "fields.pvd");
  return name;
}

void FieldWriter::continue_after(double time) {
  constexpr double kRounding = 1e-9;  // s; times in the index have nine digits
  frames_.clear();
  std::ifstream index(folder_ / "fields.pvd");
  for (std::string line; std::getline(index, line);) {
    Frame frame{};
    char name[32] = {};
    if (std::sscanf(line.c_str(), "<DataSet timestep=\"%lf\" file=\"%31[^\"]", &frame.time, name) ==
            2 &&
        frame.time < time + kRounding) {
      frame.file = name;
      frames_.push_back(frame);
    }
  }
}

}  // namespace crosswalk::fe
