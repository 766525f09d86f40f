// Closed forms of a ball of brain in a rigid shell.
#include <algorithm>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/generate/tissues.h"
#include "fe_node/output/tissue_metrics.h"
#include "fe_node/validate/deck_case.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

using Complex = std::complex<double>;

constexpr double kRadius = 0.070, kDensity = 1040;                    // m, kg/m3
constexpr double kShearShort = 6e3, kShearLong = 1.2e3, kDecay = 80;  // Pa, Pa, 1/s
/// A hundredth of water's: torsion does not change volumes, and the step is ten times larger.
constexpr double kBulk = 0.01 * generate::kWaterBulk;
constexpr int kBall = 1, kShell = 2;

/// The closed forms are asked at no less than 22 cells, whatever the size of the head.
int cells(generate::Fidelity fidelity) { return fidelity == generate::Fidelity::Fine ? 28 : 22; }

generate::ModelDraft ball_in_shell(int n, double bulk) {
  generate::ModelDraft draft;
  draft.title = "Ball of brain in a rigid shell";
  const generate::CubedSphere sphere(n);
  const std::vector<int> surface = generate::add_ball(
      draft.mesh, sphere, [](const Vec3& p) -> Vec3 { return kRadius * p; },
      [](const generate::BallCell&) { return kBall; });
  generate::add_layer(
      draft.mesh, sphere, surface, [](int) { return true; },
      [&](int s) -> Vec3 { return 1.05 * kRadius * sphere.direction(s); }, kShell);
  draft.parts = {
      {.id = kBall,
       .name = "ball",
       .density = kDensity,
       .law =
           mat::Viscoelastic{
               .bulk = bulk, .shear_short = kShearShort, .shear_long = kShearLong, .decay = kDecay},
       .section = generate::SolidSection{.hourglass = 0},
       .source = "",
       .grade = generate::Grade::Literature},
      {.id = kShell,
       .name = "shell",
       .density = 2000,
       .law = mat::Rigid{.youngs = 1e10, .poisson = 0.3},
       .section = generate::SolidSection{},
       .source = "",
       .grade = generate::Grade::Estimate}};
  return draft;
}

/// Spherical Bessel function of order one.
Complex j1(Complex z) { return std::sin(z) / (z * z) - std::cos(z) / z; }

/// Turning at radius r over that of the shell, which turns as exp(i omega t).
Complex turning_ratio(double r, double frequency) {
  const double omega = 2 * kPi * frequency;
  const Complex i(0, 1);
  const Complex modulus =
      kShearLong + (kShearShort - kShearLong) * i * omega / (i * omega + kDecay);
  const Complex k = omega / std::sqrt(modulus / kDensity);
  return j1(k * r) / j1(k * kRadius) * kRadius / r;
}

/// Node of the core or shells on the x axis nearest to a radius.
int node_on_axis(const generate::MeshDraft& mesh, double radius) {
  int best = 0;
  double nearest = 1;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    const double distance = (mesh.nodes[n] - Vec3(radius, 0, 0)).norm();
    if (distance < nearest) {
      nearest = distance;
      best = n;
    }
  }
  return best;
}

struct Probe {
  int node = 0;
  double radius = 0;
  Complex sum = 0;
};

}  // namespace

// u(r) / u(R) = j1(k r) / j1(k R) with the complex shear modulus; the last whole period after the
// start has died out is projected on exp(i omega t).
CaseResult sphere_torsion(const CaseContext& context) {
  constexpr double kFrequency = 20, kAmplitude = 0.02;  // Hz, rad
  constexpr int kPeriods = 5;
  constexpr double kAmplitudeTolerance = 0.05, kPhaseTolerance_deg = 8;
  const int n = cells(context.fidelity);
  const generate::ModelDraft draft = ball_in_shell(n, kBulk);
  DeckCase deck(draft, UnitSystem::MmTonneS);
  const double omega = 2 * kPi * kFrequency, end = kPeriods / kFrequency;
  Points turning;
  for (double t = 0; t < end + 1e-4; t += 2e-4)
    turning.emplace_back(t, kAmplitude * omega * std::cos(omega * t));
  for (int axis = 0; axis < 6; ++axis)
    deck.guide_part(kShell, axis, axis == 5 ? turning : Points{{0, 0}, {end, 0}});
  deck.end_at(end);
  DeckRun run(deck.deck, context.folder, context.computing);
  std::vector<Probe> probes;
  for (double share : {0.25, 0.50, 0.80}) {
    const int node = node_on_axis(draft.mesh, share * kRadius);
    probes.push_back({node, draft.mesh.nodes[node].x(), 0});
  }
  Plot plot{"turning", "Ball in an oscillating shell, 20 Hz", "time, ms", "turning, rad", {}};
  for (const Probe& p : probes)
    plot.series.push_back({fmt::format("r/R = {:.2f}", p.radius / kRadius), {}});
  const double last = (kPeriods - 1) / kFrequency;
  double before = 0;
  run.run(end, 0, [&](const State& state) {
    const double dt = state.time - before;
    before = state.time;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const double turned =
          state.nodes[run.node_of(probes[i].node)].position().y() / probes[i].radius;
      if (state.time > last)
        probes[i].sum += 2 * kFrequency * dt * turned * std::exp(Complex(0, -omega * state.time));
      if (state.step % 100 == 0) plot.series[i].points.emplace_back(1e3 * state.time, turned);
    }
  });
  CaseResult result{"sphere_torsion",
                    "viscoelastic ball in a rigid shell that oscillates about an axis, 20 Hz",
                    fmt::format("R 70 mm, G0 6, Ginf 1.2 kPa, 80 1/s, {} cells along an edge, {} "
                                "periods; bulk modulus 1/100",
                                n, kPeriods),
                    {},
                    {plot},
                    {}};
  // The shell's turning is A sin(omega t) = Re(-i A exp(i omega t)).

  for (const Probe& p : probes) {
    const Complex ours = p.sum / (kAmplitude * Complex(0, -1)),
                  exact = turning_ratio(p.radius, kFrequency);
    const double to_shell = p.radius / kRadius;
    const double amplitude = std::abs(exact) * to_shell, phase = std::arg(exact) / kDegree;
    result.measures.push_back(
        {fmt::format("displacement ratio at r/R {:.3f}", to_shell), "", std::abs(ours) * to_shell,
         amplitude, amplitude * (1 - kAmplitudeTolerance), amplitude * (1 + kAmplitudeTolerance),
         Confidence::ClosedForm, "j1(kr)/j1(kR)"});
    result.measures.push_back({fmt::format("phase at r/R {:.3f}", to_shell), "deg",
                               std::arg(ours) / kDegree, phase, phase - kPhaseTolerance_deg,
                               phase + kPhaseTolerance_deg, Confidence::ClosedForm,
                               "j1(kr)/j1(kR)"});
  }
  return result;
}

