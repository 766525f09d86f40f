// One description of a keyword's cards, for reading and for writing.
//
// A function `cards(CardIo&, Record&)` names the fields of a record line by line. Run with a
// CardReader it fills the record, run with a CardWriter it prints it: the two cannot drift apart.
// Reading leaves the member's default where a field is blank. Fields are 10 columns wide unless
// said.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/spatial.h"
#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

class CardIo {
 public:
  static constexpr int kWidth = 10;
  virtual ~CardIo() = default;
  virtual bool is_reading() const = 0;
  /// Begins the next line. Reading: when the block has ended all fields keep their values.
  virtual void card() = 0;
  /// Reading: another line is left in the block, blank or not. Writing: false.
  virtual bool has_card() = 0;
  /// Reading: another line that is not blank is left in the block. Writing: false.
  virtual bool has_content() = 0;
  /// Reading: the next line of the block, not yet taken; empty when there is none. Writing: empty.
  virtual std::string_view next_line() = 0;

  virtual void real(const char* name, double& value, int width = kWidth) = 0;
  virtual void integer(const char* name, std::int32_t& value, int width = kWidth) = 0;
  /// Text of a field, trimmed.
  virtual void text(const char* name, std::string& value, int width = kWidth) = 0;
  /// A whole line as it stands, trimmed: titles. Includes card().
  virtual void line(const char* name, std::string& value) = 0;
  /// A whole line exactly as it stands: cards that are not interpreted. Includes card().
  virtual void raw_line(std::string& value) = 0;
  /// A line with a number in 10 columns and a title, which may hold commas. Includes card().
  virtual void id_and_title(DeckId& id, std::string& title) = 0;
  /// Says that the deck is wrong at the present card (reading only).
  virtual void problem(const char* name, const std::string& expected, const std::string& found) = 0;
  /// Where the present card stands.
  virtual Source source() const = 0;

  void id(const char* name, DeckId& value, int width = kWidth) {
    integer(name, value.value, width);
  }
  void skip(int width = kWidth) {
    std::string unused;
    text("-", unused, width);
  }
  /// Blank or zero means `fallback`.
  void real_or(const char* name, double& value, double fallback, int width = kWidth) {
    real(name, value, width);
    if (is_reading() && value == 0) value = fallback;
  }
  void integer_or(const char* name, std::int32_t& value, std::int32_t fallback,
                  int width = kWidth) {
    integer(name, value, width);
    if (is_reading() && value == 0) value = fallback;
  }
  void vec3(const std::array<const char*, 3>& names, Vec3& value, int width = kWidth) {
    for (int i = 0; i < 3; ++i) real(names[static_cast<std::size_t>(i)], value[i], width);
  }
  template <std::size_t N>
  void reals(const char* name, std::array<double, N>& values, int width = kWidth) {
    for (double& value : values) real(name, value, width);
  }
  template <std::size_t N>
  void ids(const char* name, std::array<DeckId, N>& values, int width = kWidth) {
    for (DeckId& value : values) id(name, value, width);
  }
  /// An optional trailing card: present when there is one more line, or when the record has it.
  bool has_optional(bool is_in_record) { return is_reading() ? has_card() : is_in_record; }

  /// As many rows as the block has left (at most `limit`), or as the record holds; `each(row)`
  /// describes one.
  template <class Row, class Each>
  void rows(std::vector<Row>& values, Each each, int limit = std::numeric_limits<int>::max()) {
    if (!is_reading()) {
      for (Row& row : values) each(row);
      return;
    }
    while (static_cast<int>(values.size()) < limit && has_content()) {
      Row row{};
      each(row);
      values.push_back(std::move(row));
    }
  }
  /// Ids, `per_card` a line, zeros left out.
  void id_list(const char* name, std::vector<DeckId>& values, int per_card = 8);
};

}  // namespace crosswalk::fe
