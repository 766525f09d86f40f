#include "fe_node/deck/rescale.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/rescale_units.h"

namespace crosswalk::fe {

namespace {

bool is_close(double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); }

template <class Record>
Record* with_id(std::vector<Record>& records, DeckId id) {
  const auto found = std::find_if(records.begin(), records.end(),
                                  [id](const Record& record) { return record.id == id; });
  return found == records.end() ? nullptr : &*found;
}

}  // namespace

void UnitChange::curve(DeckId id, double x_factor, double y_factor, Source user) {
  if (!id.given()) return;
  if (id.value < 0) id.value = -id.value;
  uses_[id].push_back({x_factor, y_factor, user});
}

void UnitChange::curve_or_rate_table(DeckId id, double y_factor, Source user) {
  if (!id.given()) return;
  if (id.value < 0) id.value = -id.value;
  const DeckTable* table = with_id(deck.tables, id);
  if (table == nullptr) return curve(id, 1, y_factor, user);
  rate_tables_[id].push_back({1, y_factor, user});
  for (const DeckId member : table->curves) curve(member, 1, y_factor, user);
}

void UnitChange::refuse(Source source, std::string what, std::string why) const {
  problems.errors.add(deck.place(source), std::move(what), "records whose units can be changed",
                      std::move(why), "write the included file in the units of the deck");
}

void UnitChange::finish() {
  for (const auto& [id, uses] : uses_) {
    DeckCurve* curve = with_id(deck.curves, id);
    if (curve == nullptr) continue;  // of another file, or missing: told elsewhere
    const Use& first = uses.front();
    const auto other = std::find_if(uses.begin(), uses.end(), [&](const Use& use) {
      return !is_close(use.x, first.x) || !is_close(use.y, first.y);
    });
    if (other != uses.end())
      refuse(curve->source, fmt::format("*DEFINE_CURVE {}", id.value),
             fmt::format("used as two different quantities, at {} and {}",
                         deck.place(first.user).text(), deck.place(other->user).text()));
    curve->x_scale *= first.x;
    curve->y_scale *= first.y;
  }
  for (const auto& [id, uses] : rate_tables_) {
    DeckTable& table = *with_id(deck.tables, id);
    const double scale = table.scale != 0 ? table.scale : 1;
    const bool is_logarithmic =
        !table.values.empty() && scale * (table.values.front() + table.offset) < 0;
    if (is_logarithmic)
      table.offset -= std::log(u.time) / scale;
    else
      table.scale = scale / u.time;
  }
  for (const DeckCurve& curve : deck.curves)
    if (!uses_.contains(curve.id))
      problems.warnings.add(deck.place(curve.source),
                            fmt::format("*DEFINE_CURVE {}", curve.id.value), {},
                            "no record of its file names it",
                            "its units are not known, so its numbers stay as they are");
  for (const CurveFunction& function : deck.curve_functions)
    refuse(function.source, fmt::format("*DEFINE_CURVE_FUNCTION {}", function.id.value),
           "a formula");
}

void rescale(Deck& deck, const UnitFactors& factors, DeckProblems& problems) {
  UnitChange change(deck, factors, problems);
  rescale_parts(change);
  rescale_materials(change);
  rescale_conditions(change);
  rescale_constraints(change);
  change.finish();
}

}  // namespace crosswalk::fe
