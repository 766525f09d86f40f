// The neck: ranges of motion of the ligamentous spine, and the head on a driven first thoracic
// vertebra.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/neck_moment.h"
#include "fe_node/validate/neck_trunk.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

namespace part = generate::part;

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
      "occiput turned slowly, torso block held, no muscles and flesh; the toe of annulus fibres, "
      "facet and joint gaps were set against these ranges",
      {},
      {{"moment", "Moment and angle of the occiput", "angle, deg", "moment, N m", {}}},
      {}};
  for (const Motion& m : motions) {
    std::vector<double> total(7, 0.0);
    for (const double sense : {1.0, -1.0}) {
      // Both sides are mirror images but for the sagittal plane.
      if (m.axis != 1 && sense < 0) break;
      const Turning turning{.part = rigid_skull_part(),
                            .held = {part::kBlockTorsoUp},
                            .axis = m.axis,
                            .sense = sense,
                            .last_angle = 1.8};
      const std::vector<MomentSample> samples = turn_slowly(
          draft, turning,
          context.folder / fmt::format("axis_{}_{}", m.axis, sense > 0 ? "plus" : "minus"),
          context.computing);
      Series curve{fmt::format("{} {}", m.name, sense > 0 ? "+" : "-"), {}};
      for (const MomentSample& s : samples) curve.points.emplace_back(s.turned / kDegree, s.moment);
      std::vector<double> angles = at_moment(samples, 1.0).levels;
      if (angles.empty()) angles.assign(7, std::numeric_limits<double>::quiet_NaN());
      for (int i = 0; i < 7; ++i) total[i] += (m.axis == 1 ? 1 : 2) * angles[i] / kDegree;
      result.plots.front().series.push_back(curve);
    }
    double sum = 0, sum_mean = 0;
    for (int i = 0; i < 7; ++i) {
      result.measures.push_back({fmt::format("{} {}", kLevelNames[i], m.name), "deg", total[i],
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

enum class Muscles { Passive, Volunteer };

HeadPath ride(const Sled& sled, Muscles muscles, const CaseContext& context) {
  const generate::HeadNeck neck = reference_neck(context.fidelity);
  generate::ModelDraft draft = neck_with_rigid_head(neck);
  add_trunk(draft);
  if (muscles == Muscles::Volunteer) activate_muscles(draft, volunteer(sled.start));
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
  DeckRun run(deck.deck, context.folder / (muscles == Muscles::Volunteer ? "volunteer" : "passive"),
              context.computing, 0.02);
  const int head = body_of_part(run, draft, rigid_skull_part());
  const int t1 = body_of_part(run, draft, part_of_level(generate::T1));
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

Plot path_plot(const HeadPath& path, Muscles muscles, const char* title, int side, int roll) {
  Plot plot{muscles == Muscles::Passive ? "head_passive" : "head",
            title,
            "time, ms",
            "head against T1, mm and deg",
            {}};
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

namespace {

constexpr const char* kSetup =
    "head rigid; chest and shoulders as planes under it; muscles once passive, as in cadavers, and "
    "once with tone and reflex [E] as volunteers have: those the windows belong to";

const char* suffix(Muscles muscles) {
  return muscles == Muscles::Passive ? ", passive muscles" : "";
}

/// Passive muscles are set beside the volunteers' windows and decide nothing.
Confidence of(Muscles muscles, Confidence confidence) {
  return muscles == Muscles::Passive ? Confidence::Low : confidence;
}

}  // namespace

// ISO/TR 9790 neck test 1. No T1 trace is at hand: half a sine of 15 g over 60 ms with 6 degrees of
// roll [E], so the windows are widened by 30 %.
CaseResult neck_lateral(const CaseContext& context) {
  CaseResult result{"neck_lateral",
                    "head on the neck, lateral sled of 7 g",
                    std::string("T1 driven by half a sine of 15 g, 60 ms [E]; windows of the test "
                                "widened by 30 %; ") +
                        kSetup,
                    {},
                    {},
                    {}};
  for (const Muscles muscles : {Muscles::Volunteer, Muscles::Passive}) {
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
                               muscles, context);
    const auto [y, t_y] = extreme(path.time, path.centre, 1);
    const auto [z, t_z] = extreme(path.time, path.centre, 2);
    const auto [flexion, t_f] = extreme(path.time, path.turned, 0);
    const auto [twist, t_t] = extreme(path.time, path.turned, 2);
    const auto add = [&](const char* quantity, const char* unit, double ours, double reference,
                         double low, double high, Confidence confidence) {
      result.measures.push_back({std::string(quantity) + suffix(muscles), unit, ours, reference,
                                 low, high, of(muscles, confidence),
                                 "[iso9790] neck test 1; drive [E]"});
    };
    add("lateral displacement of the head", "mm", 1e3 * std::abs(y), 146, 91, 211,
        Confidence::Medium);
    add("downward displacement of the head", "mm", 1e3 * std::abs(z), 79, 45, 122,
        Confidence::Medium);
    add("time of the largest excursion", "ms", t_y, 167, 111, 228, Confidence::Medium);
    add("largest lateral angle", "deg", std::abs(flexion) / kDegree, 51, 31, 77,
        Confidence::Medium);
    add("largest twist", "deg", std::abs(twist) / kDegree, 38, 22, 59, Confidence::Low);
    result.plots.push_back(path_plot(path, muscles, "Lateral 7 g", 1, 0));
    result.notes.push_back(path.note + suffix(muscles));
  }
  return result;
}

CaseResult neck_frontal(const CaseContext& context) {
  CaseResult result{"neck_frontal",
                    "head on the neck, frontal sled of 15 g",
                    std::string("T1 driven by half a sine of 28 g, 97 ms, with 22 degrees of "
                                "rotation [E]; ") +
                        kSetup,
                    {},
                    {},
                    {}};
  for (const Muscles muscles : {Muscles::Volunteer, Muscles::Passive}) {
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
                               muscles, context);
    double x = 0;  // forwards only: past a right angle the head swings back under the neck
    for (const Vec3& d : path.centre) x = std::max(x, d.x());
    const auto [z, t_z] = extreme(path.time, path.centre, 2);
    double flexion = 0, t_f = 0;
    for (std::size_t i = 0; i < path.time.size(); ++i)
      if (path.turned[i].y() > flexion) {
        flexion = path.turned[i].y();
        t_f = 1e3 * path.time[i];
      }
    const double peak =
        *std::max_element(path.acceleration.begin(), path.acceleration.end()) / kStandardGravity;
    const auto add = [&](const char* quantity, const char* unit, double ours, double reference,
                         double low, double high) {
      result.measures.push_back({std::string(quantity) + suffix(muscles), unit, ours, reference,
                                 low, high, Confidence::Low, "[thunnissen1995]; drive [E]"});
    };
    add("forward displacement of the head", "mm", 1e3 * x, 180, 160, 200);
    add("downward displacement of the head", "mm", -1e3 * z, 145, 120, 170);
    add("largest flexion", "deg", flexion / kDegree, 87, 75, 100);
    add("time of it", "ms", t_f, 150, 140, 160);
    add("peak acceleration of the head", "g", peak, 30, 25, 35);
    result.plots.push_back(path_plot(path, muscles, "Frontal 15 g", 0, 1));
    result.notes.push_back(path.note + suffix(muscles));
  }
  return result;
}

}  // namespace crosswalk::fe::validate
