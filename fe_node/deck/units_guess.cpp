#include "fe_node/deck/units_guess.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/units.h"

namespace crosswalk::fe {

namespace {

/// One kind of quantity: the deck's typical value and where its SI value may lie [E]. Inside the
/// narrow range costs nothing; outside, every decade costs kNarrowCost, and kWideCost more beyond
/// the wide range.
struct Evidence {
  const char* word;
  const char* unit;
  double value;  ///< deck units
  double narrow_low, narrow_high, wide_low, wide_high;
  double (*factor)(const UnitFactors&);
};
constexpr double kNarrowCost = 1, kWideCost = 5;
constexpr double kClearMargin = 0.5;  // cost by which a likely guess beats the second
constexpr double kMaxCost = 5;        // above it nothing fits
constexpr double kDoubtMargin = 3;    // by which the stated system may be worse than the best one

double decades_outside(double value, double low, double high) {
  if (value < low) return std::log10(low / value);
  return value > high ? std::log10(value / high) : 0;
}

double cost(const Evidence& evidence, const UnitFactors& factors) {
  const double si = evidence.value * evidence.factor(factors);
  return kNarrowCost * decades_outside(si, evidence.narrow_low, evidence.narrow_high) +
         kWideCost * decades_outside(si, evidence.wide_low, evidence.wide_high);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

double youngs_of(const Material& material) {
  return std::visit(
      [](const auto& law) {
        if constexpr (requires { law.youngs; })
          return law.youngs;
        else
          return 0.0;
      },
      material.law);
}

double box_diagonal(const Deck& deck) {
  if (deck.nodes.empty()) return 0;
  Vec3 low = deck.nodes.front().position, high = low;
  for (const DeckNode& node : deck.nodes) {
    low = low.cwiseMin(node.position);
    high = high.cwiseMax(node.position);
  }
  return (high - low).norm();
}

double top_speed(const Deck& deck) {
  double speed = 0;
  for (const InitialVelocity& initial : deck.initial_velocities)
    speed = std::max(speed, initial.velocity.norm());
  for (const InitialVelocityOf& initial : deck.nodal_velocities)
    speed = std::max(speed, initial.velocity.norm());
  for (const InitialVelocityOf& initial : deck.rigid_velocities)
    speed = std::max(speed, initial.velocity.norm());
  for (const InitialVelocityGeneration& initial : deck.generated_velocities)
    speed = std::max(speed, initial.velocity.norm());
  for (const Part& part : deck.parts)
    if (part.inertia) speed = std::max(speed, part.inertia->velocity.norm());
  return speed;
}

/// Largest ordinate of a translational body load: gravity, as a rule.
double body_acceleration(const Deck& deck) {
  double largest = 0;
  for (const LoadBody& load : deck.body_loads) {
    if (load.axis > 2) continue;
    for (const DeckCurve& curve : deck.curves) {
      if (curve.id != load.curve) continue;
      for (const auto& [x, y] : scaled_points(curve))
        largest = std::max(largest, std::abs(load.scale * y));
    }
  }
  return largest;
}

std::vector<Evidence> evidence_of(const Deck& deck) {
  std::vector<double> densities, moduli;
  for (const Material& material : deck.materials) {
    if (material.density > 0) densities.push_back(material.density);
    if (youngs_of(material) > 0) moduli.push_back(youngs_of(material));
  }
  const auto density = [](const UnitFactors& f) { return f.density(); };
  const auto stress = [](const UnitFactors& f) { return f.stress(); };
  const auto length = [](const UnitFactors& f) { return f.length; };
  const auto time = [](const UnitFactors& f) { return f.time; };
  const auto speed = [](const UnitFactors& f) { return f.velocity(); };
  const auto acceleration = [](const UnitFactors& f) { return f.acceleration(); };
  std::vector<Evidence> all{
      {"density", "kg/m3", median(densities), 500, 1.2e4, 20, 2.3e4, density},
      {"Young's modulus", "Pa", median(moduli), 1e4, 3e11, 1e2, 1.2e12, stress},
      {"size", "m", box_diagonal(deck), 0.02, 20, 1e-3, 200, length},
      {"end time", "s", deck.control.end_time.value_or(0), 1e-4, 1, 1e-6, 100, time},
      {"initial speed", "m/s", top_speed(deck), 0.1, 250, 1e-3, 1500, speed},
      {"body acceleration", "m/s2", body_acceleration(deck), kStandardGravity / 1.1,
       kStandardGravity * 1.1, 0.1, 1e4, acceleration},
  };
  std::erase_if(all, [](const Evidence& one) { return !(one.value > 0); });
  return all;
}

// Sizes and times alone name no mass unit.
bool tells_mass(const std::vector<Evidence>& evidence) {
  return std::any_of(evidence.begin(), evidence.end(), [](const Evidence& one) {
    return std::string_view(one.unit).starts_with("kg") || std::string_view(one.unit) == "Pa";
  });
}

double cost_of(const std::vector<Evidence>& evidence, UnitSystem system) {
  double sum = 0;
  for (const Evidence& one : evidence) sum += cost(one, unit_factors(system));
  return sum;
}

std::vector<std::pair<double, UnitSystem>> ranking(const std::vector<Evidence>& evidence) {
  std::vector<std::pair<double, UnitSystem>> costs;
  for (const UnitSystem system :
       {UnitSystem::MmKgMs, UnitSystem::MmTonneS, UnitSystem::MKgS, UnitSystem::MmGramMs,
        UnitSystem::CmGramUs, UnitSystem::InchSlinchS})
    costs.emplace_back(cost_of(evidence, system), system);
  std::stable_sort(costs.begin(), costs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return costs;
}

std::vector<std::string> reasons_for(const std::vector<Evidence>& evidence, UnitSystem system) {
  const UnitFactors factors = unit_factors(system);
  std::vector<std::string> reasons;
  for (const Evidence& one : evidence)
    reasons.push_back(fmt::format("{} {:g} -> {:.3g} {}{}", one.word, one.value,
                                  one.value * one.factor(factors), one.unit,
                                  cost(one, factors) > 0 ? " (unusual)" : ""));
  return reasons;
}

}  // namespace

UnitsGuess guess_units(const Deck& deck) {
  UnitsGuess guess;
  if (deck.units != UnitSystem::Unknown) {
    guess.system = deck.units;
    guess.certainty = UnitsGuess::Certainty::Stated;
    return guess;
  }
  const std::vector<Evidence> evidence = evidence_of(deck);
  if (!tells_mass(evidence)) return guess;
  const auto costs = ranking(evidence);
  guess.system = costs[0].second;
  const bool is_clear =
      costs[1].first - costs[0].first >= kClearMargin && costs[0].first <= kMaxCost;
  guess.certainty = is_clear ? UnitsGuess::Certainty::Likely : UnitsGuess::Certainty::Ambiguous;
  if (!is_clear) guess.second = costs[1].second;
  guess.reasons = reasons_for(evidence, guess.system);
  return guess;
}

void check_units(const Deck& deck, DeckProblems& problems) {
  if (deck.units == UnitSystem::Unknown) return;
  const std::vector<Evidence> evidence = evidence_of(deck);
  if (!tells_mass(evidence)) return;
  const auto best = ranking(evidence).front();
  if (cost_of(evidence, deck.units) < best.first + kDoubtMargin) return;
  std::string found;
  for (const std::string& reason : reasons_for(evidence, deck.units))
    if (reason.ends_with("(unusual)")) found += (found.empty() ? "" : ", ") + reason;
  problems.warnings.add(Place{deck.files.names.empty() ? "deck" : deck.files.names.front(), 0, 0},
                        "unit system",
                        fmt::format("{}, as the numbers look", unit_system_name(best.second)),
                        fmt::format("{} is stated: {}", unit_system_name(deck.units), found));
}

}  // namespace crosswalk::fe
