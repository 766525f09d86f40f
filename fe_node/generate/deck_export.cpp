#include "fe_node/generate/deck_export.h"

#include <map>
#include <set>

#include "common/error.h"

namespace crosswalk::fe::generate {

namespace {

constexpr int kStiffnessHourglass = 5;  ///< IHQ: Flanagan-Belytschko stiffness form, exact volume
constexpr std::size_t kTitleLength = 78;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

/// The law's numbers from SI to the deck's units; refuses laws the generators do not use.
MaterialLaw in_units(MaterialLaw law, const UnitFactors& u) {
  std::visit(
      Overloaded{[&](mat::Elastic& m) { m.youngs /= u.stress(); },
                 [&](mat::Viscoelastic& m) {
                   m.bulk /= u.stress();
                   m.shear_short /= u.stress();
                   m.shear_long /= u.stress();
                   m.decay *= u.time;
                 },
                 [&](mat::PlasticKinematic& m) {
                   m.youngs /= u.stress();
                   m.yield /= u.stress();
                   m.tangent /= u.stress();
                 },
                 [&](mat::PiecewiseLinearPlasticity& m) {
                   m.youngs /= u.stress();
                   m.yield /= u.stress();
                   m.tangent /= u.stress();
                   for (double& stress : m.stress) stress /= u.stress();
                 },
                 [&](mat::LaminatedGlass& m) {
                   for (double* stress : {&m.glass_youngs, &m.glass_yield, &m.glass_tangent,
                                          &m.polymer_youngs, &m.polymer_yield, &m.polymer_tangent})
                     *stress /= u.stress();
                 },
                 [&](mat::Rigid& m) { m.youngs /= u.stress(); },
                 [&](mat::Muscle& m) {
                   m.peak_stress /= u.stress();
                   m.maximum_rate *= u.time;
                 },
                 [&](mat::CableDiscreteBeam& m) { m.youngs /= u.stress(); },
                 [](mat::SpringNonlinearElastic&) {},
                 [](auto&) { CW_ASSERT(false && "law without unit rule"); }},
      law);
  return law;
}

class Export {
 public:
  Export(const ModelDraft& draft, UnitSystem units, const DeckNumbers& first)
      : draft_(draft), units_(unit_factors(units)), first_(first), next_section_(first.section) {
    deck_.title = draft.title;
    deck_.units = units;
  }

  Deck run() {
    add_nodes();
    for (const PartSpec& part : draft_.parts) add_part(part);
    add_elements();
    add_curves();
    add_sets();
    add_control();
    return std::move(deck_);
  }

 private:
  /// Bricks without a coefficient against hourglass modes get eight points, which have none.
  static bool is_full(const SolidSection& solid) { return solid.hourglass == 0; }

  DeckId node_id(int index) const { return DeckId(first_.node + index); }

  void add_nodes() {
    for (std::size_t i = 0; i < draft_.mesh.nodes.size(); ++i)
      deck_.nodes.push_back(
          {.id = node_id(static_cast<int>(i)), .position = draft_.mesh.nodes[i] / units_.length});
  }

  void add_part(const PartSpec& spec) {
    Part part{.id = DeckId(spec.id), .title = spec.name};
    part.material = DeckId(spec.id);
    part.section = section(spec);
    part.is_averaged = spec.is_strand;
    if (const auto* solid = std::get_if<SolidSection>(&spec.section);
        solid != nullptr && !is_full(*solid))
      part.hourglass = hourglass(*solid);
    deck_.parts.push_back(part);
    const std::string title = spec.name + " " + mark(spec.grade) + " " + spec.source;
    deck_.materials.push_back({.id = DeckId(spec.id),
                               .title = title.substr(0, kTitleLength),
                               .density = spec.density / units_.density(),
                               .law = in_units(spec.law, units_)});
  }

  DeckId section(const PartSpec& spec) {
    Section section;
    DeckId* shared = nullptr;
    std::visit(Overloaded{[&](const SolidSection& solid) {
                            shared = is_full(solid) ? &full_section_ : &solid_section_;
                            section.law = SectionSolid{.formulation = is_full(solid) ? 2 : 1};
                          },
                          [&](const SpringSection&) {
                            shared = &spring_section_;
                            section.law = SectionDiscrete{};
                          },
                          [&](const TrussSection& truss) {
                            SectionBeam beam{.formulation = 3};
                            beam.area = truss.area / (units_.length * units_.length);
                            section.law = beam;
                          },
                          [&](const CableSection& cable) {
                            SectionBeam beam{.formulation = 6};
                            beam.cable_area = cable.area / (units_.length * units_.length);
                            section.law = beam;
                          },
                          [&](const ShellSection& shell) { section.law = shell_section(shell); }},
               spec.section);
    if (shared != nullptr && shared->given()) return *shared;
    section.id = DeckId(next_section_++);
    section.title = shared == nullptr ? spec.name : "";
    if (shared != nullptr) *shared = section.id;
    deck_.sections.push_back(section);
    return section.id;
  }

  static int formulation(ShellForm form) {
    if (form == ShellForm::Membrane) return 5;
    return form == ShellForm::Full ? 16 : 2;
  }

