#include "fe_node/deck/card_reader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {
constexpr int kLongWidth = 20;
constexpr int kMaxBlankLines = 64;  // no record has that many blank cards in a row
constexpr std::size_t kShownField = 40;

/// Printable and short, for messages.
std::string shown(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, kShownField))
    out += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  if (text.size() > kShownField) out += "...";
  return out;
}
}  // namespace

void CardIo::id_list(const char* name, std::vector<DeckId>& values, int per_card) {
  if (!is_reading()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i % static_cast<std::size_t>(per_card) == 0) card();
      id(name, values[i]);
    }
    return;
  }
  while (has_content()) {
    card();
    for (int i = 0; i < per_card; ++i) {
      DeckId value;
      id(name, value);
      if (value.given()) values.push_back(value);
    }
  }
}

void CardReader::begin(std::string keyword, Source keyword_source, CardFormat format) {
  if (keyword.ends_with("_TITLE")) keyword.erase(keyword.size() - 6);
  keyword_ = std::move(keyword);
  keyword_source_ = source_ = keyword_source;
  format_ = format;
  card_number_ = 0;
  blank_lines_ = 0;
}

void CardReader::skip_rest() {
  blank_lines_ = 0;
  while (has_card()) lines_.take();
}

bool CardReader::has_card() {
  if (blank_lines_ > 0) return true;
  const std::string* line = lines_.peek();
  return line != nullptr && (line->empty() || line->front() != '*');
}

bool CardReader::has_content() {
  while (true) {
    const std::string* line = lines_.peek();
    if (line == nullptr || (!line->empty() && line->front() == '*')) return false;
    if (!line->empty()) return true;
    blank_source_ = lines_.place();
    blank_lines_ = std::min(blank_lines_ + 1, kMaxBlankLines);
    lines_.take();
  }
}

void CardReader::card() {
  ++card_number_;
  field_number_ = 0;
  at_ = 0;
  card_.clear();
  if (blank_lines_ > 0) {
    --blank_lines_;
    source_ = blank_source_;
  } else if (has_card()) {
    card_ = *lines_.peek();
    source_ = lines_.place();
    lines_.take();
  } else {
    problems_.errors.add(Place{files_[static_cast<std::size_t>(source_.file)], source_.line, 0},
                         fmt::format("*{} card {}", keyword_, card_number_), "another line",
                         "the end of the keyword's cards");
  }
  is_free_ = card_.find(',') != std::string::npos;
}

std::string_view CardReader::field(int width) {
  ++field_number_;
  const std::string_view text(card_);
  if (at_ >= text.size()) return {};
  if (is_free_) {
    const std::size_t comma = std::min(text.find(',', at_), text.size());
    const std::string_view out = text.substr(at_, comma - at_);
    at_ = comma + 1;
    return trimmed(out);
  }
  if (format_ == CardFormat::Long && width <= kLongWidth) width = kLongWidth;
  if (format_ == CardFormat::I10 && width == 8) width = kWidth;
  const std::string_view out = text.substr(at_, static_cast<std::size_t>(width));
  at_ += static_cast<std::size_t>(width);
  return trimmed(out);
}

std::string_view CardReader::rest() {
  const std::string_view text(card_);
  return at_ >= text.size() ? std::string_view() : trimmed(text.substr(at_));
}

std::string_view CardReader::next_line() {
  if (blank_lines_ > 0 || !has_card()) return {};
  return *lines_.peek();
}

std::optional<std::string> CardReader::substituted(const char* name, std::string_view field) {
  const bool is_negative = field.front() == '-';
  const std::string key = upper_case(trimmed(field.substr(is_negative ? 2 : 1)));
  const Parameter* parameter = parameters_.find(key);
  if (parameter == nullptr) {
    const std::string similar = did_you_mean(key, parameters_.names());
    wrong_field(name, "a defined parameter", field,
                similar.empty() ? "*PARAMETER must come before its use"
                                : fmt::format("did you mean &{}?", similar));
    return std::nullopt;
  }
  if (parameter->kind == Parameter::Kind::Text) return parameter->text;
  return fmt::format("{:.17g}", is_negative ? -parameter->value : parameter->value);
}

namespace {
bool names_parameter(std::string_view field) {
  return !field.empty() && (field.front() == '&' || field.substr(0, 2) == "-&");
}
}  // namespace

void CardReader::real(const char* name, double& value, int width) {
  const std::string_view written = field(width);
  if (written.empty()) return;
  std::optional<std::string> replaced;
  if (names_parameter(written) && !(replaced = substituted(name, written))) return;
  if (const std::optional<double> number = parse_real(replaced ? *replaced : written)) {
    value = *number;
  } else {
    wrong_field(name, "a number", written, {});
  }
}

void CardReader::integer(const char* name, std::int32_t& value, int width) {
  const std::string_view written = field(width);
  if (written.empty()) return;
  std::optional<std::string> replaced;
  if (names_parameter(written) && !(replaced = substituted(name, written))) return;
  if (const std::optional<std::int32_t> number = parse_integer(replaced ? *replaced : written)) {
    value = *number;
  } else {
    wrong_field(name, "an integer", written, {});
  }
}

void CardReader::text(const char* name, std::string& value, int width) {
  const std::string_view written = field(width);
  if (!names_parameter(written)) {
    value = written;
  } else if (std::optional<std::string> replaced = substituted(name, written)) {
    value = *replaced;
  }
}

void CardReader::raw_line(std::string& value) {
  card();
  value = card_;
}

void CardReader::line(const char*, std::string& value) {
  card();
  --card_number_;  // the manual counts cards without titles
  value = trimmed(card_);
}

void CardReader::id_and_title(DeckId& id, std::string& title) {
  card();
  --card_number_;
  const std::string_view head = std::string_view(card_).substr(0, kWidth);
  is_free_ = head.find(',') != std::string_view::npos;
  integer("ID", id.value, kWidth);
  title = rest();
}

void CardReader::problem(const char* name, const std::string& expected, const std::string& found) {
  problems_.errors.add(Place{files_[static_cast<std::size_t>(source_.file)], source_.line, 0},
                       fmt::format("*{} card {} ({})", keyword_, card_number_, name), expected,
                       found);
}

void CardReader::wrong_field(const char* name, const char* expected, std::string_view found,
                             std::string hint) {
  const std::size_t column =
      is_free_ ? 0 : static_cast<std::size_t>(found.data() - card_.data()) + 1;
  problems_.errors.add(
      Place{files_[static_cast<std::size_t>(source_.file)], source_.line, static_cast<int>(column)},
      fmt::format("*{} card {} field {} ({})", keyword_, card_number_, field_number_, name),
      expected, fmt::format("'{}'", shown(found)), std::move(hint));
}

}  // namespace crosswalk::fe
