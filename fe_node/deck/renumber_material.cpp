// New numbers in materials: by the names of their fields on the card, so that every law is covered.
#include <algorithm>
#include <string>

#include "fe_node/deck/cards_material.h"
#include "fe_node/deck/renumber_ids.h"

namespace crosswalk::fe {

namespace {

/// Moves the curve and table fields of a material by their names on the card.
class CurveMover final : public CardIo {
 public:
  explicit CurveMover(Renumbering& move) : move_(move) {}
  bool is_reading() const override { return false; }
  void card() override {}
  bool has_card() override { return false; }
  bool has_content() override { return false; }
  std::string_view next_line() override { return {}; }
  void real(const char*, double&, int) override {}
  void integer(const char* name, std::int32_t& value, int) override {
    const std::string_view field(name);
    if (field == "MID") move_.add(value, move_.by.material);
    if (field == "PVID") move_.add(value, move_.by.part);
    if (field.starts_with("LC") || field == "TBID" || field == "LLCID" || field == "ULCID")
      move_.add(value, move_.by.curve);
  }
  void text(const char*, std::string&, int) override {}
  void line(const char*, std::string&) override {}
  void raw_line(std::string&) override {}
  void id_and_title(DeckId&, std::string&) override {}
  void problem(const char*, const std::string&, const std::string&) override {}
  Source source() const override { return {}; }

 private:
  Renumbering& move_;
};

/// The number at the head of a material that is kept as text.
void rename_first_card(mat::Unsupported& law, DeckId id) {
  if (law.cards.empty() || !id.given()) return;
  constexpr std::size_t kWidth = CardIo::kWidth;
  std::string& card = law.cards.front();
  const std::string number = std::to_string(id.value);
  const std::size_t comma = card.find(',');
  card = comma < kWidth ? number + card.substr(comma)
                        : std::string(kWidth - std::min(number.size(), kWidth), ' ') + number +
                              card.substr(std::min(card.size(), kWidth));
}

// The fields a material keeps as numbers although they may be ids.
void move_numbers(Renumbering&, auto&) {}
void move_numbers(Renumbering& move, mat::Muscle& law) {
  for (double* value :
       {&law.activation, &law.stretch_factor, &law.rate_factor, &law.passive_factor})
    move.if_negative(*value, move.by.curve);
}
void move_numbers(Renumbering& move, mat::SpringMuscle& law) {
  for (double* value :
       {&law.activation, &law.speed_scale, &law.tension_length, &law.tension_speed, &law.passive})
    move.if_negative(*value, move.by.curve);
}
void move_numbers(Renumbering& move, mat::Rigid& law) {
  if (law.constraint_option == -1) move.add_to_number(law.constraint_1, move.by.definition);
  const bool is_system =
      std::all_of(law.axes.begin() + 1, law.axes.end(), [](double value) { return value == 0; });
  if (is_system) move.add_to_number(law.axes[0], move.by.definition);
}
void move_numbers(Renumbering& move, mat::Fabric& law) {
  move.if_negative(law.axes_option, move.by.definition);
}
void move_numbers(Renumbering& move, mat::SoftTissue& law) {
  move.if_negative(law.axes_option, move.by.definition);
}

}  // namespace

void renumber_materials(Deck& deck, Renumbering& move) {
  CurveMover fields(move);
  for (Material& material : deck.materials) {
    if (auto* text = std::get_if<mat::Unsupported>(&material.law)) {
      move(material.id, move.by.material);
      rename_first_card(*text, material.id);
    }
    std::visit(
        [&](auto& law) {
          mat::cards(fields, material, law);  // MID is the first of its fields
          move_numbers(move, law);
        },
        material.law);
  }
  for (AddErosion& erosion : deck.erosions) move(erosion.material, move.by.material);
  for (EquationOfState& eos : deck.equations_of_state) {
    move(eos.id, move.by.material);
    if (auto* table = std::get_if<EosTabulated>(&eos.law)) {
      move(table->c_curve, move.by.curve);
      move(table->t_curve, move.by.curve);
    }
  }
}

}  // namespace crosswalk::fe
