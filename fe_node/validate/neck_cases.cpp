// The neck: ranges of motion of the ligamentous spine, and the head on a driven first thoracic
// vertebra.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.h"
#include "common/units.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/spine.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

namespace part = generate::part;

generate::HeadNeck reference_neck(generate::Fidelity fidelity) {
  generate::HeadNeckSpec spec;
  spec.fidelity = fidelity;
  return generate::build_head_neck(spec);
}

bool is_muscle(int id) { return id >= part::kFirstMuscle && id < part::kFlesh; }
bool is_block(int id) {
  return id == part::kBlockTorsoUp || id == part::kBlockClavicleLeft ||
         id == part::kBlockClavicleRight;
}

/// Spine with discs, ligaments and joints; the occiput alone stands for the head.
generate::ModelDraft ligamentous_spine(const generate::HeadNeck& whole) {
  const std::vector<int> head = parts_of_set(whole.draft, "head");
  std::vector<int> parts;
  for (const generate::PartSpec& spec : whole.draft.parts) {
    const bool of_head = std::find(head.begin(), head.end(), spec.id) != head.end();
    if (is_muscle(spec.id) || spec.id == part::kFlesh) continue;
    if (is_block(spec.id) && spec.id != part::kBlockTorsoUp) continue;
    if (!of_head || spec.id == rigid_skull_part()) parts.push_back(spec.id);
  }
  return extract(whole.draft, parts);
}

/// The whole neck under a head that is one rigid body.
generate::ModelDraft neck_with_rigid_head(const generate::HeadNeck& whole) {
  generate::ModelDraft draft = whole.draft;
  const std::vector<int> head = parts_of_set(draft, "head");
  const auto of_head = [&](int id) {
    return std::find(head.begin(), head.end(), id) != head.end();
  };
  // One density for one rigid part: the mass of the head stays, its centre nearly.
  const Inertia wanted = generate::inertia_of(draft, head, true);
  for (generate::Hex& hex : draft.mesh.hexes)
    if (of_head(hex.part)) hex.part = rigid_skull_part();
  draft.mesh.masses.clear();
  std::erase_if(draft.mesh.quads, [&](const generate::Quad& q) { return of_head(q.part); });
  std::vector<int> parts;
  for (const generate::PartSpec& spec : draft.parts)
    if (!of_head(spec.id) || spec.id == rigid_skull_part()) parts.push_back(spec.id);
  generate::ModelDraft out = extract(draft, parts);
  generate::PartSpec& rigid = out.part(rigid_skull_part());
  rigid.density *= wanted.mass / generate::inertia_of(out, {rigid_skull_part()}, false).mass;
  return out;
}

int body_named(const DeckRun& run, const std::string& name) {
  const std::vector<RigidBody>& bodies = run.model().bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].name == name) return static_cast<int>(b);
  CW_ASSERT(false && "rigid part of the generator");
  return -1;
}

std::vector<int> spine_bodies(const DeckRun& run, const generate::ModelDraft& draft) {
  std::vector<int> bodies;
  for (int level = generate::C0; level <= generate::C7; ++level)
    bodies.push_back(body_named(run, draft.part(rigid_skull_part() + 10 * level).name));
  return bodies;
}

constexpr const char* kLevels[] = {"C0-C1", "C1-C2", "C2-C3", "C3-C4", "C4-C5", "C5-C6", "C6-C7"};

/// Turning of the upper body in the lower one about an axis, seen along it: of z in the sagittal
/// and the frontal plane, of x in the transverse plane. Coupled turning leaves it alone.
double angle_about(int axis, const BodyState& upper, const BodyState& lower) {
  const Mat3 R = (lower.X_WB.q.conjugate() * upper.X_WB.q).toRotationMatrix();
  if (axis == 0) return std::atan2(-R(1, 2), R(2, 2));
  if (axis == 1) return std::atan2(R(0, 2), R(2, 2));
  return std::atan2(R(1, 0), R(0, 0));
}

