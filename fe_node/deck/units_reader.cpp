#include "fe_node/deck/units_reader.h"

#include <fmt/format.h>

#include "fe_node/deck/number.h"

namespace crosswalk::fe {

namespace {

constexpr UnitSystem kAll[] = {UnitSystem::MKgS,     UnitSystem::MmTonneS, UnitSystem::MmKgMs,
                               UnitSystem::MmGramMs, UnitSystem::CmGramUs, UnitSystem::InchSlinchS};

std::string known_names() {
  std::string out;
  for (const UnitSystem system : kAll)
    out += (out.empty() ? "" : ", ") + std::string(unit_system_name(system));
  return out;
}

/// The manual's words for a unit, in ours.
std::string canonical(const std::string& word) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"SEC", "s"}, {"S", "s"},   {"MS", "ms"},      {"MICRO_S", "us"},
      {"M", "m"},   {"MM", "mm"}, {"CM", "cm"},      {"IN", "in"},
      {"KG", "kg"}, {"G", "g"},   {"MTRC_TON", "t"}, {"SLINCH", "slinch"}};
  const std::string upper = upper_case(word);
  for (const auto& [theirs, ours] : kWords)
    if (upper == theirs) return std::string(ours);
  return word;
}

}  // namespace

void read_control_units(CardIo& io, Deck& deck) {
  std::string length = "m", time = "s", mass = "kg";
  io.card();
  io.text("LENGTH", length);
  io.text("TIME", time);
  io.text("MASS", mass);
  const std::string name =
      fmt::format("{}-{}-{}", canonical(length), canonical(mass), canonical(time));
  const UnitSystem system = unit_system_from(name);
  if (system == UnitSystem::Unknown)
    io.problem("LENGTH TIME MASS", "one of " + known_names(), name);
  else
    deck.units = system;
}

void read_directives(const std::vector<std::pair<std::string, Source>>& directives, Deck& deck,
                     DeckProblems& problems) {
  constexpr std::string_view kKey = "unit_system=";
  for (const auto& [text, source] : directives) {
    const bool is_unit = text.starts_with(kKey);
    const UnitSystem system =
        is_unit ? unit_system_from(trimmed(std::string_view(text).substr(kKey.size())))
                : UnitSystem::Unknown;
    if (system == UnitSystem::Unknown) {
      problems.errors.add(deck.place(source),
                          "$ crosswalk:", "unit_system= one of " + known_names(),
                          fmt::format("'{:.60}'", text));
    } else if (deck.units != UnitSystem::Unknown && deck.units != system) {
      problems.errors.add(
          deck.place(source), "$ crosswalk:",
          fmt::format("unit_system={} as said before", unit_system_name(deck.units)),
          fmt::format("'{:.60}'", text));
    } else {
      deck.units = system;
    }
  }
}

}  // namespace crosswalk::fe
