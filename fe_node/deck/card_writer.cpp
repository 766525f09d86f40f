#include "fe_node/deck/card_writer.h"

#include <cmath>

#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {
constexpr int kLongWidth = 20;

std::string padded(const std::string& value, int width, bool is_left) {
  const std::size_t size = static_cast<std::size_t>(width);
  if (value.size() >= size) return value.substr(0, size);
  const std::string blanks(size - value.size(), ' ');
  return is_left ? value + blanks : blanks + value;
}
}  // namespace

CardWriter::~CardWriter() { finish(); }

void CardWriter::keyword(const std::string& keyword) {
  finish();
  keyword_ = '*' + keyword;  // a deck may have one without a name
  long_.fixed_width = kLongWidth;
}

void CardWriter::keyword_with_title(const std::string& keyword_name, std::string title) {
  keyword(title.empty() ? keyword_name : keyword_name + "_TITLE");
  if (!title.empty()) line("title", title);
}

void CardWriter::finish() {
  if (keyword_.empty()) return;
  end_card();
  out_ << keyword_ << (is_lossy_ ? " +\n" : "\n") << (is_lossy_ ? long_.text : standard_.text);
  keyword_.clear();
  standard_ = {};
  long_ = {};
  is_lossy_ = false;
}

void CardWriter::Columns::field(const char* name, const std::string& value, int width,
                                bool is_left) {
  if (fixed_width != 0 && width <= fixed_width) width = fixed_width;
  std::string label(name);
  for (char& c : label) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  heading += padded(label, width, is_left);
  card += padded(value, width, is_left);
}

void CardWriter::Columns::end_card() {
  if (!heading.empty()) {
    if (heading.starts_with("  ")) heading.replace(0, 2, "$#");
    if (heading.starts_with("$#") && headings.insert(heading).second) text += heading + '\n';
  }
  card.erase(card.find_last_not_of(' ') + 1);
  text += card + '\n';
  card.clear();
  heading.clear();
}

void CardWriter::end_card() {
  if (!has_open_card_) return;
  standard_.end_card();
  long_.end_card();
  has_open_card_ = false;
}

void CardWriter::card() {
  end_card();
  has_open_card_ = true;
}

void CardWriter::real(const char* name, double& value, int width) {
  const std::string written = format_real(value, width);
  const double read = parse_real(written).value_or(0);
  is_lossy_ = is_lossy_ || std::abs(read - value) > kWrittenPrecision * std::abs(value);
  standard_.field(name, written, width, false);
  long_.field(name, format_real(value, kLongWidth), width, false);
}

void CardWriter::integer(const char* name, std::int32_t& value, int width) {
  const std::string written = std::to_string(value);
  is_lossy_ = is_lossy_ || written.size() > static_cast<std::size_t>(width);
  standard_.field(name, written, width, false);
  long_.field(name, written, width, false);
}

void CardWriter::text(const char* name, std::string& value, int width) {
  standard_.field(name, value, width, true);
  long_.field(name, value, width, true);
}

void CardWriter::id_and_title(DeckId& number, std::string& title) {
  constexpr int kTitleWidth = 70;
  card();
  id("ID", number);
  text("title", title, kTitleWidth);
}

void CardWriter::line(const char*, std::string& value) {
  card();
  const bool looks_like_more = value.starts_with('*') || value.starts_with('$');
  standard_.card = long_.card = (looks_like_more ? " " : "") + value;
}

void CardWriter::raw_line(std::string& value) {
  card();
  standard_.card = long_.card = value;
}

}  // namespace crosswalk::fe
