// Frames of fe_node's fields as the report reads them.
#include "recorder/field_frame.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/error.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;

class FieldFrameFile : public testing::Test {
 protected:
  FieldFrameFile() { fs::create_directories(folder_); }
  ~FieldFrameFile() override { fs::remove_all(folder_); }

  template <typename Number, std::size_t N>
  void add(const std::string& name, const std::string& type, const std::array<Number, N>& values) {
    head_ += fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                         type, name, data_.size());
    const std::uint64_t bytes = sizeof values;
    data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data_.append(reinterpret_cast<const char*>(values.data()), sizeof values);
  }

  /// A tetrahedron of part 7 about (1, 2, 3) and one of part 8, with strains 0.25 and 0.5.
  fs::path write(std::size_t cut = 0) {
    add("Points", "Float32", std::array<float, 12>{0, 2, 3, 2, 2, 3, 1, 1, 2, 1, 3, 4});
    add("connectivity", "Int32", std::array<std::int32_t, 8>{0, 1, 2, 3, 3, 2, 1, 0});
    add("offsets", "Int32", std::array<std::int32_t, 2>{4, 8});
    add("part", "Int32", std::array<std::int32_t, 2>{7, 8});
    add("principal_strain", "Float32", std::array<float, 2>{0.25F, 0.5F});
    std::ofstream(folder_ / "frame_0000.vtu", std::ios::binary)
        << head_ << "<AppendedData encoding=\"raw\">\n_" << data_.substr(0, data_.size() - cut);
    std::ofstream(folder_ / "fields.pvd")
        << "<DataSet timestep=\"0.0100\" file=\"frame_0000.vtu\"/>\n"
        << "<DataSet timestep=\"0.0110\" file=\"frame_0001.vtu\"/>\n";
    return folder_ / "frame_0000.vtu";
  }

  fs::path folder_ = fs::temp_directory_path() / "cw_field_frame";
  std::string head_, data_;
};

TEST_F(FieldFrameFile, GivesCentroidsInHeadAxesOfTheWantedParts) {
  Pose X_WH;
  X_WH.p = Vec3(1, 1, 1);
  X_WH.q = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  const StrainMap map = read_strain_map(write(), {7}, X_WH);
  ASSERT_EQ(map.centroids.size(), 1U);
  EXPECT_LT((map.centroids[0] - Vec3(1, 0, 2)).norm(), 1e-6);  // (0, 1, 2) of W turned back
  EXPECT_EQ(map.strain[0], 0.25);
}

TEST_F(FieldFrameFile, NearestIsWithinReachAndExists) {
  write();
  const auto frame = nearest_frame(folder_, 0.0102, 1e-3);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->file.filename(), "frame_0000.vtu");
  EXPECT_FALSE(nearest_frame(folder_, 0.0112, 1e-3));  // listed, but the file is missing
  EXPECT_FALSE(nearest_frame(folder_, 0.2, 1e-3));
  EXPECT_FALSE(nearest_frame("/nowhere", 0.01, 1e-3));
}

TEST_F(FieldFrameFile, DamagedFilesAreRefused) {
  EXPECT_THROW(read_strain_map(write(4), {7}, Pose()), UserError);
  std::ofstream(folder_ / "text.vtu") << "no frame";
  EXPECT_THROW(read_strain_map(folder_ / "text.vtu", {7}, Pose()), UserError);
}

}  // namespace
}  // namespace crosswalk::recording
