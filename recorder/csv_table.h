// Columns of numbers from a CSV file: `#` comment lines, one header line of names, decimal points.
//
// Comments of the form `# key: value` are kept. `nan` and empty fields read as NaN (the metrics
// then refuse them by name); anything else that is not a number, and ragged rows, are a shape
// fault.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recorder/channel.h"

namespace crosswalk::recording {

struct CsvTable {
  std::string file;
  std::map<std::string, std::string> comments;
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< one per name

  bool has(const std::string& name) const;
  /// Throws a shape fault that lists what is there.
  const std::vector<double>& column(const std::string& name) const;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// Throws UserError when the file cannot be read.
CsvTable read_csv(const std::filesystem::path& path);
CsvTable parse_csv(const std::string& text, const std::string& name);

/// The time column in s: `t`, `time`, `time_s`, `t_s`, or `time_ms`, `t_ms` (converted).
std::vector<double> time_column(const CsvTable& table);
bool is_time_name(const std::string& name);

/// The one column that is neither time nor `sigma`; a shape fault when there are several.
std::vector<double> value_column(const CsvTable& table);

/// A file of two columns, time and value, whatever the second is called.
Series read_series(const std::filesystem::path& path);

}  // namespace crosswalk::recording
