// Everything CMake looks for comes from a package of cmake/debian-packages.txt.
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"
#include "tests/source_folder.h"

namespace crosswalk::architecture {
namespace {

namespace fs = std::filesystem;

// What find_package, find_library, find_program and find_file are asked for -> Debian package. An
// empty one is optional or comes with another.
const std::map<std::string, std::string> kPackageOf = {
    {"Eigen3", "libeigen3-dev"},
    {"fmt", "libfmt-dev"},
    {"spdlog", "libspdlog-dev"},
    {"tomlplusplus", "libtomlplusplus-dev"},
    {"CLI11", "libcli11-dev"},
    {"nlohmann_json", "nlohmann-json3-dev"},
    {"SUNDIALS", "libsundials-dev"},
    {"OpenMP", "g++"},
    {"Threads", "g++"},
    {"GTest", "libgtest-dev"},
    {"benchmark", "libbenchmark-dev"},
    {"Python3", "python3"},
    {"nanoflann", "libnanoflann-dev"},
    {"ZLIB", "zlib1g-dev"},
    {"ccd", "libccd-dev"},
    {"LCM_INCLUDE_DIR", "liblcm-dev"},
    {"LCM_LIBRARY", "liblcm-dev"},
    {"LCM_GEN", "liblcm-bin"},
    {"LCM_JAR", "liblcm-java"},
    {"ODE_INCLUDE_DIR", "libode-dev"},
    {"ODE_LIBRARY", "libode-dev"},
    {"JAVAC", "default-jdk"},
    {"JAR", "default-jdk"},
    {"MUSTACHE_INCLUDE_DIR", "libkainjow-mustache-dev"},
    {"HTTPLIB_INCLUDE_DIR", "libcpp-httplib-dev"},
    {"HTTPLIB_LIBRARY", "libcpp-httplib-dev"},
    {"NPM", ""},
    {"Simbody", ""},  // oracle of the multibody tests
    {"CHROMIUM", ""},
    {"NODE", ""},
    {"CCACHE", ""}};

std::set<std::string> listed_packages() {
  std::set<std::string> packages;
  for (std::string line : lines_of(source_folder() / "cmake/debian-packages.txt")) {
    line = line.substr(0, line.find('#'));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (!line.empty()) packages.insert(line);
  }
  return packages;
}

TEST(DebianPackages, CoverEverythingCMakeLooksFor) {
  static const std::regex find(
      R"(find_(?:package|library|program|path|file)\s*\(\s*([A-Za-z0-9_]+))");
  const std::set<std::string> listed = listed_packages();
  const fs::path root = source_folder();
  std::vector<fs::path> files = {"CMakeLists.txt"};
  for (const std::string folder : {"cmake", "lcmtypes", "common", "mb_node", "fe_node", "coupler",
                                   "recorder", "launcher", "tests", "bench"})
    for (const fs::path& file : files_under(folder, {".txt", ".cmake"})) files.push_back(file);
  int count = 0;
  for (const fs::path& file : files) {
    const std::string text = text_of(root / file);
    for (std::sregex_iterator match(text.begin(), text.end(), find), end; match != end; ++match) {
      const std::string name = (*match)[1].str();
      ++count;
      const auto known = kPackageOf.find(name);
      if (known == kPackageOf.end()) {
        ADD_FAILURE() << file.string() << " looks for " << name << ": name its Debian package here";
        continue;
      }
      EXPECT_TRUE(known->second.empty() || listed.contains(known->second))
          << file.string() << " looks for " << name << ", but " << known->second
          << " is not in cmake/debian-packages.txt";
    }
  }
  EXPECT_GT(count, 10);
}

TEST(DebianPackages, HoldTheToolsTheBootstrapCalls) {
  const std::set<std::string> listed = listed_packages();
  for (const char* package : {"cmake", "ninja-build", "g++", "git"})
    EXPECT_TRUE(listed.contains(package)) << package;
}

}  // namespace
}  // namespace crosswalk::architecture
