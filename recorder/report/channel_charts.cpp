#include "recorder/report/channel_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "common/units.h"

namespace crosswalk::recording {
namespace {

/// How a stored unit is shown.
struct Shown {
  const char* stored;
  const char* unit;
  double factor;
};
constexpr std::array<Shown, 13> kShown{{{"mps", "m/s", 1},
                                        {"m/s", "m/s", 1},
                                        {"mps2", "m/s²", 1},
                                        {"m/s2", "m/s²", 1},
                                        {"radps", "rad/s", 1},
                                        {"rad/s", "rad/s", 1},
                                        {"radps2", "krad/s²", 1e-3},
                                        {"rad/s2", "krad/s²", 1e-3},
                                        {"N", "kN", 1e-3},
                                        {"Nm", "N m", 1},
                                        {"m", "mm", 1e3},
                                        {"s", "ms", 1e3},
                                        {"1", "–", 1}}};

Shown shown(const std::string& unit) {
  for (const Shown& entry : kShown) {
    if (unit == entry.stored) return entry;
  }
  return {"", unit.c_str(), 1};
}

struct Line {
  const char* channel;
  const char* label;  ///< of the component; empty when the chart has one line per run
};

struct Spec {
  const char* id;
  const char* title;
  const char* quantity;  ///< y axis without its unit
  const char* caption;
  std::vector<Line> lines;
  const char* unit = "";  ///< shown unit when it is not the default, with `factor` from the stored
  double factor = 1;
};

struct GroupSpec {
  const char* title;
  std::vector<Spec> charts;
};

const std::vector<GroupSpec>& groups() {
  static const std::vector<GroupSpec> kGroups{
      {"Head motion",
       {{"head_x",
         "Head displacement X, across the car",
         "displacement X",
         "Head centre of gravity (COG) from where it was at time zero; X is the way the "
         "pedestrian faces.",
         {{"head_cog_x", ""}}},
        {"head_y",
         "Head displacement Y, along the car's travel",
         "displacement Y",
         "Y is the direction in which the car moves.",
         {{"head_cog_y", ""}}},
        {"head_z",
         "Head displacement Z, vertical",
         "displacement Z",
         "Z points up.",
         {{"head_cog_z", ""}}},
        {"head_speed",
         "Head speed relative to the car",
         "relative speed",
         "Length of the velocity of the head COG minus that of the car; it falls steeply when the "
         "head strikes.",
         {{"head_speed_relative", ""}}},
        {"head_acceleration",
         "Resultant head acceleration",
         "acceleration",
         "Of the head COG, filtered CFC 1000 (SAE J211-1). HIC is computed from this curve.",
         {{"head_acceleration_resultant", ""}},
         "g",
         1.0 / kStandardGravity}}},
      {"Head rotation and acceleration components",
       {{"head_rotation",
         "Head angular velocity",
         "angular velocity",
         "Head-fixed SAE J211 axes (x forward, y right, z down), filtered CFC 60. BrIC and DAMAGE "
         "come from these.",
         {{"head_angular_velocity_x", "x"},
          {"head_angular_velocity_y", "y"},
          {"head_angular_velocity_z", "z"}}},
        {"head_angular_acceleration",
         "Head angular acceleration",
         "angular acceleration",
         "Derivative of the filtered angular velocity, head axes.",
         {{"head_angular_acceleration_x", "x"},
          {"head_angular_acceleration_y", "y"},
          {"head_angular_acceleration_z", "z"}}},
        {"head_acceleration_axes",
         "Head acceleration, components",
         "acceleration",
         "Head-fixed SAE J211 axes, CFC 1000.",
         {{"head_acceleration_x", "x"}, {"head_acceleration_y", "y"}, {"head_acceleration_z", "z"}},
         "g",
         1.0 / kStandardGravity}}},
      {"Neck loads and contact forces",
       {{"neck_force",
         "Force of the neck on the head",
         "force",
         "Head-fixed SAE J211 axes, CFC 1000; z positive: the neck is pulled.",
         {{"neck_force_x", "x"}, {"neck_force_y", "y"}, {"neck_force_z", "z"}}},
        {"neck_moment",
         "Moment of the neck on the head",
         "moment",
         "About the occipital condyles, head-fixed SAE J211 axes, CFC 600; y positive: the head is "
         "flexed.",
         {{"neck_moment_x", "x"}, {"neck_moment_y", "y"}, {"neck_moment_z", "z"}}},
        {"head_force",
         "Force between head and car",
         "force",
         "Resultant of all head contacts.",
         {{"head_contact_force", ""}}},
        {"car_force",
         "Force of the car on the pedestrian",
         "force",
         "Sum over all contacts, frame: x pedestrian's front, y car travel, z up.",
         {{"contact_car_total_x", "x"},
          {"contact_car_total_y", "y"},
          {"contact_car_total_z", "z"}}}}},
      {"Energy and coupling",
       {{"mb_energy",
         "Energy of the multibody pedestrian",
         "energy",
         "",
         {{"mb_kinetic_energy", "kinetic"},
          {"mb_gravity_energy", "gravity"},
          {"mb_joint_elastic_energy", "joints, stored"},
          {"mb_contact_elastic_energy", "contacts, stored"},
          {"mb_car_work", "work of the car"}}},
        {"mb_losses",
         "Where the multibody pedestrian loses energy",
         "energy",
         "Passive moments of hip, knee and ankle have no potential: they also give back.",
         {{"mb_lost_joint_damping", "joints, damping"},
          {"mb_lost_joint_friction", "joints, friction"},
          {"mb_lost_joint_hysteresis", "joints, hysteresis"},
          {"mb_lost_joint_passive", "joints, passive"},
          {"mb_lost_contact_hysteresis", "contacts, hysteresis"},
          {"mb_lost_contact_viscous", "contacts, rate"},
          {"mb_lost_contact_friction", "contacts, friction"}}},
        {"fe_energy",
         "Energy of the finite-element head and neck",
         "energy",
         "Hourglass energy is an artefact of one-point elements; it should stay small against the "
         "internal energy.",
         {{"fe_kinetic_energy", "kinetic"},
          {"fe_internal_energy", "internal"},
          {"fe_hourglass_energy", "hourglass"},
          {"fe_contact_energy", "contact"},
          {"fe_damping_energy", "damping"}}},
        {"coupling_energy",
         "Energy error of the run",
         "energy",
         "Drift: work booked by the two solvers at their interface, which should cancel. Balance: "
         "total energy minus the work put in.",
         {{"coupling_interface_drift", "interface drift"},
          {"coupling_balance_error", "energy balance"}}},
        {"coupling_gap",
         "Gap at the interface",
         "gap",
         "Largest distance between an interface body and the block of elements it carries.",
         {{"coupling_gap", ""}}}}}};
  return kGroups;
}

const Signal* find(const CurveSet& set, const std::string& name) {
  const auto it = std::find_if(set.signals.begin(), set.signals.end(),
                               [&name](const Signal& s) { return s.name == name; });
  return it == set.signals.end() ? nullptr : &*it;
}

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values.size());
  std::transform(values.begin(), values.end(), out.begin(),
                 [factor](double v) { return factor * v; });
  return out;
}