/// Turns the occiput about one axis, all else free, until the moment is reached; the moment is the
/// work done per angle. Returns the angle of each level at that moment, rad.
std::vector<double> angles_at(const generate::ModelDraft& draft, int axis, double sense,
                              double moment, const std::filesystem::path& folder, int threads,
                              Series& curve) {
  constexpr double kRate = 4, kRise = 0.020, kWindow = 0.004, kLongest = 0.45;  // rad/s, s, s, s
  constexpr double kDamping = 60;  // 1/s, on masses; bears 3 % of the moment at most [E]
  DeckCase deck(draft, UnitSystem::MmTonneS);
  deck.guide_part(rigid_skull_part(), 3 + axis,
                  {{0, 0}, {kRise, sense * kRate}, {kLongest, sense * kRate}});
  for (int dof = 0; dof < 6; ++dof)
    deck.guide_part(part::kBlockTorsoUp, dof, {{0, 0}, {kLongest, 0}});
  Damping damping;
  damping.value = kDamping * unit_factors(UnitSystem::MmTonneS).time;
  deck.deck.dampings.push_back(damping);
  deck.end_at(kLongest);
  DeckRun run(deck.deck, folder, threads, 0.02);
  const std::vector<int> bodies = spine_bodies(run, draft);
  const auto level_angles = [&](const State& state) {
    std::vector<double> out;
    for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
      out.push_back(sense *
                    angle_about(axis, state.bodies[bodies[i]], state.bodies[bodies[i + 1]]));
    return out;
  };
  double work = 0, turned = 0, before_moment = 0;
  std::vector<double> before(bodies.size() - 1, 0.0), answer;
  bool is_reached = false;
  run.run(kLongest, kWindow, [&](const State& state) {
    if (is_reached || state.time == 0) return;
    // Of the prescribed speed: the work is the moment times this angle, however the head tilts.
    const double turn = kRate * (state.time < kRise ? state.time * state.time / (2 * kRise)
                                                    : state.time - 0.5 * kRise);
    const Energies& e = state.energies;
    const double useful = e.external_work - e.damping - e.kinetic;
    const double now = (useful - work) / std::max(turn - turned, 1e-9);
    const std::vector<double> angles = level_angles(state);
    curve.points.emplace_back(turn / kDegree, now);
    if (now >= moment && state.time > kRise) {
      const double share = (moment - before_moment) / (now - before_moment);
      for (std::size_t i = 0; i < angles.size(); ++i)
        answer.push_back(before[i] + std::clamp(share, 0.0, 1.0) * (angles[i] - before[i]));
      is_reached = true;
    }
    before_moment = now;
    before = angles;
    work = useful;
    turned = turn;
  });
  return is_reached ? answer
                    : std::vector<double>(before.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

// Whole cervical spines under 1 N m, both directions together [panjabi2001]: mean and deviation.
CaseResult neck_ranges(const CaseContext& context) {
  const generate::HeadNeck neck = reference_neck(context.fidelity);
  const generate::ModelDraft draft = ligamentous_spine(neck);
  struct Motion {
    const char* name;
    int axis;
    double mean[7], deviation[7];
  };
  const Motion motions[] = {{"flexion and extension",
                             1,
                             {27.4, 24.4, 6.8, 8.2, 9.8, 10.4, 8.0},
                             {3.7, 5.6, 1.4, 4.7, 4.0, 5.2, 4.3}},
                            {"lateral, both",
                             0,
                             {9.1, 6.5, 9.6, 9.0, 9.3, 6.5, 5.4},
                             {1.5, 2.3, 1.8, 1.9, 1.7, 1.5, 1.5}},
                            {"axial, both",
                             2,
                             {9.9, 56.7, 3.3, 5.1, 6.8, 5.0, 2.9},
                             {3.0, 4.8, 1.2, 1.2, 1.3, 1.0, 0.8}}};
  CaseResult result{
      "neck_ranges",
      "ranges of motion of the ligamentous neck at 1 N m",
      "occiput turned slowly, torso block held, no muscles and flesh; disc moduli and "
      "joint gaps were set against these ranges",
      {},
      {{"moment", "Moment and angle of the occiput", "angle, deg", "moment, N m", {}}},
      {}};
  for (const Motion& m : motions) {
    std::vector<double> total(7, 0.0);
    for (const double sense : {1.0, -1.0}) {
      // Both sides are mirror images but for the sagittal plane.
      if (m.axis != 1 && sense < 0) break;
      Series curve{fmt::format("{} {}", m.name, sense > 0 ? "+" : "-"), {}};
      const std::vector<double> angles = angles_at(
          draft, m.axis, sense, 1.0,
          context.folder / fmt::format("axis_{}_{}", m.axis, sense > 0 ? "plus" : "minus"),
          context.threads, curve);
      for (int i = 0; i < 7; ++i) total[i] += (m.axis == 1 ? 1 : 2) * angles[i] / kDegree;
      result.plots.front().series.push_back(curve);
    }
    double sum = 0, sum_mean = 0;
    for (int i = 0; i < 7; ++i) {
      result.measures.push_back({fmt::format("{} {}", kLevels[i], m.name), "deg", total[i],
                                 m.mean[i], m.mean[i] - 2 * m.deviation[i],
                                 m.mean[i] + 2 * m.deviation[i], Confidence::High,
                                 "[panjabi2001]"});
      sum += total[i];
      sum_mean += m.mean[i];
    }
    result.measures.push_back({fmt::format("C0-C7 {}", m.name), "deg", sum, sum_mean,
                               0.75 * sum_mean, 1.25 * sum_mean, Confidence::High,
                               "[panjabi2001]"});
  }
  return result;
}

namespace {

struct Sled {
  int axis = 0;                            ///< of the acceleration
  double sense = -1;                       ///< of the acceleration along it
  int roll_axis = 1;                       ///< of the vertebra's own turning
  double roll = 0;                         ///< rad, signed
  double peak = 0, start = 0, length = 0;  ///< m/s2, s, s: half a sine
  double after = 0, after_length = 0;      ///< m/s2, s: what follows it
  double end = 0.2;
};

struct HeadPath {
  std::vector<double> time;
  std::vector<Vec3> centre, turned;  ///< of the head against T1, world axes, m and rad
  std::vector<double> acceleration;  ///< m/s2, mean over the samples
  std::string note;
};

HeadPath ride(const Sled& sled, const CaseContext& context) {
  const generate::HeadNeck neck = reference_neck(context.fidelity);
  const generate::ModelDraft draft = neck_with_rigid_head(neck);
  DeckCase deck(draft, UnitSystem::MmTonneS);
  Points along, turn;
  double v = 0;
  constexpr double kStep = 5e-4;
  for (double t = 0; t < sled.end + 2 * kStep; t += kStep) {
    along.emplace_back(t, v);
    const double s = t + 0.5 * kStep - sled.start;
    double a = 0;
    if (s > 0 && s < sled.length)
      a = sled.peak * std::sin(kPi * s / sled.length);
    else if (s >= sled.length && s < sled.length + sled.after_length)
      a = sled.after;
    v += kStep * sled.sense * a;
    // The vertebra turns smoothly during the pulse.
    const double w = t - sled.start;
    turn.emplace_back(t, w > 0 && w < sled.length
                             ? sled.roll / sled.length * (1 - std::cos(2 * kPi * w / sled.length))
                             : 0);
  }
  const Points rest{{0, 0}, {sled.end, 0}};
  for (const int block : {part::kBlockTorsoUp, part::kBlockClavicleLeft, part::kBlockClavicleRight})
    for (int dof = 0; dof < 6; ++dof)
      deck.guide_part(block, dof,
                      dof == sled.axis            ? along
                      : dof == 3 + sled.roll_axis ? turn
                                                  : rest);
  deck.end_at(sled.end);
  DeckRun run(deck.deck, context.folder, context.threads, 0.02);
  const int head = body_named(run, draft.part(rigid_skull_part()).name);
  const int t1 = body_named(run, draft.part(part::kFirstVertebra + 70).name);
  HeadPath path;
  Vec3 start = Vec3::Zero(), before = Vec3::Zero();
  double last = 0;
  run.run(sled.end, 1e-3, [&](const State& state) {
    const Vec3 d = state.bodies[head].X_WB.p - state.bodies[t1].X_WB.p;
    if (state.time == 0) start = d;
    path.time.push_back(state.time);
    path.centre.push_back(d - start);
    path.turned.push_back(log_rotation(state.bodies[head].X_WB.q));
    const Vec3 speed = state.bodies[head].V_WB.v;
    if (state.time > 0) path.acceleration.push_back((speed - before).norm() / (state.time - last));
    before = speed;
    last = state.time;
  });
  const Energies& e = run.state().energies;
  path.note = fmt::format(
      "rigid head of {:.2f} kg; hourglass {:.1f} % of internal energy, balance "
      "{:+.2f} %",
      run.model().bodies[head].inertia.mass,
      e.internal > 0 ? 100 * e.hourglass() / e.internal : 0.0, 100 * e.balance_error());
  return path;
}

/// Extreme of a component, signed, and its time in ms.
std::pair<double, double> extreme(const std::vector<double>& time, const std::vector<Vec3>& of,
                                  int axis) {
  double best = 0, when = 0;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (std::abs(of[i][axis]) > std::abs(best)) {
      best = of[i][axis];
      when = time[i];
    }
  return {best, 1e3 * when};
}

Plot path_plot(const HeadPath& path, const char* title, int side, int roll) {
  Plot plot{"head", title, "time, ms", "head against T1, mm and deg", {}};
  Series across{"displacement along the pulse, mm", {}}, down{"vertical, mm", {}},
      angle{"angle, deg", {}};
  for (std::size_t i = 0; i < path.time.size(); ++i) {
    across.points.emplace_back(1e3 * path.time[i], 1e3 * path.centre[i][side]);
    down.points.emplace_back(1e3 * path.time[i], 1e3 * path.centre[i].z());
    angle.points.emplace_back(1e3 * path.time[i], path.turned[i][roll] / kDegree);
  }
  plot.series = {across, down, angle};
  return plot;
}

}  // namespace

// ISO/TR 9790 neck test 1. No T1 trace is at hand: half a sine of 15 g over 60 ms with 6 degrees of
// roll [E], so the windows are widened by 30 %.
CaseResult neck_lateral(const CaseContext& context) {
  const HeadPath path = ride({.axis = 1,
                              .sense = 1,
                              .roll_axis = 0,
                              .roll = 6 * kDegree,
                              .peak = 15 * kStandardGravity,
                              .start = 0.040,
                              .length = 0.060,
                              .after = -2 * kStandardGravity,
                              .after_length = 0.060,
                              .end = 0.2},
                             context);
  CaseResult result{
      "neck_lateral",
      "head on a passive neck, lateral sled of 7 g",
      "T1 driven by half a sine of 15 g, 60 ms [E]; windows of the test widened by 30 %",
      {},
      {path_plot(path, "Lateral 7 g", 1, 0)},
      {path.note}};
  const auto [y, t_y] = extreme(path.time, path.centre, 1);
  const auto [z, t_z] = extreme(path.time, path.centre, 2);
  const auto [flexion, t_f] = extreme(path.time, path.turned, 0);
  const auto [twist, t_t] = extreme(path.time, path.turned, 2);
  const char* source = "[iso9790] neck test 1; drive [E]";
  result.measures = {
      {"lateral displacement of the head", "mm", 1e3 * std::abs(y), 146, 91, 211,
       Confidence::Medium, source},
      {"downward displacement of the head", "mm", 1e3 * std::abs(z), 79, 45, 122,
       Confidence::Medium, source},
      {"time of the largest excursion", "ms", t_y, 167, 111, 228, Confidence::Medium, source},
      {"largest lateral angle", "deg", std::abs(flexion) / kDegree, 51, 31, 77, Confidence::Medium,
       source},
      {"largest twist", "deg", std::abs(twist) / kDegree, 38, 22, 59, Confidence::Low, source}};
  return result;
}

CaseResult neck_frontal(const CaseContext& context) {
  const HeadPath path = ride({.axis = 0,
                              .sense = -1,
                              .roll_axis = 1,
                              .roll = 22 * kDegree,
                              .peak = 28 * kStandardGravity,
                              .start = 0.030,
                              .length = 0.097,
                              .after = 0,
                              .after_length = 0,
                              .end = 0.2},
                             context);
  CaseResult result{"neck_frontal",
                    "head on a passive neck, frontal sled of 15 g",
                    "T1 driven by half a sine of 28 g, 97 ms, with 22 degrees of rotation [E]",
                    {},
                    {path_plot(path, "Frontal 15 g", 0, 1)},
                    {path.note}};
  double x = 0;  // forwards only: past a right angle the head swings back under the neck
  for (const Vec3& d : path.centre) x = std::max(x, d.x());
  const auto [z, t_z] = extreme(path.time, path.centre, 2);
  const auto [flexion, t_f] = extreme(path.time, path.turned, 1);
  const double peak =
      *std::max_element(path.acceleration.begin(), path.acceleration.end()) / kStandardGravity;
  const char* source = "[thunnissen1995]; drive [E]";
  result.measures = {
      {"forward displacement of the head", "mm", 1e3 * x, 180, 160, 200, Confidence::Low, source},
      {"downward displacement of the head", "mm", -1e3 * z, 145, 120, 170, Confidence::Low, source},
      {"largest flexion", "deg", flexion / kDegree, 87, 75, 100, Confidence::Low, source},
      {"time of it", "ms", t_f, 150, 140, 160, Confidence::Low, source},
      {"peak acceleration of the head", "g", peak, 30, 25, 35, Confidence::Low, source}};
  return result;
}

}  // namespace crosswalk::fe::validate
