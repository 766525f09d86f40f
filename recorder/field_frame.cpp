#include "recorder/field_frame.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "common/error.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& found) {
  throw UserError(Problem{{file.string()}, "field frame", "a .vtu of fe_node", found, {}});
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The arrays of a .vtu: offsets from its head, bytes behind the underscore.
class AppendedArrays {
 public:
  explicit AppendedArrays(const fs::path& file) : file_(file), text_(text_of(file)) {
    constexpr std::string_view kMark = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t mark = text_.find(kMark);
    if (mark == std::string::npos) fail(file_, "no raw appended data");
    head_ = text_.substr(0, mark);
    data_ = mark + kMark.size();
  }

  /// Throws when the array is absent, of another type or longer than the file.
  template <typename Number>
  std::vector<Number> array(const std::string& name, const std::string& type) const {
    const std::regex pattern("<DataArray type=\"(\\w+)\" Name=\"" + name +
                             "\"[^>]* offset=\"(\\d+)\"/>");
    std::smatch found;
    if (!std::regex_search(head_, found, pattern) || found[1] != type)
      fail(file_, "no array " + name + " of " + type);
    const std::size_t at = data_ + std::stoull(found[2]);
    std::uint64_t bytes = 0;
    if (at + sizeof bytes > text_.size()) fail(file_, "an end before array " + name);
    std::memcpy(&bytes, text_.data() + at, sizeof bytes);
    if (bytes > text_.size() - at - sizeof bytes) fail(file_, "an end inside array " + name);
    std::vector<Number> out(bytes / sizeof(Number));
    std::memcpy(out.data(), text_.data() + at + sizeof bytes, out.size() * sizeof(Number));
    return out;
  }

 private:
  fs::path file_;
  std::string text_, head_;
  std::size_t data_ = 0;
};

}  // namespace

std::optional<FieldFrame> nearest_frame(const fs::path& fields, double t, double reach) {
  const std::string list = text_of(fields / "fields.pvd");
  static const std::regex kEntry("timestep=\"([^\"]+)\" file=\"([^\"/]+)\"");
  std::optional<FieldFrame> best;
  for (std::sregex_iterator it(list.begin(), list.end(), kEntry), end; it != end; ++it) {
    const double time = std::strtod((*it)[1].str().c_str(), nullptr);
    if (std::abs(time - t) > reach || (best && std::abs(time - t) >= std::abs(best->t - t)))
      continue;
    best = FieldFrame{time, fields / (*it)[2].str()};
  }
  if (best && !fs::exists(best->file)) return std::nullopt;
  return best;
}

StrainMap read_strain_map(const fs::path& vtu, const std::set<int>& parts, const Pose& X_WH) {
  const AppendedArrays arrays(vtu);
  const auto points = arrays.array<float>("Points", "Float32");
  const auto corners = arrays.array<std::int32_t>("connectivity", "Int32");
  const auto ends = arrays.array<std::int32_t>("offsets", "Int32");
  const auto part = arrays.array<std::int32_t>("part", "Int32");
  const auto strain = arrays.array<float>("principal_strain", "Float32");
  if (part.size() != ends.size() || strain.size() != ends.size())
    fail(vtu, "arrays of different length");
  const Pose X_HW = X_WH.inverse();
  StrainMap map;
  for (std::size_t cell = 0; cell < ends.size(); ++cell) {
    const int begin = cell == 0 ? 0 : ends[cell - 1];
    const int end = ends[cell];
    if (!parts.contains(part[cell]) || begin >= end) continue;
    if (static_cast<std::size_t>(end) > corners.size()) fail(vtu, "a cell without its corners");
    Vec3 centroid = Vec3::Zero();
    for (int k = begin; k < end; ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(corners[k]);
      if (corners[k] < 0 || at + 2 >= points.size()) fail(vtu, "a corner that is no point");
      centroid += Vec3(points[at], points[at + 1], points[at + 2]);
    }
    map.centroids.push_back(X_HW * (centroid / (end - begin)));
    map.strain.push_back(strain[cell]);
  }
  return map;
}

}  // namespace crosswalk::recording