  SectionShell shell_section(const ShellSection& shell) {
    SectionShell law{.formulation = formulation(shell.form)};
    law.points = shell.form == ShellForm::Membrane ? 1 : shell.points;
    law.shear_factor = 5.0 / 6.0;
    law.thickness.fill(shell.thickness / units_.length);
    law.reference_position = shell.reference == ShellReference::Top      ? 1
                             : shell.reference == ShellReference::Bottom ? -1
                                                                         : 0;
    if (shell.rule.empty()) return law;
    IntegrationShell rule{.id = DeckId(next_section_),
                          .points = static_cast<int>(shell.rule.size())};
    for (const auto& [position, weight] : shell.rule)
      rule.rows.push_back({.position = position, .weight = weight});
    deck_.integrations.push_back(rule);
    law.points = rule.points;
    law.rule = -rule.id.value;
    return law;
  }

  DeckId hourglass(const SolidSection& solid) {
    const auto [found, is_new] =
        hourglass_.try_emplace(solid.hourglass, DeckId(static_cast<int>(hourglass_.size()) + 1));
    if (is_new)
      deck_.hourglasses.push_back(
          {.id = found->second, .type = kStiffnessHourglass, .coefficient = solid.hourglass});
    return found->second;
  }

  void add_elements() {
    int id = first_.element - 1;
    for (const Hex& hex : draft_.mesh.hexes) {
      SolidElement solid{.id = DeckId(++id), .part = DeckId(hex.part)};
      for (int c = 0; c < 8; ++c) solid.nodes[c] = node_id(hex.node[c]);
      deck_.solids.push_back(solid);
    }
    for (const Quad& quad : draft_.mesh.quads) {
      ShellElement shell{.id = DeckId(++id), .part = DeckId(quad.part)};
      for (int c = 0; c < 4; ++c) shell.nodes[c] = node_id(quad.node[c]);
      if (quad.thickness > 0) shell.thickness.fill(quad.thickness / units_.length);
      deck_.shells.push_back(shell);
    }
    std::set<int> beams;
    for (const PartSpec& part : draft_.parts)
      if (std::holds_alternative<TrussSection>(part.section) ||
          std::holds_alternative<CableSection>(part.section))
        beams.insert(part.id);
    for (const Line& line : draft_.mesh.lines) {
      const std::array<DeckId, 2> ends{node_id(line.from), node_id(line.to)};
      ++id;
      if (beams.count(line.part) > 0)
        deck_.beams.push_back(
            {.id = DeckId(id), .part = DeckId(line.part), .nodes = {ends[0], ends[1], {}}});
      else
        deck_.discretes.push_back({.id = DeckId(id), .part = DeckId(line.part), .nodes = ends});
    }
    for (const PointMass& point : draft_.mesh.masses)
      deck_.masses.push_back({.kind = fe::MassTarget::Node,
                              .id = DeckId(++id),
                              .target = node_id(point.node),
                              .mass = point.mass / units_.mass});
  }

  std::pair<double, double> units_of(CurveAxes axes) const {
    switch (axes) {
      case CurveAxes::StressOverStrain:
        return {1, units_.stress()};
      case CurveAxes::FactorOverVelocity:
        return {units_.velocity(), 1};
      case CurveAxes::FactorOverTime:
        return {units_.time, 1};
      default:
        return {units_.length, units_.force()};
    }
  }

  void add_curves() {
    for (const CurveSpec& spec : draft_.curves) {
      DeckCurve curve{.id = DeckId(spec.id), .title = spec.name};
      const auto [x_unit, y_unit] = units_of(spec.axes);
      for (const auto& [x, y] : spec.points) curve.points.emplace_back(x / x_unit, y / y_unit);
      deck_.curves.push_back(curve);
    }
  }

  void add_sets() {
    int id = first_.set - 1;
    for (const NodeSet& set : draft_.mesh.sets)
      deck_.sets.push_back(node_set(++id, set.name, set.nodes));
    for (const RigidAttachment& attachment : draft_.mesh.attachments) {
      const std::string name = "on_" + draft_.part(attachment.part).name;
      deck_.sets.push_back(node_set(++id, name, attachment.nodes));
      deck_.extra_nodes.push_back(
          {.kind = NodeTarget::Set, .part = DeckId(attachment.part), .target = DeckId(id)});
    }
    id = first_.set - 1;
    for (const PartSetSpec& spec : draft_.part_sets) {
      DeckSet set{.kind = SetKind::Part, .id = DeckId(++id), .title = spec.name};
      for (const int part : spec.parts) set.ids.push_back(DeckId(part));
      deck_.sets.push_back(set);
    }
  }

  DeckSet node_set(int id, const std::string& name, const std::vector<int>& nodes) const {
    DeckSet set{.kind = SetKind::Node, .id = DeckId(id), .title = name};
    // Rising and without repetition.
    const std::set<int> unique(nodes.begin(), nodes.end());
    for (const int node : unique) set.ids.push_back(node_id(node));
    return set;
  }

  void add_control() {
    deck_.control.time_step = TimeStepControl{.scale = 0.9};
    deck_.control.bulk_viscosity = BulkViscosityControl{.quadratic = 1.5, .linear = 0.06};
    deck_.control.energy =
        EnergyControl{.hourglass = 2, .rigid_wall = 2, .sliding = 2, .damping = 2};
  }

  const ModelDraft& draft_;
  UnitFactors units_;
  DeckNumbers first_;
  Deck deck_;
  DeckId full_section_, solid_section_, spring_section_;
  int next_section_;
  std::map<double, DeckId> hourglass_;
};

}  // namespace

Deck to_deck(const ModelDraft& draft, UnitSystem units, const DeckNumbers& first) {
  return Export(draft, units, first).run();
}

}  // namespace crosswalk::fe::generate
