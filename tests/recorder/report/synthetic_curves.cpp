#include <cmath>
#include <limits>
#include <numbers>

#include "tests/recorder/report/synthetic_run.h"

namespace crosswalk::recording::synthetic {
namespace {

constexpr double kStep = 2e-4;  // s
constexpr double kEnd = 0.2;    // s

double pulse(double t, double at, double width) {
  const double u = (t - at) / width;
  return std::exp(-u * u);
}

template <typename Function>
Signal sampled(const char* name, const char* unit, const char* description, Function f) {
  Signal signal{name, unit, description, {}, {}};
  for (int i = 0; i * kStep <= kEnd + 1e-9; ++i) {
    signal.t.push_back(i * kStep);
    signal.y.push_back(f(signal.t.back()));
  }
  return signal;
}

TissuePeak tissue() {
  TissuePeak peak{0.124, {}, StrainMap{}};
  const char* names[] = {"brain", "cerebrum_l", "cerebrum_r", "cerebellum", "brain_stem"};
  const double values[] = {0.31, 0.29, 0.33, 0.18, 0.22};
  for (int i = 0; i < 5; ++i) {
    peak.regions.push_back({names[i], 1.4 * values[i], values[i], 1.6 * values[i], 0.4 * values[i],
                            -6e4, 1.5e5, 2.1e3 * values[i]});
  }
  for (double x = -0.08; x <= 0.08; x += 0.008) {
    for (double y = -0.065; y <= 0.065; y += 0.008) {
      for (double z = -0.06; z <= 0.06; z += 0.008) {
        if (std::pow(x / 0.08, 2) + std::pow(y / 0.065, 2) + std::pow(z / 0.06, 2) > 1) continue;
        peak.map->centroids.emplace_back(x, y, z);
        peak.map->strain.push_back(0.05 + 0.35 * std::abs(y) / 0.065 * (z + 0.06) / 0.12);
      }
    }
  }
  return peak;
}

std::vector<VerdictRow> verdict() {
  return {{"Impact", "Head contact time", "118.4", "ms", "105–135 ms (estimate)", Verdict::Good,
           "After the first contact of leg and car."},
          {"Impact", "Wrap-around distance", "2064", "mm", "2000–2250 mm (estimate)", Verdict::Good,
           "Along the car front from the ground to where the head strikes."},
          {"Impact", "Head speed against the car", "12.3", "m/s", "10–15.5 m/s (estimate)",
           Verdict::Good, "Just before head contact."},
          {"Head injury", "HIC15", "1412", "", "700 [FMVSS 208]", Verdict::Bad,
           "Head injury criterion over at most 15 ms; 1412 means a 43 % risk of a skull fracture."},
          {"Head injury", "BrIC", "0.82", "", "", Verdict::Info,
           "Brain injury criterion from the head's rotation."},
          {"Head injury", "MPS95", "0.31", "", "", Verdict::Info,
           "Strain that 95 % of the brain stays below."},
          {"Quality of the run", "Energy balance", "0.7", "%", "below 5 %", Verdict::Good,
           "Energy unaccounted for, against the kinetic energy."},
          {"Quality of the run", "Interface drift", "6.1", "%", "below 5 %", Verdict::Attention,
           "Work lost or gained where the two solvers meet."}};
}

}  // namespace

CurveSet curves(const std::string& label, CurveOrigin origin, double lateness) {
  const double hit = kHeadContact + lateness;
  CurveSet set{label, origin, {}};
  const auto add = [&set](Signal signal) { set.signals.push_back(std::move(signal)); };
  add(sampled("head_cog_x", "mm", "head COG displacement", [&](double t) { return 900 * t * t; }));
  add(sampled("head_cog_y", "mm", "head COG displacement",
              [&](double t) { return 9e3 * std::pow(std::max(0.0, t - lateness), 1.15); }));
  add(sampled("head_cog_z", "mm", "head COG displacement",
              [&](double t) { return -500 * std::pow(t / hit, 3) / (1 + std::pow(t / hit, 3)); }));
  add(sampled("head_speed_relative", "mps", "head speed", [&](double t) {
    return 11.1 + 1.5 * std::sin(12 * t) - 8 / (1 + std::exp((hit - t) / 0.004));
  }));
  add(sampled("head_acceleration_resultant", "mps2", "resultant, CFC 1000",
              [&](double t) { return 60 + 1300 * pulse(t, hit + 0.004, 0.004); }));
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("head_angular_velocity_") + "xyz"[axis];
    add(sampled(name.c_str(), "radps", "head axes, CFC 60", [&](double t) {
      return (axis == 0 ? -38 : 12 * axis) * pulse(t, hit, 0.03) *
             std::cos(2 * std::numbers::pi * t * (3 + axis));
    }));
  }
  if (origin == CurveOrigin::Reference) return set;
  add(sampled("head_contact_force", "N", "head against car",
              [&](double t) { return t < hit ? 0.0 : 8200 * pulse(t, hit + 0.005, 0.004); }));
  add(sampled("contact_knee_r_resultant", "N", "knee against bumper",
              [&](double t) { return 3000 * pulse(t, 0.012, 0.006); }));
  add(sampled("late_channel", "J", "has no samples before 100 ms",
              [&](double t) { return t < 0.1 ? std::numeric_limits<double>::quiet_NaN() : t; }));
  return set;
}

ReportInput report_input() {
  ReportInput input;
  input.title = "Synthetic impact, coupled";
  input.subtitle = "A made-up figure for tests of the report; nothing here is a result";
  input.story =
      "A car at 40 km/h strikes a standing pedestrian from the right. The head hits the windshield "
      "118 ms later at 12.3 m/s against the car.";
  input.verdict = verdict();
  input.warnings = {"windshield: mass scaling added 1.2 % <of the pane's mass>"};
  input.curves = {curves("coupled", CurveOrigin::ThisRun, 0.0),
                  curves("multibody only", CurveOrigin::OtherRun, 0.004),
                  curves("made-up test", CurveOrigin::Reference, -0.003)};
  input.marks = {{kHeadContact, "head contact"}};
  input.tables = {{"CORA",
                   "Score 0 to 1 against the reference.",
                   {"signal", "C", "corridor", "shape"},
                   {{"displacement Y", "0.98", "0.99", "0.97"}}}};
  input.bars = {
      {"HIC15", "–", {"V2370", "V2371"}, {"multibody", "coupled"}, {{1210, 1412}, {900, 1015}}}};
  input.tissue = tissue();
  input.scene = scene();
  input.provenance = {{"crosswalk", "0.1.0"}, {"scenario digest", "0x0123456789abcdef"}};
  input.estimates = {
      {"buck stiffness", "0.4 MN/m", "estimate from component tests of similar cars"}};
  return input;
}

}  // namespace crosswalk::recording::synthetic