std::string curve_label(const CurveSet& set, const char* component, bool has_several_sets) {
  const std::string part = component;
  if (part.empty()) return set.label;
  return has_several_sets ? part + ", " + set.label : part;
}

std::vector<TimeMark> marks_in_ms(std::vector<TimeMark> marks) {
  for (TimeMark& mark : marks) mark.t *= 1e3;
  return marks;
}

Chart time_chart(const Spec& spec, const std::vector<CurveSet>& sets,
                 const std::vector<TimeMark>& marks) {
  Chart chart;
  chart.id = spec.id;
  chart.title = spec.title;
  chart.caption = spec.caption;
  chart.components = static_cast<int>(spec.lines.size());
  chart.marks = marks_in_ms(marks);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (std::size_t k = 0; k < spec.lines.size(); ++k) {
      const Signal* signal = find(sets[s], spec.lines[k].channel);
      if (signal == nullptr || signal->t.empty()) continue;
      const Shown unit = shown(signal->unit);
      const bool is_default = std::string(spec.unit).empty();
      const double factor = is_default ? unit.factor : spec.factor;
      chart.y_label = fmt::format("{} [{}]", spec.quantity, is_default ? unit.unit : spec.unit);
      chart.curves.push_back({curve_label(sets[s], spec.lines[k].label, sets.size() > 1),
                              sets[s].origin, static_cast<int>(s), static_cast<int>(k),
                              scaled(signal->t, 1e3), scaled(signal->y, factor)});
    }
  }
  return chart;
}

/// True when a chart shows nothing but zeros: the interface of a run that has none.
bool is_all_zero(const Chart& chart) {
  return std::all_of(chart.curves.begin(), chart.curves.end(), [](const ChartCurve& curve) {
    return std::all_of(curve.y.begin(), curve.y.end(), [](double v) { return !(std::abs(v) > 0); });
  });
}

/// The path of the head in the plane of the car's travel (paper's Figure 6 d).
Chart trajectory(const std::vector<CurveSet>& sets) {
  Chart chart;
  chart.id = "head_trajectory";
  chart.title = "Path of the head seen from the side (YOZ plane)";
  chart.caption = "From the position at time zero (0, 0); both axes have one scale.";
  chart.x_label = "displacement Y, along the car's travel [mm]";
  chart.y_label = "displacement Z, up [mm]";
  chart.is_trajectory = true;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const Signal* y = find(sets[s], "head_cog_y");
    const Signal* z = find(sets[s], "head_cog_z");
    if (y == nullptr || z == nullptr || y->t != z->t) continue;
    chart.curves.push_back({sets[s].label, sets[s].origin, static_cast<int>(s), 0,
                            scaled(y->y, shown(y->unit).factor),
                            scaled(z->y, shown(z->unit).factor)});
  }
  return chart;
}

