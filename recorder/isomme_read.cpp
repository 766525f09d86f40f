// Reading of isomme.h.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "common/error.h"
#include "recorder/isomme.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

[[noreturn]] void fail(const fs::path& file, int line, const std::string& expected,
                       const std::string& found) {
  Problem problem;
  problem.place.file = file.string();
  problem.place.line = line;
  problem.what = "ISO-MME";
  problem.expected = expected;
  problem.found = found.substr(0, 40);
  throw UserError(problem);
}

bool is_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    int more = c < 0x80                ? 0
               : c >= 0xC2 && c < 0xE0 ? 1
               : c >= 0xE0 && c < 0xF0 ? 2
               : c >= 0xF0 && c < 0xF5 ? 3
                                       : -1;
    if (more < 0) return false;
    for (; more > 0; --more) {
      if (++i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U)
        return false;
    }
  }
  return true;
}

/// UTF-8, or ISO 8859-1 turned into it.
std::string file_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, 0, "a readable file", "none");
  std::ostringstream buffer;
  buffer << in.rdbuf();
  std::string text = buffer.str();
  if (is_utf8(text)) return text;
  std::string out;
  for (const char ch : text) {
    const auto c = static_cast<unsigned char>(ch);
    if (c < 0x80) {
      out.push_back(ch);
    } else {
      out.push_back(static_cast<char>(0xC0U | (c >> 6U)));
      out.push_back(static_cast<char>(0x80U | (c & 0x3FU)));
    }
  }
  return out;
}

struct Parsed {
  MmeHeader header;
  std::vector<double> data;
};

/// Header lines up to the first line without a colon, then one number per line.
Parsed parse(const fs::path& path) {
  Parsed out;
  std::istringstream in(file_text(path));
  std::string line;
  bool is_data = false;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string text = trimmed(line);
    if (text.empty()) continue;
    const auto colon = line.find(':');
    is_data = is_data || colon == std::string::npos;
    if (!is_data) {
      out.header.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
      continue;
    }
    if (text == "NOVALUE") {
      out.data.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    double value = 0;
    const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end) fail(path, number, "a number or NOVALUE", text);
    out.data.push_back(value);
  }
  return out;
}

std::optional<double> number_of(const MmeHeader& header, const std::string& key,
                                const fs::path& path) {
  const auto text = value_of(header, key);
  if (!text) return std::nullopt;
  double value = 0;
  const auto [stop, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || stop == text->data()) fail(path, 0, key + ": a number", *text);
  return value;
}

MmeChannel read_channel(const fs::path& path) {
  Parsed parsed = parse(path);
  MmeChannel c;
  c.code = value_of(parsed.header, "Channel code").value_or("");
  c.name = value_of(parsed.header, "Name of the channel").value_or("");
  c.unit = value_of(parsed.header, "Unit").value_or("1");
  c.values = std::move(parsed.data);
  const auto wanted = number_of(parsed.header, "Number of samples", path);
  if (wanted && std::llround(*wanted) != static_cast<long long>(c.values.size())) {
    fail(path, 0, fmt::format("{:.0f} samples", *wanted), std::to_string(c.values.size()));
  }
  const std::string reference = value_of(parsed.header, "Reference channel").value_or("");
  const auto dt = number_of(parsed.header, "Sampling interval", path);
  if (reference == "implicit" || (reference.empty() && dt)) {
    const double t0 = number_of(parsed.header, "Time of first sample", path).value_or(0.0);
    if (!dt || *dt <= 0) fail(path, 0, "Sampling interval: a positive number", "none");
    for (std::size_t i = 0; i < c.values.size(); ++i)
      c.time.push_back(t0 + static_cast<double>(i) * *dt);
  } else if (reference != "explicit") {
    c.is_constant = true;
  }
  c.header = std::move(parsed.header);
  return c;
}

/// Channels whose times are the data of another channel.
void resolve_times(MmeTest& test, const fs::path& folder) {
  for (MmeChannel& c : test.channels) {
    if (value_of(c.header, "Reference channel") != "explicit") continue;
    const std::string name = value_of(c.header, "Reference channel name").value_or("");
    const auto found =
        std::find_if(test.channels.begin(), test.channels.end(),
                     [&name](const MmeChannel& other) { return name.starts_with(other.code); });
    if (name.empty() || found == test.channels.end()) {
      fail(folder, 0, c.code + ": the reference channel '" + name + "'", "none");
    }
    if (found->values.size() != c.values.size()) {
      fail(folder, 0, fmt::format("{}: {} times", c.code, c.values.size()),
           std::to_string(found->values.size()));
    }
    c.time = found->values;
    c.is_constant = false;
  }
}

/// The folder's file with this extension in any case of letters; empty when there is none.
fs::path find_file(const fs::path& folder, const std::string& extension) {
  if (!fs::is_directory(folder)) return {};
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::string found = entry.path().extension().string();
    std::transform(found.begin(), found.end(), found.begin(),
                   [](unsigned char ch) { return static_cast<char>(std::tolower(ch)); });
    if (found == extension) return entry.path();
  }
  return {};
}

fs::path single_file(const fs::path& folder, const std::string& extension) {
  const fs::path file = find_file(folder, extension);
  if (file.empty()) fail(folder, 0, "a file *" + extension, "none");
  return file;
}

}  // namespace

std::optional<std::string> value_of(const MmeHeader& header, const std::string& key) {
  for (const auto& [name, value] : header) {
    if (name == key)
      return value.empty() || value == "NOVALUE" ? std::nullopt : std::optional(value);
  }
  return std::nullopt;
}

bool is_isomme(const fs::path& folder) { return !find_file(folder, ".mme").empty(); }

MmeTest read_isomme(const fs::path& folder) {
  MmeTest test;
  const fs::path main = single_file(folder, ".mme");
  test.name = main.stem().string();
  test.header = parse(main).header;
  const fs::path list = single_file(folder / "Channel", ".chn");
  for (const auto& [key, value] : parse(list).header) {
    constexpr const char* kPrefix = "Name of channel ";
    if (!key.starts_with(kPrefix)) continue;
    const std::string number = trimmed(key.substr(std::string(kPrefix).size()));
    MmeChannel c = read_channel(folder / "Channel" / (list.stem().string() + "." + number));
    const auto slash = value.find('/');
    const std::string code = trimmed(value.substr(0, slash));
    if (c.code.empty()) c.code = code;
    if (c.code != code) fail(list, 0, "channel " + number + " with code " + code, c.code);
    // The list's lines are cut at 80 characters: the channel's own file may say more.
    if (slash != std::string::npos) {
      const std::string listed = trimmed(value.substr(slash + 1));
      if (!c.name.starts_with(listed)) c.name = listed;
    }
    test.channels.push_back(std::move(c));
  }
  resolve_times(test, folder);
  return test;
}

}  // namespace crosswalk::recording
