#include "recorder/csv_table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::recording {

namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n\"");
  if (first == std::string_view::npos) return {};
  const auto last = text.find_last_not_of(" \t\r\n\"");
  return std::string(text.substr(first, last - first + 1));
}

std::vector<std::string> split(const std::string& line) {
  const char separator = line.find(';') != std::string::npos ? ';' : ',';
  std::vector<std::string> fields;
  std::size_t from = 0;
  while (true) {
    const std::size_t to = line.find(separator, from);
    fields.push_back(trimmed(std::string_view(line).substr(from, to - from)));
    if (to == std::string::npos) return fields;
    from = to + 1;
  }
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::optional<double> number(std::string field) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (field.front() == '+') field.erase(0, 1);
  double value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

void keep_comment(CsvTable& table, std::string_view line) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return;
  table.comments[trimmed(line.substr(1, colon - 1))] = trimmed(line.substr(colon + 1));
}

void read_row(CsvTable& table, const std::string& line, int line_number) {
  const std::vector<std::string> fields = split(line);
  if (fields.size() != table.names.size()) {
    throw SignalError(SignalFault::Shape,
                      fmt::format("{}:{}: {} fields in a table of {} columns", table.file,
                                  line_number, fields.size(), table.names.size()));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> value = number(fields[i]);
    if (!value) {
      throw SignalError(SignalFault::Shape,
                        fmt::format("{}:{}: column {}: '{}' is not a number", table.file,
                                    line_number, table.names[i], fields[i]));
    }
    table.columns[i].push_back(*value);
  }
}

}  // namespace

bool CsvTable::has(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<double>& CsvTable::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw SignalError(SignalFault::Shape,
                      fmt::format("{}: no column '{}'; columns are {}", file, name, joined(names)));
  }
  return columns[static_cast<std::size_t>(found - names.begin())];
}

CsvTable parse_csv(const std::string& text, const std::string& name) {
  CsvTable table;
  table.file = name;
  std::istringstream in(text);
  std::string line;
  for (int line_number = 1; std::getline(in, line); ++line_number) {
    if (line_number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.erase(0, 3);
    if (trimmed(line).empty()) continue;
    if (line[0] == '#') {
      keep_comment(table, line);
    } else if (table.names.empty()) {
      table.names = split(line);
      table.columns.resize(table.names.size());
      if (std::all_of(table.names.begin(), table.names.end(),
                      [](const auto& f) { return number(f).has_value(); })) {
        throw SignalError(
            SignalFault::Shape,
            fmt::format("{}:{}: expected a header line with column names, found numbers", name,
                        line_number));
      }
    } else {
      read_row(table, line, line_number);
    }
  }
  if (table.rows() == 0) throw SignalError(SignalFault::TooShort, name + ": no data rows");
  return table;
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) {
    Problem problem;
    problem.place.file = path.string();
    problem.what = "signal file";
    problem.expected = "a readable CSV file";
    problem.found = "none";
    throw UserError(problem);
  }
  std::ostringstream text;
  text << in.rdbuf();
  return parse_csv(text.str(), path.string());
}

bool is_time_name(const std::string& name) {
  for (const char* known : {"t", "time", "time_s", "t_s", "time_ms", "t_ms"}) {
    if (name == known) return true;
  }
  return false;
}

std::vector<double> time_column(const CsvTable& table) {
  for (const std::string& name : table.names) {
    if (!is_time_name(name)) continue;
    std::vector<double> t = table.column(name);
    if (name.ends_with("_ms")) {
      for (double& value : t) value *= 1e-3;
    }
    return t;
  }
  return table.column("t");
}

std::vector<double> value_column(const CsvTable& table) {
  std::vector<std::size_t> values;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (!is_time_name(table.names[i]) && table.names[i] != "sigma") values.push_back(i);
  }
  if (values.size() != 1) {
    throw SignalError(SignalFault::Shape, fmt::format("{}: expected the columns t,value; found {}",
                                                      table.file, joined(table.names)));
  }
  return table.columns[values[0]];
}

Series read_series(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  return {time_column(table), value_column(table)};
}

}  // namespace crosswalk::recording
