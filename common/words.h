// Lists of names in a scenario are written as one text, the names parted by blanks.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace crosswalk {

inline std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> list;
  for (std::string word; stream >> word;) list.push_back(word);
  return list;
}

}  // namespace crosswalk
