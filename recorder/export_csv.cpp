#include "recorder/export_csv.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/error.h"
#include "recorder/csv_table.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

constexpr std::array kUnits = {"mm", "mps", "mps2", "radps", "radps2", "N",
                               "Nm", "J",   "kg",   "m",     "s",      "Pa"};

std::string column_name(const Channel& channel) {
  return channel.unit == "1" ? channel.name : channel.name + "_" + channel.unit;
}

/// Splits `head_cog_y_mm` into name and unit; a name without a known unit is a pure number.
void split_column(const std::string& column, Channel& channel) {
  channel.name = column;
  channel.unit = "1";
  const auto last = column.rfind('_');
  if (last == std::string::npos) return;
  const std::string tail = column.substr(last + 1);
  for (const char* unit : kUnits) {
    if (tail != unit) continue;
    channel.name = column.substr(0, last);
    channel.unit = unit;
  }
}

}  // namespace

void write_channels_csv(const std::filesystem::path& path, const std::vector<Channel>& channels,
                        const std::vector<std::pair<std::string, std::string>>& comments) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const auto& [key, value] : comments) fmt::format_to(out, "# {}: {}\n", key, value);
  for (const Channel& c : channels) {
    fmt::format_to(out, "# {}: {}\n", column_name(c), c.description);
  }
  fmt::format_to(out, "time_s");
  for (const Channel& c : channels) fmt::format_to(out, ",{}", column_name(c));
  fmt::format_to(out, "\n");
  const std::size_t rows = channels.empty() ? 0 : channels.front().samples.size();
  for (std::size_t i = 0; i < rows; ++i) {
    fmt::format_to(out, "{}", channels.front().time(i));
    for (const Channel& c : channels) {
      if (std::isfinite(c.samples[i])) {
        fmt::format_to(out, ",{}", c.samples[i]);
      } else {
        text.push_back(',');
      }
    }
    text.push_back('\n');
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                             &std::fclose);
  if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size()) {
    Problem problem;
    problem.place.file = path.string();
    problem.what = "channels";
    problem.expected = "a file that can be written";
    throw UserError(problem);
  }
}

std::vector<Channel> read_channels_csv(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const std::vector<double> t = time_column(table);
  if (t.size() < 2 || !is_uniform(t)) {
    throw SignalError(SignalFault::TimeOrder, table.file + ": time is not a uniform base");
  }
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (is_time_name(table.names[i])) continue;
    Channel c;
    split_column(table.names[i], c);
    const auto comment = table.comments.find(table.names[i]);
    if (comment != table.comments.end()) c.description = comment->second;
    c.t0 = t.front();
    c.dt = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    c.samples = table.columns[i];
    channels.push_back(std::move(c));
  }
  return channels;
}

}  // namespace crosswalk::recording
