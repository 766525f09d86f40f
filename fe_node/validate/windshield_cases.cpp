// The windshield under a pedestrian headform, the headform on its own certification plate, and a
// plate whose answer to a mass is known in closed form.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.h"
#include "common/units.h"
#include "fe_node/generate/mass_report.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/generate/windshield.h"
#include "fe_node/validate/deck_case.h"
#include "fe_node/validate/injury.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

using generate::Fidelity;
using generate::ModelDraft;
using generate::WindshieldKind;
using generate::WindshieldSpec;

constexpr int kCore = 1, kSkin = 2;
constexpr const char* kHeadformSurface = "headform";

// Adult headform of the regulation: 4.5 kg, 165 mm, 14 mm of vinyl on a metal core [unr127].
constexpr double kMass = 4.5, kRadius = 0.0825, kSkinThickness = 0.014;

/// Centre at the origin. Half the sphere is skin only in the real one; struck side and mass are the
/// same here.
ModelDraft headform(Fidelity fidelity) {
  const int n = fidelity == Fidelity::Coarse ? 6 : 10;
  const int layers = fidelity == Fidelity::Coarse ? 2 : 3;
  const double core = kRadius - kSkinThickness;
  ModelDraft draft;
  draft.title = "Adult headform";
  const generate::CubedSphere sphere(n);
  std::vector<int> surface = add_ball(
      draft.mesh, sphere, [&](const Vec3& p) -> Vec3 { return core * p; },
      [](const generate::BallCell&) { return kCore; });
  for (int layer = 1; layer <= layers; ++layer) {
    const double radius = core + kSkinThickness * layer / layers;
    surface = add_layer(
        draft.mesh, sphere, surface, [](int) { return true; },
        [&](int s) -> Vec3 { return radius * sphere.direction(s); }, kSkin);
  }
  draft.parts.push_back({.id = kCore,
                         .name = "headform_core",
                         .density = 2700,
                         .law = mat::Rigid{.youngs = 70e9, .poisson = 0.3},
                         .section = generate::SolidSection{},
                         .source = "metal core",
                         .grade = generate::Grade::Literature});
  draft.parts.push_back(
      {.id = kSkin,
       .name = "headform_skin",
       .density = 1200,
       .law =
           mat::Viscoelastic{.bulk = 200e6, .shear_short = 14e6, .shear_long = 8e6, .decay = 400},
       .section = generate::SolidSection{},
       .source = "vinyl, set against the certification drop",
       .grade = generate::Grade::Estimate});
  draft.part_sets = {{kHeadformSurface, {kSkin}}};
  const double skin = generate::inertia_of(draft, {kSkin}, false).mass;
  generate::PartSpec& metal = draft.part(kCore);
  metal.density *= (kMass - skin) / generate::inertia_of(draft, {kCore}, false).mass;
  return draft;
}

void move(ModelDraft& draft, const Vec3& by) {
  for (Vec3& p : draft.mesh.nodes) p += by;
}

int body_named(const Model& model, const std::string& name) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].name == name) return static_cast<int>(b);
  CW_ASSERT(false && "rigid part of the case");
  return -1;
}

constexpr double kSampling = 1e-4;  // s; its mean acts like a filter of class 1000

/// What the accelerometer in the core sees.
struct HeadformTrace {
  std::vector<double> time, acceleration;
  Vec3 velocity = Vec3::Zero();
  double before = 0;

  void sample(const State& state, int core) {
    const Vec3 v = state.bodies[core].V_WB.v;
    if (state.time > 0) {
      time.push_back(state.time);
      acceleration.push_back((v - velocity).norm() / (state.time - before));
    }
    velocity = v;
    before = state.time;
  }
  /// Largest sample between two times, g.
  double peak(double from = 0, double to = 1) const {
    double best = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (time[i] >= from && time[i] <= to) best = std::max(best, acceleration[i]);
    return best / kStandardGravity;
  }
  double mean(double from, double to) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      if (time[i] >= from && time[i] <= to) {
        sum += acceleration[i];
        ++count;
      }
    return count > 0 ? sum / count / kStandardGravity : 0;
  }
  Series series(const std::string& label) const {
    Series out{label, {}};
    for (std::size_t i = 0; i < time.size(); ++i)
      out.points.emplace_back(1e3 * time[i], acceleration[i] / kStandardGravity);
    return out;
  }
};

std::string energy_note(const DeckRun& run) {
  const Energies& e = run.state().energies;
  return fmt::format("hourglass {:.1f} % of internal energy, balance {:+.2f} %",
                     e.internal > 0 ? 100 * e.hourglass() / e.internal : 0.0,
                     100 * e.balance_error());
}

struct Impact {
  HeadformTrace trace;
  double deflection = 0, contact_ms = 0, rebound = 0;  ///< m, ms, m/s
  std::string note;
};

