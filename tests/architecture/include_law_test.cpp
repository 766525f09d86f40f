// lcmtypes <- common <- {mb_node, fe_node, coupler, recorder, launcher}; nodes never include one
// another. Inside fe_node lower layers never include higher ones. Each third-party interface that a
// module hides is included in that module alone.
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"
#include "tests/source_folder.h"

namespace crosswalk::architecture {
namespace {

namespace fs = std::filesystem;

struct Include {
  fs::path from;
  int line;
  std::string what;  ///< between the quotes or brackets
};

std::vector<Include> includes_of(const std::string& folder) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const fs::path& file : files_under(folder, {".h", ".cpp"})) {
    const auto lines = lines_of(source_folder() / file);
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (std::smatch match; std::regex_search(lines[i], match, pattern))
        includes.push_back({file, static_cast<int>(i) + 1, match[1].str()});
  }
  return includes;
}

const std::vector<std::string> kFolders = {"common",  "mb_node",  "fe_node",
                                           "coupler", "recorder", "launcher"};

std::string first_part(const fs::path& path) { return path.begin()->string(); }

TEST(IncludeLaw, NodesIncludeCommonAndThemselvesOnly) {
  for (const std::string& folder : kFolders)
    for (const Include& include : includes_of(folder)) {
      const std::string target = first_part(include.what);
      if (std::find(kFolders.begin(), kFolders.end(), target) == kFolders.end()) continue;
      EXPECT_TRUE(target == folder || target == "common")
          << include.from.string() << ":" << include.line << " includes " << include.what;
    }
}

/// Layer of a file of fe_node; higher may include lower and equal.
int fe_layer(const fs::path& file) {
  static const std::map<std::string, int> layers = {
      {"mesh", 0},           {"material", 0},         {"deck", 0},          {"element", 1},
      {"generate", 1},       {"contact", 2},          {"constraint", 2},    {"model", 3},
      {"state", 3},          {"energy", 3},           {"force_tiles", 3},   {"guided_body", 3},
      {"sleeper", 3},        {"history_requests", 3}, {"stable_step", 3},   {"solver", 4},
      {"element_forces", 4}, {"explosion", 4},        {"model_builder", 4}, {"boundary", 5},
      {"output", 5}};
  const fs::path inside = file.lexically_relative("fe_node");
  const std::string part = inside.has_parent_path() ? first_part(inside) : inside.stem().string();
  const auto found = layers.find(part);
  return found == layers.end() ? 6 : found->second;  // fe_node itself, main, commands
}

TEST(IncludeLaw, LowerLayersOfFeNodeDoNotIncludeHigherOnes) {
  for (const Include& include : includes_of("fe_node")) {
    if (first_part(include.what) != "fe_node") continue;
    EXPECT_LE(fe_layer(include.what), fe_layer(include.from))
        << include.from.string() << ":" << include.line << " includes " << include.what;
  }
}

TEST(IncludeLaw, HiddenInterfacesAreIncludedInOneModule) {
  // Header (its beginning) -> files that may include it.
  const std::map<std::string, std::vector<std::string>> owners = {
      {"ode/", {"mb_node/ode_world.cpp"}},
      {"lcm/lcm-cpp.hpp", {"common/lcm_transport.cpp"}},
      {"toml++/", {"common/config_tree.cpp"}},
      {"spdlog/sinks/", {"common/log.cpp"}}};
  for (const std::string& folder : kFolders)
    for (const Include& include : includes_of(folder))
      for (const auto& [header, files] : owners) {
        if (!include.what.starts_with(header)) continue;
        EXPECT_TRUE(std::find(files.begin(), files.end(), include.from.string()) != files.end())
            << include.from.string() << ":" << include.line << " includes " << include.what;
      }
}

}  // namespace
}  // namespace crosswalk::architecture
