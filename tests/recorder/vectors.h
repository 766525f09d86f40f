// The reference vectors under tests/recorder/vectors, or the folder CROSSWALK_RATING_VECTORS names.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/source_folder.h"

namespace crosswalk::recording {

inline std::filesystem::path vector_folder(const std::string& group) {
  const char* other = std::getenv("CROSSWALK_RATING_VECTORS");
  const std::filesystem::path root =
      other != nullptr ? std::filesystem::path(other) : source_folder() / "tests/recorder/vectors";
  return root / group;
}

inline nlohmann::json expected(const std::string& group) {
  const std::filesystem::path path = vector_folder(group) / "expected.json";
  std::ifstream in(path);
  if (!in) throw std::runtime_error("no vectors at " + path.string());
  return nlohmann::json::parse(in);
}

/// |a - b| <= tolerance * max(|b|, floor).
inline bool is_close(double a, double b, double tolerance, double floor = 1e-9) {
  return std::abs(a - b) <= tolerance * std::max(std::abs(b), floor);
}

}  // namespace crosswalk::recording
