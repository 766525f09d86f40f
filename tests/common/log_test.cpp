#include "common/log.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace crosswalk {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Log, LineCarriesSimulatedTimeNodeAndLevel) {
  const auto file = std::filesystem::path(testing::TempDir()) /
                    ("log_test_" + std::to_string(getpid())) / "fe_node.log";
  open_log("fe_node", file);
  set_log_time(0.023418);
  log_warning("added mass {:.1f} %", 1.25);
  log_debug("not at this level");
  flush_log();
  EXPECT_EQ(content(file), "[   23.418] [fe_node] warning added mass 1.2 %\n");
  set_log_time(0);
  std::filesystem::remove_all(file.parent_path());
}

TEST(Log, FirstTimeIsTruePerKeyOnce) {
  EXPECT_TRUE(first_time("log_test a"));
  EXPECT_FALSE(first_time("log_test a"));
  EXPECT_TRUE(first_time("log_test b"));
}

}  // namespace
}  // namespace crosswalk
