// The project's own files, for the tests that read them.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source_folder.h"

namespace crosswalk::architecture {

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Files under a folder of the project with one of the extensions, relative to its root.
inline std::vector<std::filesystem::path> files_under(const std::string& folder,
                                                      const std::vector<std::string>& extensions) {
  const std::filesystem::path root = source_folder();
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(root / folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file()) continue;
    for (const std::string& extension : extensions)
      if (entry.path().extension() == extension)
        files.push_back(std::filesystem::relative(entry.path(), root));
  }
  return files;
}

}  // namespace crosswalk::architecture
