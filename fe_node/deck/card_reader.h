// Reads the cards of one keyword block: fixed columns, long and I10 columns, comma-separated
// fields, &parameters, and the place of every wrong field.
#pragma once

#include <string>
#include <string_view>

#include "fe_node/deck/card_io.h"
#include "fe_node/deck/deck_problems.h"
#include "fe_node/deck/line_source.h"
#include "fe_node/deck/parameters.h"

namespace crosswalk::fe {

/// Column widths: Standard as described; Long: 20 for every field; I10: 8-column fields are 10
/// wide.
enum class CardFormat { Standard, Long, I10 };

class CardReader final : public CardIo {
 public:
  CardReader(LineSource& lines, const Parameters& parameters, const std::vector<std::string>& files,
             DeckProblems& problems)
      : lines_(lines), parameters_(parameters), files_(files), problems_(problems) {}

  /// Starts a block; `keyword` stands in messages.
  void begin(std::string keyword, Source keyword_source, CardFormat format);
  /// Leaves what is left of the block; blank lines or not.
  void skip_rest();

  bool is_reading() const override { return true; }
  void card() override;
  bool has_card() override;
  bool has_content() override;
  std::string_view next_line() override;
  void real(const char* name, double& value, int width) override;
  void integer(const char* name, std::int32_t& value, int width) override;
  void text(const char* name, std::string& value, int width) override;
  void line(const char* name, std::string& value) override;
  void raw_line(std::string& value) override;
  void id_and_title(DeckId& id, std::string& title) override;
  void problem(const char* name, const std::string& expected, const std::string& found) override;
  Source source() const override { return source_; }

  const std::string& keyword() const { return keyword_; }
  Source keyword_source() const { return keyword_source_; }
  int card_number() const { return card_number_; }
  /// Makes the cards of the next record count from 1 again.
  void restart_numbering() { card_number_ = 0; }

 private:
  std::string_view field(int width);
  std::string_view rest();
  std::optional<std::string> substituted(const char* name, std::string_view field);
  void wrong_field(const char* name, const char* expected, std::string_view found,
                   std::string hint);

  LineSource& lines_;
  const Parameters& parameters_;
  const std::vector<std::string>& files_;
  DeckProblems& problems_;
  std::string keyword_;
  Source keyword_source_, source_;
  CardFormat format_ = CardFormat::Standard;
  std::string card_;
  int blank_lines_ = 0;  ///< looked over by has_content(), still to be served
  Source blank_source_;
  std::size_t at_ = 0;
  bool is_free_ = false;
  int card_number_ = 0, field_number_ = 0;
};

}  // namespace crosswalk::fe
