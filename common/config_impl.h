// What config.cpp (the getters) and config_document.cpp (reading, finishing) share.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/config.h"
#include "common/config_tree.h"

namespace crosswalk {

namespace config {

struct Finding {
  Problem problem;
  std::string missing;  ///< path of a missing key, so that its misspelling is reported once
};

inline std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

}  // namespace config

struct ConfigDocument::Impl {
  struct Row {
    std::string key, unit, range, fallback, doc;
  };

  config::Node tree;
  bool is_reference = false;  ///< open sets and arrays of tables show one element
  std::set<std::string> ignored;
  std::vector<config::Finding> findings;
  std::vector<Row> rows;
  std::set<std::string> documented;
  std::map<std::string, std::vector<std::string>> asked;  ///< table path -> keys a file may write

  /// Adds a row of the key reference, once per key.
  void document(const std::string& key, std::string unit, std::string range, std::string fallback,
                std::string_view doc);
};

struct ConfigTable::Impl {
  std::shared_ptr<ConfigDocument::Impl> document;
  config::Node* node = nullptr;  ///< null when the table is absent
  std::string path;              ///< "subject.posture", "interfaces[1]"
  std::string pattern;           ///< for the key reference: "interfaces[]", "joint.<name>"
  Place place;
  bool is_open_set = false;  ///< its sub-tables are named by the user

  struct Found {
    config::Node* node = nullptr;
    std::string key;
    const Unit* unit = nullptr;
  };

  void add(Problem problem, std::string missing = {});
  void wrong(const Found& found, std::string expected, std::string hint = {});
  void missing(std::string_view name, std::string_view hint);
  /// A key without unit. The node comes back null when absent.
  Found plain(std::string_view name);
  /// The one key that writes `name` in a unit of the dimension; reports a doubled or foreign unit.
  Found quantity(std::string_view name, Dimension dimension, bool is_required,
                 std::string_view example);
  bool report_foreign_unit(std::string_view name, Dimension dimension);
  bool read_number(const Found& found, Range range, std::string_view name, Dimension dimension,
                   double& value);
};

}  // namespace crosswalk
