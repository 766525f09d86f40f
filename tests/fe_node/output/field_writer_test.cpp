// Field files read back: what stands in them is the state that was written.
#include "fe_node/output/field_writer.h"

#include <cstring>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/error.h"
#include "tests/fe_node/output/stretched_box.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The arrays of a .vtu with raw appended data, by name.
class VtuFile {
 public:
  explicit VtuFile(const fs::path& file) : bytes_(bytes_of(file)) {
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t at = bytes_.find(mark);
    EXPECT_NE(at, std::string::npos);
    data_ = at + mark.size();
    EXPECT_THAT(bytes_, testing::EndsWith("\n</AppendedData>\n</VTKFile>\n"));
  }
  std::string attribute(const std::string& element, const std::string& name) const {
    const std::size_t tag = bytes_.find(element);
    const std::size_t begin = bytes_.find(" " + name + "=\"", tag) + name.size() + 3;
    return bytes_.substr(begin, bytes_.find('"', begin) - begin);
  }
  template <class T>
  std::vector<T> array(const std::string& name) const {
    const std::size_t named = bytes_.find("Name=\"" + name + "\"");
    EXPECT_LT(named, data_) << name;
    const std::size_t offset = data_ + std::stoul(attribute("Name=\"" + name + "\"", "offset"));
    std::uint64_t size = 0;
    std::memcpy(&size, bytes_.data() + offset, sizeof size);
    EXPECT_LE(offset + sizeof size + size, bytes_.size());
    std::vector<T> values(size / sizeof(T));
    std::memcpy(values.data(), bytes_.data() + offset + sizeof size, size);
    return values;
  }

 private:
  std::string bytes_;
  std::size_t data_ = 0;
};

class FieldWriterTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cw_fields_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

Model elastic_box() {
  Model model = box_model({2, 1, 1, {2, 1, 1}}, Elastic::from_bulk(1000, 2e5, 1e4));
  model.mesh.parts[0].id = DeckId(77);
  model.finish();
  return model;
}

TEST_F(FieldWriterTest, AFrameHoldsTheStateThatWasWritten) {
  const Model model = elastic_box();
  const double a = 1.25;
  State state = deformed_state(model, stretch(a, 1, 1));
  for (int n = 0; n < model.mesh.node_count(); ++n)
    state.nodes[n].set_velocity({1.0 * n, -2.0, 0.5});
  FieldWriter writer(model, folder_);
  const VtuFile file(folder_ / writer.write(state));
  EXPECT_EQ(file.attribute("<VTKFile", "type"), "UnstructuredGrid");
  EXPECT_EQ(file.attribute("<Piece", "NumberOfPoints"), "12");
  EXPECT_EQ(file.attribute("<Piece", "NumberOfCells"), "2");

  const auto points = file.array<float>("Points"), velocity = file.array<float>("velocity_m_s");
  ASSERT_EQ(points.size(), 36U);
  ASSERT_EQ(velocity.size(), 36U);
  for (int n = 0; n < 12; ++n)
    for (int i = 0; i < 3; ++i) {
      EXPECT_FLOAT_EQ(points[3 * n + i], static_cast<float>(state.nodes[n].position()[i]));
      EXPECT_FLOAT_EQ(velocity[3 * n + i], static_cast<float>(state.nodes[n].velocity()[i]));
    }
  EXPECT_EQ(file.array<std::int32_t>("connectivity"), model.mesh.table(ElementKind::Hex8).nodes);
  EXPECT_EQ(file.array<std::int32_t>("offsets"), (std::vector<std::int32_t>{8, 16}));
  EXPECT_EQ(file.array<std::uint8_t>("types"), (std::vector<std::uint8_t>{12, 12}));
  EXPECT_EQ(file.array<std::int32_t>("part"), (std::vector<std::int32_t>{77, 77}));

  // Stress of the law under F = diag(a, 1, 1)
  const Elastic law = Elastic::from_bulk(1000, 2e5, 1e4);
  const double side = law.lambda * (a - 1), along = side + law.mu * (a * a - 1) / a;
  for (const float p : file.array<float>("pressure_Pa"))
    EXPECT_NEAR(p, -(along + 2 * side) / 3, 1e-5 * side);
  for (const float s : file.array<float>("von_mises_Pa")) EXPECT_NEAR(s, along - side, 1e-5 * side);
  for (const float e : file.array<float>("principal_strain"))
    EXPECT_NEAR(e, 0.5 * (a * a - 1), 1e-6);
  EXPECT_EQ(file.array<float>("plastic_strain"), (std::vector<float>{0, 0}));
}

TEST_F(FieldWriterTest, TheCollectionListsEveryFrameWithItsTime) {
  const Model model = elastic_box();
  State state = initial_state(model);
  FieldWriter writer(model, folder_);
  for (const double time : {0.0, 0.0005, 0.001}) {
    state.time = time;
    writer.write(state);
  }
  EXPECT_EQ(bytes_of(folder_ / "fields.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n"
            "<DataSet timestep=\"0\" file=\"frame_0000.vtu\"/>\n"
            "<DataSet timestep=\"0.0005\" file=\"frame_0001.vtu\"/>\n"
            "<DataSet timestep=\"0.001\" file=\"frame_0002.vtu\"/>\n"
            "</Collection>\n</VTKFile>\n");
  for (const char* name : {"frame_0000.vtu", "frame_0001.vtu", "frame_0002.vtu"})
    EXPECT_EQ(VtuFile(folder_ / name).array<float>("Points").size(), 36U);
}

TEST_F(FieldWriterTest, RigidPartsAreDrawnWithoutStress) {
  Model model;
  model.mesh = box_mesh({1, 1, 1});
  model.mesh.parts[0].is_rigid = true;
  model.finish();
  FieldWriter writer(model, folder_);
  const VtuFile file(folder_ / writer.write(initial_state(model)));
  EXPECT_EQ(file.array<float>("von_mises_Pa"), std::vector<float>{0});
  EXPECT_EQ(file.array<std::uint8_t>("types"), std::vector<std::uint8_t>{12});
}

TEST_F(FieldWriterTest, AFolderThatCannotBeMadeIsAUserError) {
  const Model model = elastic_box();
  std::ofstream(folder_) << "a file stands in the way";
  EXPECT_THROW(FieldWriter(model, folder_ / "fields"), UserError);
}

}  // namespace
}  // namespace crosswalk::fe
