// The merged tree of a TOML document, every node with the file, line and column that wrote it.
//
// The only module that includes toml++; behind config.h. Tables keep the order of their file;
// `base = "file"` is resolved while reading, so that a tree holds plain values only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/error.h"

namespace crosswalk::config {

struct Entry;

struct Node {
  enum class Kind { Table, Array, Text, Integer, Real, Flag, Date };
  Kind kind = Kind::Table;
  Place key_place;                                      ///< of the key, or of the table's header
  Place value_place;                                    ///< of the value
  std::shared_ptr<const std::filesystem::path> folder;  ///< of the file that holds the node
  std::string text;                                     ///< Text, Date
  std::int64_t integer = 0;
  double real = 0;
  bool flag = false;
  std::vector<Node> items;     ///< Array
  std::vector<Entry> entries;  ///< Table
  bool is_known = false;       ///< a getter asked for it

  Node* find(std::string_view key);
  const Node* find(std::string_view key) const;
  bool is_number() const { return kind == Kind::Integer || kind == Kind::Real; }
  double number() const { return kind == Kind::Integer ? static_cast<double>(integer) : real; }
  /// An array whose elements are all tables, as `[[name]]` writes it.
  bool is_table_array() const;
};

struct Entry {
  std::string key;
  Node node;
};

/// Both throw UserError for an unreadable file, a syntax error or a cyclic base.
Node read_file(const std::filesystem::path& path);
Node read_text(const std::string& text, const std::string& name,
               const std::filesystem::path& folder);
/// Entries of `over` win; tables merge, everything else is replaced. A quantity replaces the one of
/// the same name in another unit of the same dimension.
void merge_over(Node& under, Node over);

enum class Writing { Canonical, WithOrigins };
/// TOML text. Canonical: values as written, no comments (for the digest). WithOrigins: strings that
/// name an existing file become absolute, each value is followed by a comment naming its place.
std::string write(const Node& root, Writing writing);
/// The value as a reader would type it, shortened for messages.
std::string shown(const Node& node);

}  // namespace crosswalk::config
