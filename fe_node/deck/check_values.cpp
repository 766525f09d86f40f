// Values of materials, sections and curves that no law can take.
#include <cmath>

#include <fmt/format.h>

#include "fe_node/deck/deck_check.h"

namespace crosswalk::fe {

namespace {

class ValueCheck {
 public:
  ValueCheck(const Deck& deck, DeckProblems& problems) : deck_(deck), problems_(problems) {}

  void about(Source source, std::string what) {
    source_ = source;
    what_ = std::move(what);
  }
  void positive(const char* field, double value) {
    if (value > 0) return;
    wrong(field, "a positive number", value);
  }
  void not_negative(const char* field, double value) {
    if (value >= 0) return;
    wrong(field, "zero or more", value);
  }
  /// A Poisson ratio of a compressible solid.
  void poisson(double value) {
    if (value > -1 && value < 0.5) return;
    wrong("PR", "a Poisson ratio in (-1, 0.5)", value);
  }

  // One overload per law that has something to check.
  template <class Law>
  void law(const Law&) {}
  void law(const mat::Elastic& law) {
    if (law.is_fluid) return positive("K", law.bulk);
    positive("E", law.youngs);
    poisson(law.poisson);
  }
  void law(const mat::PlasticKinematic& law) {
    positive("E", law.youngs);
    poisson(law.poisson);
    positive("SIGY", law.yield);
    not_negative("ETAN", law.tangent);
  }
  void law(const mat::PiecewiseLinearPlasticity& law) {
    positive("E", law.youngs);
    poisson(law.poisson);
    if (!law.stress_curve.given() && law.strain[1] == 0) positive("SIGY", law.yield);
  }
  void law(const mat::Viscoelastic& law) {
    positive("BULK", law.bulk);
    positive("G0", law.shear_short);
    not_negative("GI", law.shear_long);
    not_negative("BETA", law.decay);
  }
  void law(const mat::KelvinMaxwell& law) {
    positive("BULK", law.bulk);
    positive("G0", law.shear_short);
    not_negative("GI", law.shear_long);
  }
  void law(const mat::OgdenRubber& law) { poisson(law.poisson); }
  void law(const mat::HyperelasticRubber& law) { poisson(law.poisson); }
  void law(const mat::MooneyRivlin& law) { poisson(law.poisson); }
  void law(const mat::GeneralViscoelastic& law) { positive("BULK", law.bulk); }
  void law(const mat::LowDensityFoam& law) { positive("E", law.youngs); }
  void law(const mat::LaminatedGlass& law) {
    positive("EG", law.glass_youngs);
    poisson(law.glass_poisson);
    positive("EP", law.polymer_youngs);
    poisson(law.polymer_poisson);
  }

 private:
  void wrong(const char* field, const char* expected, double value) {
    problems_.errors.add(deck_.place(source_), fmt::format("{} ({})", what_, field), expected,
                         fmt::format("{:g}", value));
  }
  const Deck& deck_;
  DeckProblems& problems_;
  Source source_;
  std::string what_;
};

void check_materials(const Deck& deck, DeckProblems& problems) {
  ValueCheck check(deck, problems);
  for (const Material& material : deck.materials) {
    check.about(material.source,
                fmt::format("*{} {}", material_keyword(material), material.id.value));
    std::visit([&](const auto& law) { check.law(law); }, material.law);
    check.not_negative("RO", material.density);
  }
}

void check_masses(const Deck& deck, DeckProblems& problems) {
  ValueCheck check(deck, problems);
  for (const MassElement& mass : deck.masses) {
    check.about(mass.source, fmt::format("*ELEMENT_MASS {}", mass.id.value));
    check.not_negative("MASS", mass.mass);
  }
}

/// Solids and shells need a material with a density, shells a thickness.
void check_parts(const DeckIndex& index, DeckProblems& problems) {
  const Deck& deck = index.deck();
  for (const Part& part : deck.parts) {
    const Section* section = index.section(part.section);
    const Material* material = index.material(part.material);
    if (section == nullptr || material == nullptr) continue;
    const bool is_unsupported = std::holds_alternative<mat::Unsupported>(material->law);
    const bool needs_mass = std::holds_alternative<SectionSolid>(section->law) ||
                            std::holds_alternative<SectionShell>(section->law);
    if (needs_mass && material->density == 0 && !is_unsupported && !part.inertia)
      problems.errors.add(
          deck.place(material->source),
          fmt::format("*{} {} (RO)", material_keyword(*material), material->id.value),
          fmt::format("a density, for part {}", part.id.value), "0");
  }
  for (const Section& section : deck.sections) {
    const auto* shell = std::get_if<SectionShell>(&section.law);
    if (shell == nullptr) continue;
    for (const double thickness : shell->thickness)
      if (thickness < 0)
        problems.errors.add(deck.place(section.source),
                            fmt::format("*SECTION_SHELL {} (T1)", section.id.value),
                            "a positive thickness", fmt::format("{:g}", thickness));
  }
}

void check_curves(const Deck& deck, DeckProblems& problems) {
  for (const DeckCurve& curve : deck.curves) {
    const std::string name = fmt::format("*DEFINE_CURVE {}", curve.id.value);
    if (curve.points.size() < 2) {
      problems.errors.add(deck.place(curve.source), name, "two points or more",
                          fmt::format("{}", curve.points.size()));
      continue;
    }
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
      if (curve.points[i].first > curve.points[i - 1].first) continue;
      problems.errors.add(
          deck.place(curve.source), name, "rising abscissas",
          fmt::format("{:g} after {:g}", curve.points[i].first, curve.points[i - 1].first));
      break;
    }
  }
}

/// Beyond it volumes and Jacobians would leave the range of numbers.
constexpr double kFarthest = 1e12;

void check_coordinates(const Deck& deck, DeckProblems& problems) {
  for (const DeckNode& node : deck.nodes)
    if (const double farthest = node.position.cwiseAbs().maxCoeff(); !(farthest <= kFarthest))
      problems.errors.add(deck.place(node.source), fmt::format("*NODE {}", node.id.value),
                          fmt::format("coordinates within {:g}", kFarthest),
                          fmt::format("{:g}", farthest));
}

}  // namespace

void check_values(const DeckIndex& index, DeckProblems& problems) {
  check_coordinates(index.deck(), problems);
  check_materials(index.deck(), problems);
  check_masses(index.deck(), problems);
  check_parts(index, problems);
  check_curves(index.deck(), problems);
}

}  // namespace crosswalk::fe
