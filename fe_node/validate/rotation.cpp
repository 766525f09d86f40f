#include "fe_node/validate/rotation.h"

#include <algorithm>
#include <cmath>

#include "common/damage_constants.h"
#include "common/units.h"
#include "fe_node/output/tissue_metrics.h"

namespace crosswalk::fe::validate {
namespace {

constexpr double kCurveStep = 1e-4;  // s, of load curves

double acceleration_peak(double peak, double rise) { return peak * kPi / (2 * rise); }

/// Integral of a half-sine acceleration that reaches `peak` at `rise`.
double half_sine_speed(double t, double peak, double rise) {
  if (t <= 0) return 0;
  if (t >= rise) return peak;
  return acceleration_peak(peak, rise) * rise / kPi * (1 - std::cos(kPi * t / rise));
}

/// Adds the motion of a part whose mass centre is at `com`: turning about the axis through the
/// pivot.
void guide(DeckCase& deck, int part, const Rotation& rotation, const Vec3& com) {
  Points turn, along[3];
  double angle = 0;
  for (double t = 0; t < rotation.end + 2 * kCurveStep; t += kCurveStep) {
    const Vec3 omega = rotation.speed(t) * Vec3::Unit(rotation.axis);
    const Vec3 arm = exp_rotation(angle * Vec3::Unit(rotation.axis)) * (com - rotation.pivot);
    const Vec3 v = omega.cross(arm);
    turn.emplace_back(t, rotation.speed(t));
    for (int i = 0; i < 3; ++i) along[i].emplace_back(t, v[i]);
    angle += kCurveStep * rotation.speed(t + 0.5 * kCurveStep);
  }
  const Points rest{{0, 0}, {rotation.end, 0}};
  for (int i = 0; i < 3; ++i) {
    deck.guide_part(part, i, along[i]);
    deck.guide_part(part, 3 + i, i == rotation.axis ? turn : rest);
  }
}

}  // namespace

std::function<double(double)> ramp_and_hold(double peak, double rise) {
  return [=](double t) { return half_sine_speed(t, peak, rise); };
}

std::function<double(double)> up_and_down(double peak, double rise) {
  return [=](double t) {
    return half_sine_speed(t, peak, rise) - half_sine_speed(t - rise, peak, rise);
  };
}

BrainResponse turn_skull(const generate::HeadNeck& whole, const Rotation& rotation,
                         const std::vector<Vec3>& points, const CaseContext& context,
                         const std::string& sub_folder) {
  const generate::ModelDraft draft = rigid_skull_head(whole);
  const std::vector<int> brain = parts_of_set(draft, "brain");
  DeckCase deck(draft, UnitSystem::MmTonneS);
  // Where the solver puts the body's frame: the centre of the rigid bricks and of the nodal masses
  // of the tissue on them. Found from the model itself, then guided.
  Vec3 com = Vec3::Zero();
  {
    const DeckRun trial(deck.deck, context.folder / sub_folder, {});
    com = trial.model().bodies.front().origin;
  }
  guide(deck, rigid_skull_part(), rotation, com);
  deck.end_at(rotation.end);
  DeckRun run(deck.deck, context.folder / sub_folder, context.computing, 0.02);

  std::vector<int> brain_parts;
  const BuiltModel& built = run.built();
  brain_parts = built.part_sets[built.part_set("brain")].second;
  const TissueMetrics metrics(run.model(), {{"brain", brain_parts}});
  StrainPeaks peaks = metrics.no_peaks();
  std::vector<TissuePoint> probes;
  for (const Vec3& p : points) probes.push_back(tissue_point(draft, brain, p));

  BrainResponse response;
  response.displacement.resize(points.size());
  std::vector<Vec3> start;
  TissueSample last;
  run.run(rotation.end, 2.5e-4, [&](const State& state) {
    const Pose X_BW = state.bodies.front().X_WB.inverse();
    response.time.push_back(state.time);
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const Vec3 p = X_BW * probes[i].position(run);
      if (start.size() <= i) start.push_back(p);
      response.displacement[i].push_back(p - start[i]);
    }
    last = metrics.sample(run.model(), state, 0, peaks);
    response.mps_95.push_back(last.regions.front().mps_95);
  });
  response.mps_95_peak = last.regions.front().mps_95_so_far;
  response.csdm_15 = last.regions.front().csdm_15;
  response.csdm_25 = last.regions.front().csdm_25;
  const Energies& e = run.state().energies;
  response.hourglass_share = e.internal > 0 ? e.hourglass() / e.internal : 0;
  response.balance = e.balance_error();
  return response;
}

// x'' + a1 k x' + k x = alpha, x the lag of the brain's mass; semi-implicit steps far below its
// period of about 40 ms. The weak coupling of the x and z masses is left out.
double damage_of(const Rotation& rotation) {
  const double k =
      damage::kStiffness[rotation.axis] + (rotation.axis == 1 ? 0 : damage::kStiffnessXZ);
  constexpr double kStep = 1e-5;
  double x = 0, v = 0, largest = 0;
  for (double t = 0; t < rotation.end; t += kStep) {
    v += rotation.speed(t + kStep) - rotation.speed(t) -
         kStep * k * (damage::kStiffnessDamping * v + x);
    x += kStep * v;
    largest = std::max(largest, std::abs(x));
  }
  return damage::kScale * largest;
}

}  // namespace crosswalk::fe::validate
