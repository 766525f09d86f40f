// Writing of isomme.h.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "common/error.h"
#include "recorder/isomme.h"

namespace crosswalk::recording {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kKeyWidth = 28;
constexpr std::size_t kLineWidth = 80;
constexpr const char* kNoValue = "NOVALUE";

/// What the head of a .mme file tells, in its order; missing values are written as NOVALUE.
constexpr const char* kTestKeys[] = {"Laboratory name",
                                     "Laboratory contact name",
                                     "Laboratory contact phone",
                                     "Laboratory contact fax",
                                     "Laboratory contact email",
                                     "Laboratory test ref. number",
                                     "Customer name",
                                     "Customer test ref. number",
                                     "Customer project ref. number",
                                     "Customer order number",
                                     "Customer cost unit",
                                     "Customer test engineer name",
                                     "Customer test engineer phone",
                                     "Customer test engineer fax",
                                     "Customer test engineer email",
                                     "Title",
                                     "Medium No./number of media",
                                     "Timestamp",
                                     "Type of the test",
                                     "Subtype of the test",
                                     "Regulation",
                                     "Reference temperature",
                                     "Relative air humidity",
                                     "Date of the test"};

class Lines {
 public:
  /// A comment too long for one line goes on in further ones; any other value is cut.
  void header(const std::string& key, std::string value) {
    if (value.empty()) value = kNoValue;
    do {
      const std::size_t size = fitting(value);
      out_ += fmt::format("{:<28}:{}\r\n", key, value.substr(0, size));
      value.erase(0, size);
    } while (key == "Comments" && !value.empty());
  }
  void number(double value) {
    out_ +=
        std::isfinite(value) ? fmt::format("{:.16E}\r\n", value) : std::string(kNoValue) + "\r\n";
  }
  void save(const fs::path& path) const {
    std::ofstream out(path, std::ios::binary);
    out << out_;
    out.close();
    if (out) return;
    Problem problem;
    problem.place.file = path.string();
    problem.what = "ISO-MME file";
    problem.expected = "a file that can be written";
    throw UserError(problem);
  }

 private:
  /// Bytes of a value that fit a line, whole characters of UTF-8 only.
  static std::size_t fitting(const std::string& value) {
    std::size_t size = std::min(value.size(), kLineWidth - kKeyWidth - 1);
    while (size > 0 && size < value.size() &&
           (static_cast<unsigned char>(value[size]) & 0xC0U) == 0x80U) {
      --size;
    }
    return size;
  }
  std::string out_;
};

/// Filter class letter of a code to the "Channel frequency class".
std::string frequency_class(char letter) {
  switch (letter) {
    case 'A':
      return "1000";
    case 'B':
      return "600";
    case 'C':
      return "180";
    case 'D':
      return "60";
    default:
      return kNoValue;
  }
}

struct Extremes {
  std::size_t low = 0, high = 0;
  bool is_any = false;
};

Extremes extremes(const MmeChannel& c) {
  Extremes e;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (!std::isfinite(c.values[i])) continue;
    if (!e.is_any || c.values[i] > c.values[e.high]) e.high = i;
    if (!e.is_any || c.values[i] < c.values[e.low]) e.low = i;
    e.is_any = true;
  }
  return e;
}

void write_channel(const fs::path& path, const MmeChannel& c) {
  Lines lines;
  const bool is_car = c.code.starts_with('1');
  lines.header("Test object number", is_car ? "1" : "2");
  lines.header("Name of the channel", c.name);
  lines.header("Laboratory channel code", "");
  lines.header("Customer channel code", "");
  lines.header("Channel code", c.code);
  const auto comment = value_of(c.header, "Comments");
  lines.header("Comments", comment.value_or(""));
  lines.header("Location", c.code.substr(2, 4));
  lines.header("Direction", c.code.substr(14, 1));
  lines.header("Dimension", c.code.substr(12, 2));
  lines.header("Channel frequency class", frequency_class(c.code[15]));
  lines.header("Unit", c.unit);
  const bool is_local = std::string("XYZ").find(c.code[14]) != std::string::npos;
  lines.header("Reference system", is_local ? "local" : "global");
  for (const char* key :
       {"Transducer type", "Pre-filter type", "Cut off frequency", "Channel amplitude class"}) {
    lines.header(key, "");
  }
  const bool has_time = !c.is_constant && c.time.size() > 1;
  const double dt =
      has_time ? (c.time.back() - c.time.front()) / static_cast<double>(c.time.size() - 1) : 0.0;
  lines.header("Sampling interval", has_time ? fmt::format("{}", dt) : "");
  lines.header("Bit resolution", "");
  lines.header("Time of first sample", has_time ? fmt::format("{}", c.time.front()) : "");
  lines.header("Number of samples", std::to_string(c.values.size()));
  lines.header("Reference channel", has_time ? "implicit" : "");
  lines.header("Reference channel name", "");
  lines.header("Data source", c.is_constant ? "calculation" : "simulation");
  lines.header("Data status", "ok");
  const Extremes e = extremes(c);
  if (has_time && e.is_any) {
    lines.header("First global maximum value", fmt::format("{:.6E}", c.values[e.high]));
    lines.header("Time of maximum value", fmt::format("{:.6E}", c.time[e.high]));
    lines.header("First global minimum value", fmt::format("{:.6E}", c.values[e.low]));
    lines.header("Time of minimum value", fmt::format("{:.6E}", c.time[e.low]));
  }
  for (const auto& [key, value] : c.header) {
    if (key.starts_with('.')) lines.header(key, value);
  }
  for (const double value : c.values) lines.number(value);
  lines.save(path);
}

void write_test(const fs::path& path, const MmeTest& test) {
  Lines lines;
  lines.header("Data format edition number", "1.6");
  const std::string own = "Laboratory test ref. number";
  for (const char* key : kTestKeys)
    lines.header(key, key == own ? test.name : value_of(test.header, key).value_or(""));
  for (const auto& [key, value] : test.header) {
    const bool is_written =
        std::find(std::begin(kTestKeys), std::end(kTestKeys), key) != std::end(kTestKeys);
    if (!is_written) lines.header(key, value);
  }
  lines.save(path);
}

}  // namespace

void write_isomme(const fs::path& folder, const MmeTest& test) {
  fs::create_directories(folder / "Channel");
  write_test(folder / (test.name + ".mme"), test);
  Lines chn;
  chn.header("Instrumentation standard", "ISO 6487 (2015)");
  chn.header("Number of channels", std::to_string(test.channels.size()));
  for (std::size_t i = 0; i < test.channels.size(); ++i) {
    const std::string number = fmt::format("{:03}", i + 1);
    chn.header("Name of channel " + number, test.channels[i].code + " / " + test.channels[i].name);
    write_channel(folder / "Channel" / (test.name + "." + number), test.channels[i]);
  }
  chn.save(folder / "Channel" / (test.name + ".chn"));
}

}  // namespace crosswalk::recording
