// Strict reading of TOML scenario files: typed getters with unit, range, default and a doc line.
//
// A quantity's key ends in its unit (`standing_height_mm`); the getter names the bare quantity and
// its dimension and returns SI. Missing, unknown, doubled, mistyped and out-of-range keys are
// gathered and reported together as `file:line:column: key: expected E, found F; hint`. `base =
// "file.toml"` in a table merges that file's tables underneath (keys given here win); paths are
// relative to the file that names them. Every getter call also feeds the key reference printed by
// `crosswalk keys`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/curve.h"
#include "common/error.h"
#include "common/units.h"

namespace crosswalk {

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};
constexpr Range kPositive{std::numeric_limits<double>::min(),
                          std::numeric_limits<double>::infinity()};
constexpr Range kNonNegative{0, std::numeric_limits<double>::infinity()};

class ConfigDocument;

/// A view of one table of a document. Cheap to copy; the document must outlive it.
/// All SI out. Getters of a wrong or missing key record a problem and return the fallback (or a
/// NaN, zero, empty string), so that one run reports every mistake; ConfigDocument::finish() then
/// throws.
class ConfigTable {
 public:
  double quantity(std::string_view name, Dimension dimension, Range range, std::string_view doc);
  double quantity_or(std::string_view name, Dimension dimension, Range range, double fallback,
                     std::string_view doc);
  /// An array of `count` numbers (0: any number) with one unit suffix.
  std::vector<double> quantities(std::string_view name, Dimension dimension, int count,
                                 std::string_view doc);
  /// A curve written as two parallel arrays: `<name>_x_mm = [...]`, `<name>_y_kN = [...]`.
  Curve curve(std::string_view name, Dimension x, Dimension y, Curve::Outside outside,
              std::string_view doc);
  int integer_or(std::string_view name, int min, int max, int fallback, std::string_view doc);
  bool flag_or(std::string_view name, bool fallback, std::string_view doc);
  std::string text(std::string_view name, std::string_view doc);
  std::string text_or(std::string_view name, std::string_view fallback, std::string_view doc);
  /// One of `options`; anything else is a problem with a "did you mean".
  std::string choice_or(std::string_view name, const std::vector<std::string>& options,
                        std::string_view fallback, std::string_view doc);
  /// A path relative to the file that holds the key, made absolute; the file must exist.
  std::filesystem::path file(std::string_view name, std::string_view doc);
  /// A sub-table; an absent one reads as empty.
  ConfigTable table(std::string_view name, std::string_view doc);
  /// The elements of `[[name]]`; empty when absent.
  std::vector<ConfigTable> tables(std::string_view name, std::string_view doc);
  /// Names of the sub-tables of this table (for open sets such as `[joint.<name>]`), in file order;
  /// taking them by table() afterwards marks them known.
  std::vector<std::string> table_names() const;
  /// True when the key is there; for quantities with any unit suffix of any dimension.
  bool has(std::string_view name) const;
  /// Where this table, or one of its keys, stands.
  Place place(std::string_view key = {}) const;
  /// Records a problem found by the caller (a rule between keys), at this table's key.
  void problem(std::string_view key, std::string expected, std::string found,
               std::string hint = {});

 private:
  friend class ConfigDocument;
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

class ConfigDocument {
 public:
  /// Reads and merges; throws UserError for an unreadable file, a syntax error or a cyclic `base`.
  explicit ConfigDocument(const std::filesystem::path& path);
  /// From a string, for tests; `name` stands in messages, `base` paths are relative to `folder`.
  static ConfigDocument from_text(std::string text, const std::string& name,
                                  const std::filesystem::path& folder = ".");
  /// A document in which every getter finds nothing and complains of nothing: reading a schema from
  /// it fills the key reference.
  static ConfigDocument for_reference();
  ~ConfigDocument();
  ConfigDocument(ConfigDocument&&) noexcept;
  ConfigDocument& operator=(ConfigDocument&&) noexcept;

  ConfigTable root();
  /// Lays `toml_text` over the document: its keys win, in whatever unit the files write them. For
  /// options of the command line; `name` stands in messages.
  void override_with(const std::string& toml_text, const std::string& name);
  /// Top-level tables read by someone else (another node's schema): not reported as unknown.
  void ignore_tables(const std::vector<std::string>& names);
  /// Throws every gathered problem, unknown keys included.
  void finish();
  /// The merged document as TOML, the copy kept with a run: strings that name an existing file
  /// become absolute paths, and a comment after every value names the place it came from.
  std::string resolved_text() const;
  /// FNV-1a digest of the merged document; equal texts on all machines give equal digests.
  std::uint64_t digest() const;
  /// Markdown rows "key | unit | range | default | meaning" of every getter called so far.
  std::string key_reference() const;

 private:
  friend class ConfigTable;
  struct Impl;
  explicit ConfigDocument(std::shared_ptr<Impl> impl);
  std::shared_ptr<Impl> impl_;
};

}  // namespace crosswalk
