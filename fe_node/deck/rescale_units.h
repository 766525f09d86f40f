// What the parts of rescale.h share: multiplication by dimension, and the curves met on the way.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

class UnitChange {
 public:
  UnitChange(Deck& deck_of_records, const UnitFactors& factors, DeckProblems& found)
      : deck(deck_of_records), u(factors), problems(found) {}

  /// Multiplies; values that mean "never" (1e20 and more) stay.
  void by(double factor, double& value) const {
    if (value < kNever && value > -kNever) value *= factor;
  }
  template <class... Values>
  void length(Values&... values) const {
    (by(u.length, values), ...);
  }
  template <class... Values>
  void time(Values&... values) const {
    (by(u.time, values), ...);
  }
  template <class... Values>
  void mass(Values&... values) const {
    (by(u.mass, values), ...);
  }
  template <class... Values>
  void stress(Values&... values) const {
    (by(u.stress(), values), ...);
  }
  template <class... Values>
  void force(Values&... values) const {
    (by(u.force(), values), ...);
  }
  template <class... Values>
  void rate(Values&... values) const {
    (by(1 / u.time, values), ...);
  }
  template <class... Values>
  void velocity(Values&... values) const {
    (by(u.velocity(), values), ...);
  }
  /// A curve's abscissa and ordinate are these quantities for the record that names it.
  void curve(DeckId id, double x_factor, double y_factor, Source user);
  /// A curve over strain, or a table of such curves over strain rate.
  void curve_or_rate_table(DeckId id, double y_factor, Source user);
  void refuse(Source source, std::string what, std::string why) const;
  /// Converts the curves that were named, once each.
  void finish();

  Deck& deck;
  const UnitFactors& u;
  DeckProblems& problems;

 private:
  struct Use {
    double x = 1, y = 1;
    Source user;
  };
  std::map<DeckId, std::vector<Use>> uses_;
  std::map<DeckId, std::vector<Use>> rate_tables_;
};

void rescale_materials(UnitChange& change);
void rescale_parts(UnitChange& change);
void rescale_conditions(UnitChange& change);
void rescale_constraints(UnitChange& change);

}  // namespace crosswalk::fe