namespace {

constexpr double kPatch = 0.015;  // m, radius over which pressure is averaged

/// Pressure at a point of the x axis from the cells of a patch round it: sum p / sum x times x, Pa.
double pressure_near(const DeckRun& run, double x) {
  const State& state = run.state();
  const StepContext context{state.nodes, state.spin, state.time, 0, false};
  double pressure = 0, places = 0;
  for (std::size_t b = 0; b < run.model().blocks.size(); ++b) {
    const ElementBlock& block = *run.model().blocks[b];
    for (int e = 0; e < block.element_count(); ++e) {
      Vec3 centre = Vec3::Zero();
      for (int c = 0; c < 8; ++c)
        centre += run.model().mesh.position[block.node(e / kLanes, c, e % kLanes)] / 8;
      if ((centre - Vec3(x, 0, 0)).norm() >= kPatch) continue;
      pressure -= block.sample(context, state.history[b], e).stress.trace() / 3;
      places += centre.x();
    }
  }
  return places == 0 ? 0 : pressure / places * x;
}

}  // namespace

// In a rigid shell that accelerates evenly the pressure is -rho a x: the tissue is pulled at the
// front and pushed at the back.
CaseResult sphere_pressure(const CaseContext& context) {
  constexpr double kAcceleration = 1000, kRise = 8e-3, kEnd = 12e-3;  // m/s2, s, s
  const int n = cells(context.fidelity);
  const generate::ModelDraft draft = ball_in_shell(n, generate::kBrainBulk);
  DeckCase deck(draft, UnitSystem::MmTonneS);
  Points speed;
  double v = 0;
  constexpr double kStep = 5e-5;
  for (double t = 0; t < kEnd + 2 * kStep; t += kStep) {
    speed.emplace_back(t, v);
    const double middle = std::min(1.0, (t + 0.5 * kStep) / kRise);
    v += kStep * kAcceleration * 0.5 * (1 - std::cos(kPi * middle));
  }
  for (int axis = 0; axis < 6; ++axis)
    deck.guide_part(kShell, axis, axis == 0 ? speed : Points{{0, 0}, {kEnd, 0}});
  deck.end_at(kEnd);
  DeckRun run(deck.deck, context.folder, context.computing);
  Plot plot{"pressure",
            "Ball in a shell accelerated to 1000 m/s2",
            "time, ms",
            "pressure, kPa",
            {{"front", {}}, {"back", {}}}};
  const TissueMetrics metrics(run.model(), {{"ball", {0}}});
  StrainPeaks peaks = metrics.no_peaks();
  double front = 0, back = 0, strain = 0;
  int count = 0;
  run.run(kEnd, 2e-5, [&](const State& state) {
    const double at_front = 1e-3 * pressure_near(run, kRadius);
    const double at_back = 1e-3 * pressure_near(run, -kRadius);
    plot.series[0].points.emplace_back(1e3 * state.time, at_front);
    plot.series[1].points.emplace_back(1e3 * state.time, at_back);
    if (state.time < kRise + 1e-3) return;
    if (count % 20 == 0)  // strain changes slowly and costs more than a step
      strain = metrics.sample(run.model(), state, 0, peaks).regions.front().mps_95_so_far;
    front += at_front;
    back += at_back;
    ++count;
  });
  const double exact = 1e-3 * kDensity * kAcceleration * kRadius;
  CaseResult result{"sphere_pressure",
                    "pressure in a ball of brain in an accelerated rigid shell",
                    fmt::format("R 70 mm, 1000 m/s2 reached in 8 ms, {} cells along an edge", n),
                    {},
                    {plot},
                    {}};
  result.measures.push_back({"pressure at the back pole", "kPa", back / count, exact, 0.95 * exact,
                             1.05 * exact, Confidence::ClosedForm, "rho a R"});
  result.measures.push_back({"pressure at the front pole", "kPa", front / count, -exact,
                             -1.05 * exact, -0.95 * exact, Confidence::ClosedForm, "-rho a R"});
  result.notes.push_back(fmt::format(
      "MPS95 {:.3f} in pure translation, exactly 0 in the continuum: error of the mesh",
      strain));
  return result;
}

}  // namespace crosswalk::fe::validate
