// Every source cited in code or data as [key] or [key, table] stands in docs/references.md.
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"
#include "tests/source_folder.h"

namespace crosswalk::architecture {
namespace {

namespace fs = std::filesystem;

/// Keys end in a year or a standard's number: yu2020, iso9790, sae-j1460. Several may stand in one
/// pair of brackets: [gehre2009; newman2000].
std::set<std::string> keys_in(const std::string& comment) {
  static const std::regex bracket(R"(\[([^\[\]]*)\])");
  static const std::regex key(R"((?:^|[,;] ?)([a-z][a-z-]*[0-9]{4}[a-z]?)(?=$|[,; ]))");
  std::set<std::string> keys;
  for (std::sregex_iterator b(comment.begin(), comment.end(), bracket), end; b != end; ++b) {
    const std::string inside = (*b)[1].str();
    for (std::sregex_iterator k(inside.begin(), inside.end(), key); k != end; ++k)
      keys.insert((*k)[1].str());
  }
  return keys;
}

TEST(References, EveryCitedKeyStandsInTheList) {
  const fs::path root = source_folder();
  const std::string list = text_of(root / "docs/references.md");
  std::map<std::string, std::string> missing;  // key -> where it is cited
  for (const std::string folder : {"common", "mb_node", "fe_node", "coupler", "recorder",
                                   "launcher", "scenarios", "tests", "bench"})
    for (const fs::path& file : files_under(folder, {".h", ".cpp", ".toml"})) {
      const std::string mark = file.extension() == ".toml" ? "#" : "//";
      int number = 0;
      for (const std::string& line : lines_of(root / file)) {
        ++number;
        const std::size_t begin = line.find(mark);
        if (begin == std::string::npos) continue;
        for (const std::string& key : keys_in(line.substr(begin)))
          if (list.find("**" + key + "**") == std::string::npos)
            missing.emplace(key, file.string() + ":" + std::to_string(number));
      }
    }
  for (const auto& [key, place] : missing)
    ADD_FAILURE() << "[" << key << "] is cited at " << place << " but not in docs/references.md";
}

TEST(References, KeysAreFoundInComments) {
  EXPECT_EQ(keys_in("// as in [yu2020, Table 2] and [gehre2009; newman2000], a[i]"),
            (std::set<std::string>{"gehre2009", "newman2000", "yu2020"}));
  EXPECT_EQ(keys_in("# moments [sae-j1460], 4 [E], see [ISO 80000-3]"),
            (std::set<std::string>{"sae-j1460"}));
}

}  // namespace
}  // namespace crosswalk::architecture