double cell_of(Fidelity fidelity) {
  if (fidelity == Fidelity::Coarse) return 0.020;
  return fidelity == Fidelity::Medium ? 0.010 : 0.005;
}

/// The middle of the pane struck at 65 degrees to the ground, as in the regulation; the pane leans
/// 30 degrees, so the blow is within 5 degrees of its normal.
Impact strike(WindshieldKind kind, double speed, const CaseContext& context,
              const std::string& name) {
  constexpr double kEnd = 0.035;
  WindshieldSpec spec;
  spec.kind = kind;
  spec.cell = cell_of(context.fidelity);
  const Pose pane = generate::pane_frame(spec);
  ModelDraft draft = headform(context.fidelity);
  const Vec3 outwards = pane.R().col(2);
  move(draft, pane * Vec3(0.5 * generate::pane_height(spec), 0, 0) + (kRadius + 2e-3) * outwards);
  DeckCase deck(draft, UnitSystem::MmTonneS);
  constexpr double kAngle = 65 * kDegree;
  generate::join_windshield(deck.deck, spec, kHeadformSurface, 0.3);
  const Vec3 way(std::cos(kAngle), 0, -std::sin(kAngle));
  std::vector<int> nodes(draft.mesh.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<int>(n);
  deck.start_velocity(nodes, speed * way);
  for (const Part& part : deck.deck.parts)
    if (part.title == generate::kWindshieldFrame)
      for (int dof = 0; dof < 6; ++dof) deck.guide_part(part.id.value, dof, {{0, 0}, {1, 0}});
  deck.end_at(kEnd);
  DeckRun run(deck.deck, context.folder / name, context.computing);
  Impact out;
  const int core = body_named(run.model(), "headform_core");
  std::vector<int> glass;
  for (const auto& block : run.model().blocks)
    if (run.model().mesh.parts[block->part()].name == "windshield")
      for (int e = 0; e < block->element_count(); ++e)
        for (int c = 0; c < block->corners(); ++c)
          glass.push_back(block->node(e / kLanes, c, e % kLanes));
  std::size_t contact = 0;
  while (run.model().contacts[contact]->name() != generate::kWindshieldContact) ++contact;
  run.run(kEnd, kSampling, [&](const State& state) {
    out.trace.sample(state, core);
    for (const int n : glass)
      out.deflection = std::max(
          out.deflection, -outwards.dot(state.nodes[n].position() - run.model().mesh.position[n]));
    if (run.scratch().contact_reports[contact].force.norm() > 50) out.contact_ms += 1e3 * kSampling;
  });
  out.rebound = run.state().bodies[core].V_WB.v.dot(outwards);
  out.note = energy_note(run);
  return out;
}

void report(const Impact& impact, const std::string& speed, bool breaks, CaseResult& result) {
  const char* source = "headform on windshield, review; scatter +- 30 %";
  const auto add = [&](const char* what, const char* unit, double ours, double reference,
                       double low, double high, Confidence confidence) {
    result.measures.push_back(
        {fmt::format("{}: {}", speed, what), unit, ours, reference, low, high, confidence, source});
  };
  const HeadformTrace& trace = impact.trace;
  if (breaks)
    add("first peak, before 3 ms", "g", trace.peak(0, 0.003), 120, 80, 160, Confidence::Medium);
  add("largest acceleration", "g", trace.peak(), 120, 80, 200, Confidence::Medium);
  add("mean of 8 to 20 ms", "g", trace.mean(0.008, 0.020), 65, 40, 90, Confidence::Medium);
  add("HIC15", "", hic(trace.time, trace.acceleration, 0.015), 425, 250, 1000, Confidence::Medium);
  add("deflection", "mm", 1e3 * impact.deflection, 85, 60, 110, Confidence::Medium);
  add("contact", "ms", impact.contact_ms, 25, 20, 30, Confidence::Medium);
  add("rebound", "m/s", impact.rebound, 2.5, 1, 4, Confidence::Low);
  result.plots.front().series.push_back(trace.series(speed));
  result.notes.push_back(fmt::format("{}: {}", speed, impact.note));
}

CaseResult headform_case(WindshieldKind kind, const char* name, const char* title,
                         const CaseContext& context) {
  CaseResult result{name,
                    title,
                    "adult headform of 4.5 kg on the middle of the pane, 65 degrees to the ground",
                    {},
                    {{"acceleration", title, "time, ms", "acceleration, g", {}}},
                    {}};
  const bool breaks = kind == WindshieldKind::Laminated;
  report(strike(kind, 35 / 3.6, context, "at_35"), "35 km/h", breaks, result);
  report(strike(kind, 40 / 3.6, context, "at_40"), "40 km/h", breaks, result);
  return result;
}

}  // namespace

CaseResult headform_panel(const CaseContext& context) {
  return headform_case(WindshieldKind::Panel, "headform_panel", "headform on the panel", context);
}

