// The free head struck by a known force: pressure in the brain.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/units.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/validate/free_head.h"
#include "fe_node/validate/head_draft.h"
#include "fe_node/validate/validate.h"

namespace crosswalk::fe::validate {
namespace {

namespace part = generate::part;

// Reconstructed pulse of experiment 37 [nahum1977]: 7.9 kN peak and 27.4 N s are reported, the
// shape between is an estimate.
const Points kNahumForce = {{0, 0},         {0.0005, 150},  {0.001, 600},   {0.0015, 1700},
                            {0.002, 3400},  {0.0025, 5400}, {0.003, 7000},  {0.0034, 7800},
                            {0.0037, 7900}, {0.004, 7600},  {0.0045, 6400}, {0.005, 4900},
                            {0.0055, 3500}, {0.006, 2300},  {0.0065, 1500}, {0.007, 950},
                            {0.008, 400},   {0.009, 100},   {0.010, 0}};

struct Blow {
  Vec3 towards;            ///< outwards where it strikes, unit
  std::vector<int> patch;  ///< nodes that share the force
  Points force;            ///< N over s
  double end = 0;          ///< s
};

struct Gauge {
  const char* name;
  Vec3 place;  ///< of the undeformed head
};

/// What a gauge read: the largest value of either sign and its time.
struct Reading {
  double largest = 0, when_ms = 0;  ///< kPa
};

struct BlowOutcome {
  Plot plot;
  std::vector<Reading> readings;  ///< one per gauge
  double peak = 0, hic15 = 0;     ///< g
  std::string note, map;
};

/// Nodes of the part's bricks within the radius; `first_corner` 4: of their outer faces alone.
std::vector<int> nodes_near(const FreeHead& head, const Vec3& p, double radius, int of_part,
                            int first_corner) {
  std::vector<int> patch;
  for (const generate::Hex& hex : head.draft.mesh.hexes)
    if (hex.part == of_part)
      for (int c = first_corner; c < 8; ++c)
        if ((head.draft.mesh.nodes[hex.node[c]] - p).norm() < radius) patch.push_back(hex.node[c]);
  std::sort(patch.begin(), patch.end());
  patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
  return patch;
}

BlowOutcome strike(const FreeHead& head, const Blow& blow, const std::vector<Gauge>& gauges,
                   const std::string& title, const CaseContext& context) {
  DeckCase deck(head.draft, UnitSystem::MmTonneS);
  for (int axis = 0; axis < 3; ++axis) {
    if (blow.towards[axis] == 0) continue;
    Points force = blow.force;
    for (auto& point : force) point.second *= -blow.towards[axis];
    deck.load_nodes(blow.patch, axis, force);
  }
  deck.end_at(blow.end);
  DeckRun run(deck.deck, context.folder, context.computing, kAddedMass);
  HeadSensor sensor(run);
  std::vector<PressurePatch> patches;
  BlowOutcome out{.plot = {"pressure", title, "time, ms", "pressure, kPa", {}}};
  for (const Gauge& g : gauges) {
    patches.emplace_back(run, g.place, kPatchRadius);
    out.plot.series.push_back({g.name, {}});
  }
  run.run(blow.end, kSampling, [&](const State& state) {
    sensor.sample(state);
    for (std::size_t i = 0; i < patches.size(); ++i)
      out.plot.series[i].points.emplace_back(1e3 * state.time, 1e-3 * patches[i].pressure(run));
  });
  for (const Series& series : out.plot.series) {
    Reading reading;
    for (const auto& [t, p] : series.points)
      if (std::abs(p) > std::abs(reading.largest)) reading = {p, t};
    out.readings.push_back(reading);
  }
  out.peak = sensor.peak() / kStandardGravity;
  out.hic15 = sensor.hic15();
  out.note = energy_note(run);
  // In a fluid at rest in the head, pressure rises along the blow by density times acceleration.
  out.map = fmt::format("at {:.1f} ms, pressure over the place along the blow:",
                        out.readings.front().when_ms);
  for (std::size_t i = 0; i < gauges.size(); ++i)
    for (const auto& [t, p] : out.plot.series[i].points)
      if (std::abs(t - out.readings.front().when_ms) < 1e-9)
        out.map += fmt::format(" {} {:.0f} kPa at {:+.0f} mm;", gauges[i].name, p,
                               1e3 * (gauges[i].place - head.cranial_centre()).dot(blow.towards));
  return out;
}

Gauge on_brain(const FreeHead& head, const char* name, const Vec3& direction) {
  return {name, head.brain_surface(direction.normalized())};
}

/// Above the foramen magnum.
Gauge above_foramen(const FreeHead& head) {
  return on_brain(head, "foramen", Vec3(-0.015, 0, -0.060));
}

}  // namespace

CaseResult nahum_37(const CaseContext& context) {
  const FreeHead head(context.fidelity);
  const Vec3 n = Vec3(1, 0, 1).normalized();  // Frankfurt plane 45 degrees forward-down
  const Blow blow{n, nodes_near(head, head.support(n), 0.030, part::kScalp, 4), kNahumForce, 0.010};
  const BlowOutcome out =
      strike(head, blow,
             {on_brain(head, "frontal", n), on_brain(head, "parietal", {0.1, 0.7, 0.7}),
              on_brain(head, "occipital", {-1, 0, 0}), on_brain(head, "posterior fossa", -n),
              above_foramen(head)},
             "Nahum 37: pressure in the brain", context);
  const char* source = "[nahum1977]";
  return {"nahum_37",
          "frontal blow of a 5.6 kg cylinder at 9.9 m/s: pressure in the brain",
          "free head; reconstructed force pulse (7.9 kN) on a 30 mm patch of the forehead",
          {{"frontal (coup) pressure", "kPa", out.readings[0].largest, 141, 105, 180,
            Confidence::Medium, source},
           {"time of it", "ms", out.readings[0].when_ms, 3.7, 3.3, 4.1, Confidence::Medium,
            "force peak"},
           {"parietal pressure", "kPa", out.readings[1].largest, 74, 50, 100, Confidence::Medium,
            source},
           {"occipital pressure", "kPa", out.readings[2].largest, -50, -110, -35,
            Confidence::Medium, source},
           {"posterior fossa pressure", "kPa", out.readings[3].largest, -60, -110, -35,
            Confidence::Medium, source},
           {"peak head acceleration", "g", out.peak, 200, 160, 240, Confidence::Medium, source},
           {"HIC15", "", out.hic15, 744, 520, 970, Confidence::Low, source}},
          {out.plot},
          {out.note, out.map}};
}

// 23.4 kg at 7 m/s into the face. About 100 g are reported; a half-sine that gives a free head the
// striker's speed lasts 11 ms then [E]. A trend check.
CaseResult trosseille_428(const CaseContext& context) {
  const FreeHead head(context.fidelity);
  constexpr double kPeak = 100 * kStandardGravity, kSpeed = 7.0,
                   kDuration = 0.5 * kPi * kSpeed / kPeak;
  const double mass = inertia_of(head.draft, parts_of_set(head.draft, "head"), true).mass;
  Points force;
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i)
    force.emplace_back(kDuration * i / kSteps, mass * kPeak * std::sin(kPi * i / kSteps));
  force.emplace_back(2 * kDuration, 0);
  const Vec3 n(1, 0, 0);
  // Middle of the face, between the orbits and the upper jaw.
  Vec3 struck = head.marks.tragion;
  for (const int id :
       nodes_near(head, head.marks.tragion + Vec3(0.085, 0, -0.020), 0.025, part::kFace, 0))
    if (head.draft.mesh.nodes[id].x() > struck.x()) struck = head.draft.mesh.nodes[id];
  const Blow blow{n, nodes_near(head, struck, 0.040, part::kFace, 0), force, 1.3 * kDuration};
  const BlowOutcome out = strike(head, blow,
                                 {on_brain(head, "frontal", {0.9, 0, 0.3}),
                                  on_brain(head, "occipital", {-1, 0, 0}),
                                  {"third ventricle", head.cranial_centre()},
                                  above_foramen(head)},
                                 "Trosseille MS428-2: pressure in the brain", context);
  const char* source = "[trosseille1992] [L]";
  const double ratio = out.readings[0].largest / std::abs(out.readings[1].largest);
  return {
      "trosseille_428",
      "long blow of 23.4 kg at 7 m/s to the face: pressure in the brain",
      "free head; half-sine of 100 g and 11 ms [E] on a 40 mm patch of the face",
      {{"frontal pressure", "kPa", out.readings[0].largest, 88, 60, 115, Confidence::Low, source},
       {"occipital pressure", "kPa", out.readings[1].largest, 3, -13, 20, Confidence::Low, source},
       {"third ventricle", "kPa", out.readings[2].largest, 55, 40, 70, Confidence::Low, source},
       {"frontal over occipital", "", ratio, 3, 3, 1e3, Confidence::Low, source},
       {"peak head acceleration", "g", out.peak, 100, 80, 120, Confidence::Low, source}},
      {out.plot},
      {out.note, out.map}};
}

}  // namespace crosswalk::fe::validate