/// Strain of the brain's regions, whatever they are called: channels `brain_<region>_<quantity>`.
Chart brain_chart(const std::vector<CurveSet>& sets, const std::vector<TimeMark>& marks,
                  const std::string& quantity, const char* title, const char* axis,
                  const char* caption, std::set<std::string>& drawn) {
  std::vector<std::pair<std::string, std::string>> regions;  // channel, label
  const std::string begin = "brain_";
  const std::string end = "_" + quantity;
  for (const CurveSet& set : sets) {
    for (const Signal& signal : set.signals) {
      const std::string& name = signal.name;
      if (!name.starts_with(begin) || !name.ends_with(end)) continue;
      if (!drawn.insert(name).second) continue;
      std::string label = name.substr(begin.size(), name.size() - begin.size() - end.size());
      std::replace(label.begin(), label.end(), '_', ' ');
      regions.emplace_back(name, label);
    }
  }
  const std::string id = "brain_" + quantity;
  Spec spec{id.c_str(), title, axis, caption, {}};
  for (const auto& [name, label] : regions) spec.lines.push_back({name.c_str(), label.c_str()});
  return time_chart(spec, sets, marks);
}

ChartGroup brain_group(const std::vector<CurveSet>& sets, const std::vector<TimeMark>& marks,
                       std::set<std::string>& drawn) {
  ChartGroup group{"Brain strain", false, {}};
  group.charts.push_back(
      brain_chart(sets, marks, "mps_95", "Brain strain by region", "first principal Green strain",
                  "The value that 95 % of the region's volume stays below.", drawn));
  group.charts.push_back(
      brain_chart(sets, marks, "mps_95_so_far", "Largest strain until now (MPS95)",
                  "first principal Green strain",
                  "95th percentile of every element's maximum until now.", drawn));
  group.charts.push_back(brain_chart(sets, marks, "csdm_25", "Share of the volume beyond 0.25",
                                     "volume share (CSDM)",
                                     "Volume that has ever been strained beyond 0.25.", drawn));
  std::erase_if(group.charts, [](const Chart& chart) { return chart.curves.empty(); });
  return group;
}

/// Channels that no chart above shows, one chart each, folded.
ChartGroup remaining(const std::vector<CurveSet>& sets, const std::set<std::string>& drawn,
                     const std::vector<TimeMark>& marks) {
  ChartGroup group{"All other channels", true, {}};
  std::set<std::string> seen = drawn;
  for (const CurveSet& set : sets) {
    for (const Signal& signal : set.signals) {
      if (!seen.insert(signal.name).second) continue;
      std::string title = signal.name;
      std::replace(title.begin(), title.end(), '_', ' ');
      const Spec spec{signal.name.c_str(),
                      title.c_str(),
                      title.c_str(),
                      signal.description.c_str(),
                      {{signal.name.c_str(), ""}}};
      group.charts.push_back(time_chart(spec, sets, marks));
    }
  }
  return group;
}

}  // namespace

std::vector<ChartGroup> channel_charts(const std::vector<CurveSet>& sets,
                                       const std::vector<TimeMark>& marks,
                                       const std::string& time_zero) {
  std::vector<ChartGroup> out;
  std::set<std::string> drawn;
  for (const GroupSpec& group_spec : groups()) {
    ChartGroup group{group_spec.title, false, {}};
    for (const Spec& spec : group_spec.charts) {
      for (const Line& line : spec.lines) drawn.insert(line.channel);
      Chart chart = time_chart(spec, sets, marks);
      const bool is_idle = std::string(spec.id) == "coupling_gap" && is_all_zero(chart);
      if (!chart.curves.empty() && !is_idle) group.charts.push_back(std::move(chart));
      if (std::string(spec.id) == "head_z") {
        Chart path = trajectory(sets);
        if (!path.curves.empty()) group.charts.push_back(std::move(path));
      }
    }
    if (!group.charts.empty()) out.push_back(std::move(group));
  }
  ChartGroup brain = brain_group(sets, marks, drawn);
  if (!brain.charts.empty()) out.push_back(std::move(brain));
  ChartGroup rest = remaining(sets, drawn, marks);
  if (!rest.charts.empty()) out.push_back(std::move(rest));
  for (ChartGroup& group : out) {
    for (Chart& chart : group.charts) {
      if (!chart.is_trajectory) chart.x_label = fmt::format("time after {} [ms]", time_zero);
    }
  }
  return out;
}

}  // namespace crosswalk::recording
