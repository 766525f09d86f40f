// User numbers and places of deck records.
//
// A DeckId is the number a user gave to a node, part, curve ...; it never mixes with plain indices.
// A Source is the compact place of a record: an index into Deck::files and a line.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace crosswalk::fe {

struct DeckId {
  std::int32_t value = 0;
  constexpr DeckId() = default;
  constexpr explicit DeckId(std::int32_t number) : value(number) {}
  /// A zero id means "not given" in every keyword field.
  constexpr bool given() const { return value != 0; }
  friend constexpr auto operator<=>(DeckId, DeckId) = default;
};

struct Source {
  std::int32_t file = -1;  ///< index into Deck::files.names; -1: made by a program
  std::int32_t line = 0;   ///< counts from 1
  /// Where a record stands is not part of what it says: all places compare equal.
  friend constexpr bool operator==(Source, Source) { return true; }
};

}  // namespace crosswalk::fe

template <>
struct std::hash<crosswalk::fe::DeckId> {
  std::size_t operator()(crosswalk::fe::DeckId id) const noexcept {
    return std::hash<std::int32_t>{}(id.value);
  }
};
