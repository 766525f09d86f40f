#include "common/surface_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/words.h"

namespace crosswalk {
namespace {

void read_regions(ConfigTable& subject, const BodyFormulas& formulas, BodyDescription& body) {
  ConfigTable contact = subject.table("contact", "contact of the body");
  const double permanent =
      contact.quantity("flesh_permanent_fraction", Dimension::None, {0, 0.99},
                       "penetration left after unloading, as a fraction of the largest");
  const double exponent = contact.quantity("unloading_exponent", Dimension::None, {1, 10},
                                           "exponent of the unloading curve");
  ConfigTable regions = subject.table("region", "contact curves of the body surface");
  for (const std::string& name : regions.table_names()) {
    ConfigTable table = regions.table(name, "contact curve of one region");
    const double g = formulas.girth(table);
    const double l = formulas.length_ratio(table);
    const Curve force = table.curve("force", Dimension::Length, Dimension::Force,
                                    Curve::Outside::LastSlope, "force against penetration");
    body.regions.push_back({name, {force.scaled(g, g * l), permanent, exponent}});
  }
}

void add_ellipsoid(SurfaceEllipsoid shape, const std::string& name, const std::string& carrier,
                   bool paired_on_one_body, BodyDescription& body) {
  const int single = body.find_segment(carrier);
  if (single >= 0 && !paired_on_one_body) {
    shape.name = name;
    shape.segment = single;
    body.ellipsoids.push_back(shape);
    return;
  }
  for (const auto& [suffix, side] : {std::pair{"_l", 1}, std::pair{"_r", -1}}) {
    SurfaceEllipsoid copy = shape;
    copy.name = name + suffix;
    copy.centre.y() *= side;
    copy.segment = single >= 0 ? single : body.find_segment(carrier + suffix);
    if (copy.segment >= 0) body.ellipsoids.push_back(copy);  // else amputated
  }
}

void read_ellipsoids(ConfigTable& subject, const BodyFormulas& formulas, BodyDescription& body) {
  std::vector<std::string> region_names;
  for (const Region& region : body.regions) region_names.push_back(region.name);
  ConfigTable ellipsoids = subject.table("ellipsoid", "surface ellipsoids");
  for (const std::string& name : ellipsoids.table_names()) {
    ConfigTable table = ellipsoids.table(name, "one surface ellipsoid");
    const std::string carrier = table.text("body", "body that carries it");
    const bool paired = table.flag_or("paired", false, "two of them on one unpaired body");
    const std::string region = table.choice_or("region", region_names, "", "contact region");
    SurfaceEllipsoid shape;
    shape.centre = formulas.vector(table, "centre", "centre");
    shape.semi_axes = formulas.vector(table, "semi_axes", "semi-axes");
    if (!(shape.semi_axes.minCoeff() > 0)) {
      table.problem("semi_axes", "three positive lengths",
                    fmt::format("{:.1f} mm", 1e3 * shape.semi_axes.minCoeff()));
    }
    const auto found = std::find(region_names.begin(), region_names.end(), region);
    if (found == region_names.end()) table.problem("region", "a contact region", region);
    shape.region = static_cast<int>(found - region_names.begin());
    add_ellipsoid(shape, name, carrier, paired, body);
  }
}

void read_bushings(ConfigTable& subject, const BodyFormulas& formulas, BodyDescription& body) {
  ConfigTable table = subject.table("scapulothoracic", "scapula on the rib cage");
  const std::vector<double> k =
      table.quantities("stiffness", Dimension::Stiffness, 3, "along x, y, z of torso_up");
  const double g = formulas.girth(table);
  Bushing bushing;
  bushing.stiffness = g * Vec3(k[0], k[1], k[2]);
  bushing.damping = g * g * table.quantity("damping", Dimension::Damping, kNonNegative, "damping");
  bushing.stop = g * table.quantity("stop", Dimension::Length, kPositive,
                                    "lateral travel before the quadratic stop");
  bushing.stop_stiffness = 1e6 * table.quantity("stop_MN_per_m2", Dimension::None, kNonNegative,
                                                "quadratic lateral stop, MN/m2");
  bushing.base = body.find_segment("torso_up");
  for (const char* name : {"scapula_l", "scapula_r"}) {
    bushing.segment = body.find_segment(name);
    if (bushing.segment >= 0 && bushing.base >= 0) body.bushings.push_back(bushing);
  }
}

void read_self_contacts(ConfigTable& subject, BodyDescription& body) {
  ConfigTable table = subject.table("self_contact", "contacts of the body with itself");
  body.contact.friction_self =
      table.quantity("friction", Dimension::None, {0, 2}, "friction of body on body");
  const auto pair_up = [&body](const std::string& a, const std::string& b) {
    const int first = body.find_ellipsoid(a), second = body.find_ellipsoid(b);
    if (first >= 0 && second >= 0) body.self_contacts.emplace_back(first, second);
  };
  const auto trunk = words(table.text("trunk", "trunk ellipsoids that the limbs may touch"));
  for (const std::string& limb : words(table.text("limbs", "limb ellipsoids that may touch it"))) {
    for (const std::string& part : trunk) {
      pair_up(limb + "_l", part);
      pair_up(limb + "_r", part);
    }
  }
  const auto sides = words(table.text("between_sides", "ellipsoids that touch across the sides"));
  for (const std::string& left : sides) {
    for (const std::string& right : sides) pair_up(left + "_l", right + "_r");
  }
  const auto chest = words(table.text("chest", "ellipsoids that the head may touch"));
  for (const std::string& head : words(table.text("head", "head ellipsoids that touch it"))) {
    for (const std::string& part : chest) pair_up(head, part);
  }
}

void read_contact(ConfigTable& subject, BodyDescription& body) {
  ConfigTable table = subject.table("contact", "contact of the body");
  ContactSettings& contact = body.contact;
  contact.rate = table.quantity("rate_s_per_m", Dimension::None, {0, 1},
                                "force x (1 + rate v), v the approach speed in m/s");
  contact.friction_ground =
      table.quantity("friction_ground", Dimension::None, {0, 2}, "friction of body and ground");
  contact.ground_foot = table.quantity("ground_foot", Dimension::Stiffness, kPositive,
                                       "stiffness of one foot ellipsoid on the ground");
  contact.ground_body = table.quantity("ground_body", Dimension::Stiffness, kPositive,
                                       "stiffness of any other ellipsoid on the ground");
  contact.ground_damping =
      table.quantity("ground_damping", Dimension::Damping, kNonNegative, "damping on approach");
}

}  // namespace

void read_surface(ConfigTable& subject, const BodyFormulas& formulas, BodyDescription& body) {
  read_regions(subject, formulas, body);
  read_ellipsoids(subject, formulas, body);
  read_bushings(subject, formulas, body);
  read_self_contacts(subject, body);
  read_contact(subject, body);
}

}  // namespace crosswalk
