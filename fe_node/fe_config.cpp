#include "fe_node/fe_config.h"

#include <algorithm>

#include "common/neck_landmarks.h"
#include "common/units.h"
#include "common/vehicle_front.h"
#include "fe_node/generate/generate_config.h"
#include "fe_node/own_head.h"

namespace crosswalk::fe {
namespace {

generate::Fidelity fidelity_of(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::Coarse:
      return generate::Fidelity::Coarse;
    case Fidelity::Medium:
      return generate::Fidelity::Medium;
    case Fidelity::Fine:
      return generate::Fidelity::Fine;
  }
  return generate::Fidelity::Coarse;
}

generate::NeckFit neck_fit(const BodyDescription& body) {
  const NeckLandmarks marks = neck_landmarks(body);
  return {marks.condyles - marks.base, marks.head_centre - marks.base};
}

/// Unit vector of "x", "-z" and so on.
Vec3 axis_vector(const std::string& name) {
  const double sign = name.front() == '-' ? -1 : 1;
  return sign * Vec3::Unit(name.back() - 'x');
}

/// Turns the deck's axes so that its forward axis becomes x and its up axis z.
Quat axes_of(ConfigTable& table) {
  const std::vector<std::string> axes{"x", "-x", "y", "-y", "z", "-z"};
  const std::string forward = table.choice_or("forward_axis", axes, "x",
                                              "Axis of the deck that points where the face looks.");
  const std::string up =
      table.choice_or("up_axis", axes, "z", "Axis of the deck that points to the vertex.");
  if (forward.back() == up.back()) {
    table.problem("up_axis", "an axis across `forward_axis`", "`" + up + "`");
    return Quat::Identity();
  }
  Mat3 R_DN;
  R_DN.col(0) = axis_vector(forward);
  R_DN.col(2) = axis_vector(up);
  R_DN.col(1) = R_DN.col(2).cross(R_DN.col(0));
  return Quat(Mat3(R_DN.transpose()));
}

/// The mapping table of a deck that the generator did not write.
void read_own_head(ConfigTable& table, HeadNeckConfig& config) {
  config.deck = table.file("deck", "Path of a keyword deck, from the scenario's folder.");
  const std::string units =
      table.text_or("units", "", "Unit system of the deck, such as mm-t-s, if it states none.");
  if (!units.empty()) {
    config.units = unit_system_from(units);
    if (config.units == UnitSystem::Unknown)
      table.problem("units", "m-kg-s, mm-t-s, mm-kg-ms, ...", units);
  }
  const std::vector<double> joint = table.quantities(
      "joint", Dimension::Length, 3, "Point of the deck that stands on the multibody C7/T1 joint.");
  if (joint.size() == 3) config.joint = {joint[0], joint[1], joint[2]};
  config.q_ND = axes_of(table);
  if (table.has("head_centre")) {
    const std::vector<double> centre =
        table.quantities("head_centre", Dimension::Length, 3,
                         "Reported point of the head; the mass centre of `head_parts` by default.");
    if (centre.size() == 3) config.head_centre = Vec3(centre[0], centre[1], centre[2]);
  }
  config.names.skull = table.text_or("skull_nodes", kSkullNodes,
                                     "Node set, or parts, whose rigid fit is the head's motion.");
  config.names.head =
      table.text_or("head_parts", kHeadParts, "Part set, or parts, whose mass centre is reported.");
  config.names.brain =
      table.text_or("brain_parts", kBrainParts, "Part set, or parts, of the strain metrics.");
  config.names.surface = table.text_or("surface_parts", kHeadSurface,
                                       "Part set, or parts, that touch car and shoulders.");
}

HeadNeckConfig read_head_neck(ConfigTable table, const Anthropometry& a, Fidelity fidelity) {
  HeadNeckConfig config;
  const std::string deck = table.text_or(
      "deck", "generate",
      "`generate`: head and neck are made from the subject's measures; else the path of a keyword "
      "deck (docs/own_model.md).");
  config.is_generated = deck == "generate";
  if (config.is_generated)
    config.spec = generate::read_head_neck_spec(table, a, fidelity_of(fidelity));
  else
    read_own_head(table, config);
  return config;
}

}  // namespace

FeConfig read_fe_config(ConfigDocument& document, const Scenario& scenario) {
  FeConfig config;
  ConfigTable root = document.root();
  ConfigTable subject = root.table("subject", "The pedestrian.");
  config.body = read_body_description(subject);
  config.head_neck = read_head_neck(root.table("head_neck", "The finite-element head and neck."),
                                    config.body.measures, scenario.fidelity);
  if (config.body.find_segment("head") >= 0) config.head_neck.spec.fit = neck_fit(config.body);
  config.interfaces = scenario.interfaces;
  config.is_head_alone = scenario.has_head_alone();
  std::vector<std::string> followers;
  for (const InterfaceSpec& interface : scenario.interfaces)
    if (!interface.is_attached && interface.body != "head") followers.push_back(interface.body);
  if (!followers.empty()) config.partner_shapes = read_contact_shapes(root, followers);
  ConfigTable windshield = root.table("windshield", "The car's windshield as the head meets it.");
  const bool has_car = std::count(followers.begin(), followers.end(), "buck") > 0;
  const bool knows_car = has_car || scenario.mode == RunMode::Prescribed;
  config.windshield = generate::read_windshield(
      windshield,
      knows_car ? read_vehicle_front(root.table("vehicle", "The car.")) : VehicleFront{},
      fidelity_of(scenario.fidelity));
  if (!has_car) config.windshield.reset();  // a prescribed head meets nothing
  config.wake_distance =
      windshield.quantity_or("wake_distance", Dimension::Length, {0.02, 1.0}, 0.060,
                             "The windshield costs nothing until the head is this near [E].");
  config.vehicle_friction =
      root.table("vehicle", "The car.")
          .quantity_or("friction", Dimension::None, {0, 2}, 0.3, "Friction of body and car.");
  config.self_friction = config.body.contact.friction_self;
  config.gravity = root.table("environment", "What is around.")
                       .quantity_or("gravity", Dimension::Acceleration, {0, 100}, kStandardGravity,
                                    "Gravity, downwards.");

  ConfigTable fe = root.table("fe", "The finite-element solver.");
  config.step_scale = fe.quantity_or("step_scale", Dimension::None, {0.1, 1}, 0.9,
                                     "Share of the smallest stable step that is taken.");
  config.added_mass_limit =
      fe.quantity_or("added_mass_limit", Dimension::None, {0, 0.05}, 0.01,
                     "Share of the mass of head and neck (the windshield does not count) that mass "
                     "scaling may add, and never more than 0.2 % of a part; 0: no scaling.");
  if (fe.choice_or("precision", {"double", "single"}, "single",
                   "Numbers in which elements compute; nodes and sums are double always.") ==
      "double")
    config.precision = Precision::Double;
  ConfigTable output = root.table("output", "What is written beside the signals.");
  config.field_interval = output.quantity_or("field_interval", Dimension::Time, kNonNegative, 1e-3,
                                             "Time between field files; 0: none.");
  config.tissue_interval = output.quantity_or("tissue_interval", Dimension::Time, kPositive, 1e-3,
                                              "Time between published tissue metrics.");
  config.strain_interval =
      output.quantity_or("strain_interval", Dimension::Time, kPositive, 2e-4,
                         "Time between samples of the largest strains so far.");
  config.logs_block_motion =
      output.flag_or("block_motion", false,
                     "Write model/driven.k: the deck with the motion of its blocks, for "
                     "`crosswalk solve` (some 60 kB per ms).");
  return config;
}

}  // namespace crosswalk::fe
