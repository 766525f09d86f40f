// Writes keyword blocks as text: fixed columns with a `$#` line naming the fields, and long columns
// (*KEYWORD +) for a block in which a number would lose more than kWrittenPrecision otherwise.
//
// The text depends on the values only, so that equal decks give equal files.
#pragma once

#include <ostream>
#include <set>
#include <string>

#include "fe_node/deck/card_io.h"

namespace crosswalk::fe {

class CardWriter final : public CardIo {
 public:
  /// Largest relative change of a number by writing it.
  static constexpr double kWrittenPrecision = 1e-9;

  explicit CardWriter(std::ostream& out) : out_(out) {}
  ~CardWriter() override;
  CardWriter(const CardWriter&) = delete;
  CardWriter& operator=(const CardWriter&) = delete;

  /// Starts a block `*keyword`, ending the one before.
  void keyword(const std::string& keyword);
  /// `*keyword_TITLE` and the title line when there is one, else `*keyword`.
  void keyword_with_title(const std::string& keyword, std::string title);
  /// Writes what is gathered; done by the destructor too.
  void finish();

  bool is_reading() const override { return false; }
  void card() override;
  bool has_card() override { return false; }
  bool has_content() override { return false; }
  std::string_view next_line() override { return {}; }
  void real(const char* name, double& value, int width) override;
  void integer(const char* name, std::int32_t& value, int width) override;
  void text(const char* name, std::string& value, int width) override;
  void line(const char* name, std::string& value) override;
  void raw_line(std::string& value) override;
  void id_and_title(DeckId& id, std::string& title) override;
  void problem(const char*, const std::string&, const std::string&) override {}
  Source source() const override { return {}; }

 private:
  /// One rendering of the block: standard or long columns.
  struct Columns {
    std::string text, heading, card;
    std::set<std::string> headings;
    int fixed_width = 0;  ///< 0: as asked
    void field(const char* name, const std::string& value, int width, bool is_left);
    void end_card();
  };
  void end_card();

  std::ostream& out_;
  std::string keyword_;
  Columns standard_, long_;
  bool is_lossy_ = false, has_open_card_ = false;
};

}  // namespace crosswalk::fe
