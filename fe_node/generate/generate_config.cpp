#include "fe_node/generate/generate_config.h"

#include <map>
#include <string>

namespace crosswalk::fe::generate {

namespace {

template <class T>
T chosen(ConfigTable& table, std::string_view key,
         const std::vector<std::pair<std::string, T>>& options, std::string_view doc) {
  std::vector<std::string> names;
  for (const auto& option : options) names.push_back(option.first);
  const std::string name = table.choice_or(key, names, names.front(), doc);
  for (const auto& option : options)
    if (option.first == name) return option.second;
  return options.front().second;
}

/// A subject's measure has to be inside what the head's shape was checked for.
void check(ConfigTable& table, std::string_view what, double value, double min, double max) {
  if (value >= min && value <= max) return;
  table.problem("generator",
                "a subject whose " + std::string(what) + " is " + std::to_string(1e3 * min) +
                    " .. " + std::to_string(1e3 * max) + " mm",
                std::to_string(1e3 * value) + " mm",
                "give a deck of your own (docs/own_model.md) for other subjects");
}

}  // namespace

HeadNeckSpec read_head_neck_spec(ConfigTable table, const Anthropometry& subject,
                                 Fidelity fidelity) {
  HeadNeckSpec spec;
  spec.fidelity = fidelity;
  spec.head = {subject.head_length, subject.head_breadth, subject.head_to_chin_height};
  spec.neck_circumference = subject.neck_circumference;
  spec.stature = subject.standing_height;
  check(table, "head length", spec.head.length, 0.165, 0.220);
  check(table, "head breadth", spec.head.breadth, 0.135, 0.175);
  check(table, "head to chin height", spec.head.chin_height, 0.185, 0.255);
  check(table, "neck circumference", spec.neck_circumference, 0.300, 0.480);
  spec.mass.preset = chosen<MassPreset>(table, "mass",
                                        {{"literature", MassPreset::Literature},
                                         {"seed_a1", MassPreset::SeedA1},
                                         {"measured", MassPreset::Measured},
                                         {"untrimmed", MassPreset::Untrimmed}},
                                        "Mass properties the generated head is trimmed to.");
  if (spec.mass.preset == MassPreset::Measured) {
    spec.mass.head_mass =
        table.quantity("head_mass", Dimension::Mass, {2.0, 8.0}, "Mass of the subject's head.");
    const std::vector<double> moments =
        table.quantities("head_moments", Dimension::Inertia, 3,
                         "Moments of inertia about the head's centre: axes forward, left, up.");
    if (moments.size() == 3) spec.mass.head_moments = {moments[0], moments[1], moments[2]};
  }
  spec.brain_bulk =
      table.quantity_or("brain_bulk", Dimension::Stress, {0.1e9, 3e9}, spec.brain_bulk,
                        "Bulk modulus of brain, cord and CSF; that of water is 2.19 GPa.");
  spec.muscle_area_factor =
      table.quantity_or("muscle_area_factor", Dimension::None, {0.2, 3.0}, spec.muscle_area_factor,
                        "Factor on the muscle areas of an average female.");
  spec.activation =
      table.quantity_or("muscle_activation", Dimension::None, {0.0, 1.0}, spec.activation,
                        "Activation of all neck muscles of the generated model; 0: passive.");
  return spec;
}

namespace {

/// Lower and upper edge and width from the car's profile; false when it has no windshield.
bool take_pane(const VehicleFront& front, WindshieldSpec& spec) {
  bool is_found = false;
  for (const FrontFacet& facet : front.facets) {
    if (facet.component != "windshield") continue;
    if (!is_found) {
      spec.lower_x = -facet.begin.x();
      spec.lower_z = facet.begin.y();
    }
    spec.upper_x = -facet.end.x();
    spec.upper_z = facet.end.y();
    spec.width = 2 * facet.half_width;
    is_found = true;
  }
  return is_found;
}

double cell_of(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::Coarse:
      return 0.020;
    case Fidelity::Medium:
      return 0.010;
    case Fidelity::Fine:
      return 0.005;  // as in [yu2020, App. A]
  }
  return 0.020;
}

}  // namespace

std::optional<WindshieldSpec> read_windshield(ConfigTable table, const VehicleFront& front,
                                              Fidelity fidelity) {
  WindshieldSpec spec;
  const std::string model = table.choice_or(
      "model", {"rigid", "panel", "laminated"}, "rigid",
      "rigid: the car's force curve; panel: the sheet of the test buck; laminated: glass and PVB.");
  spec.kind = model == "laminated" ? WindshieldKind::Laminated : WindshieldKind::Panel;
  spec.cell = cell_of(fidelity);
  if (!take_pane(front, spec) && model != "rigid")
    table.problem("model", "`rigid`, or an interface `buck` whose car has a component `windshield`",
                  "`" + model + "` and no such component");
  const auto length = [&](std::string_view name, Range range, double fallback,
                          std::string_view doc) {
    return table.quantity_or(name, Dimension::Length, range, fallback, doc);
  };
  spec.cell = length("cell", {0.003, 0.1}, spec.cell, "Element size.");
  spec.lower_x =
      length("lower_x", {}, spec.lower_x, "Lower edge behind the foremost bumper point.");
  spec.lower_z = length("lower_z", {}, spec.lower_z, "Lower edge above the ground.");
  spec.upper_x =
      length("upper_x", {}, spec.upper_x, "Upper edge behind the foremost bumper point.");
  spec.upper_z = length("upper_z", {}, spec.upper_z, "Upper edge above the ground.");
  spec.width = length("width", {0.3, 2.5}, spec.width, "Width of the pane.");
  spec.sagitta = length("sagitta", {0, 0.2}, spec.sagitta, "Bulge of the middle outwards.");
  spec.panel_thickness =
      length("panel_thickness", {2e-4, 0.01}, spec.panel_thickness, "Thickness of the panel.");
  spec.glass_thickness =
      length("glass_thickness", {1e-3, 0.01}, spec.glass_thickness, "Thickness of each glass ply.");
  spec.pvb_thickness =
      length("pvb_thickness", {2e-4, 5e-3}, spec.pvb_thickness, "Thickness of the interlayer.");
  if (model == "rigid") return std::nullopt;
  return spec;
}

}  // namespace crosswalk::fe::generate