CaseResult headform_laminated(const CaseContext& context) {
  return headform_case(WindshieldKind::Laminated, "headform_laminated",
                       "headform on laminated glass", context);
}

// Dropped from 376 mm on a rigid plate a headform has to show 225 to 275 g [unr127].
CaseResult headform_drop(const CaseContext& context) {
  constexpr double kHeight = 0.376, kEnd = 0.006;
  ModelDraft draft = headform(context.fidelity);
  std::vector<int> skin;
  for (const generate::Hex& hex : draft.mesh.hexes)
    if (hex.part == kSkin) skin.insert(skin.end(), hex.node.begin(), hex.node.end());
  DeckCase deck(draft, UnitSystem::MmTonneS);
  deck.add_plane({0, 0, -kRadius - 1e-4}, {0, 0, 1}, skin, 0.3);
  deck.start_velocity({0, 0, -std::sqrt(2 * kStandardGravity * kHeight)});
  deck.end_at(kEnd);
  DeckRun run(deck.deck, context.folder, context.computing);
  const int core = body_named(run.model(), "headform_core");
  HeadformTrace trace;
  run.run(kEnd, kSampling, [&](const State& state) { trace.sample(state, core); });
  CaseResult result{"headform_drop",
                    "headform dropped on a rigid plate from 376 mm",
                    "the skin's stiffness was set against this test",
                    {},
                    {{"acceleration", "Headform drop", "time, ms", "acceleration, g", {}}},
                    {energy_note(run)}};
  result.measures.push_back(
      {"peak", "g", trace.peak(), 250, 225, 275, Confidence::High, "[unr127]"});
  result.plots.front().series.push_back(trace.series("adult headform"));
  return result;
}

// A mass that strikes a plate loses its speed as v0 exp(-t Z / m), Z = 8 sqrt(D rho h), until the
// first wave is back from the edge.
CaseResult plate_impedance(const CaseContext& context) {
  constexpr double kSide = 1.0, kThickness = 0.005, kYoungs = 70e9, kPoisson = 0.23,
                   kDensity = 2500, kSpeed = 1, kEnd = 0.0012;
  const int cells = context.fidelity == Fidelity::Coarse ? 50 : 100;
  ModelDraft draft;
  draft.title = "Plate";
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j)
      draft.mesh.add_node({kSide * (1.0 * i / cells - 0.5), kSide * (1.0 * j / cells - 0.5), 0});
  const auto node = [cells](int i, int j) { return i * (cells + 1) + j; };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      draft.mesh.quads.push_back(
          {{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}, kCore});
  draft.parts.push_back({.id = kCore,
                         .name = "plate",
                         .density = kDensity,
                         .law = mat::Elastic{.youngs = kYoungs, .poisson = kPoisson},
                         .section = generate::ShellSection{.thickness = kThickness, .points = 2},
                         .source = "glass",
                         .grade = generate::Grade::Literature});
  const int centre = node(cells / 2, cells / 2);
  draft.mesh.masses.push_back({centre, kMass});
  std::vector<int> edge;
  for (int i = 0; i <= cells; ++i)
    for (const int k : {node(i, 0), node(i, cells), node(0, i), node(cells, i)}) edge.push_back(k);
  DeckCase deck(draft, UnitSystem::MmTonneS);
  deck.fix_nodes(edge);
  deck.start_velocity({centre}, {0, 0, -kSpeed});
  deck.end_at(kEnd);
  DeckRun run(deck.deck, context.folder, context.computing);
  const double D = kYoungs * std::pow(kThickness, 3) / 12 / (1 - kPoisson * kPoisson);
  const double Z = 8 * std::sqrt(D * kDensity * kThickness);
  Series ours{"mass on the plate", {}}, exact{"closed form", {}};
  double worst = 0;
  run.run(kEnd, 2e-5, [&](const State& state) {
    const double v = -state.nodes[run.node_of(centre)].velocity().z();
    const double wanted = kSpeed * std::exp(-state.time * Z / kMass);
    ours.points.emplace_back(1e3 * state.time, v);
    exact.points.emplace_back(1e3 * state.time, wanted);
    if (state.time > 3e-4) worst = std::max(worst, std::abs((kSpeed - v) / (kSpeed - wanted) - 1));
  });
  CaseResult result{"plate_impedance",
                    "mass of 4.5 kg on a glass plate of 1 m, 5 mm: speed lost",
                    "speed lost against that of an endless thin plate, 0.3 to 1.2 ms",
                    {},
                    {{"speed", "Mass on a plate", "time, ms", "speed, m/s", {ours, exact}}},
                    {energy_note(run)}};
  result.measures.push_back({"largest error of the speed lost", "%", 100 * worst, 0, 0, 5,
                             Confidence::ClosedForm, "8 sqrt(D rho h)"});
  return result;
}

}  // namespace crosswalk::fe::validate
