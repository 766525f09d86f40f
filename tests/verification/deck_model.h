// Decks written by tests, built into models.
#pragma once

#include <fmt/format.h>

#include "fe_node/model_builder/model_builder.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {

/// A keyword deck in SI around the given cards.
inline std::string si_deck(const std::string& cards) {
  return "*KEYWORD\n$ crosswalk: unit_system=m-kg-s\n" + cards + "*END\n";
}

/// Complete but for finish_model().
inline BuiltModel built(const std::string& cards) { return build_model(sound(si_deck(cards)), {}); }

/// The problems that keep a deck from being built, one a line.
inline std::string build_problems(const std::string& cards) {
  try {
    built(cards);
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

inline std::string node_card(int id, const Vec3& x) {
  return fmt::format("{:8d}{:16.9g}{:16.9g}{:16.9g}\n", id, x.x(), x.y(), x.z());
}

}  // namespace crosswalk::fe
