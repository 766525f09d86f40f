// Reads a subject file (formulas in body measures) into a BodyDescription.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "common/body_description.h"
#include "common/body_scaling.h"
#include "common/formula.h"

namespace crosswalk {
namespace {

constexpr double kGirthMin = 0.88, kGirthMax = 1.12;  // single girths are unreliable [E]

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> list;
  for (std::string word; stream >> word;) list.push_back(word);
  return list;
}

/// A body as written, before masses are shared out.
struct Draft {
  std::string name;  // without side
  std::string group;
  std::string parent;
  bool paired = false;
  Segment segment;          // left side
  VolumeProperties volume;  // of unit density, when cut from a section
  bool is_section = false;
  double explicit_mass = 0, share = 0;
  std::string shape;
  std::vector<double> size;
  std::string inertia_formula;
};

struct Group {
  double fraction = 0, weight = 0, mass = 0;
  bool paired = false, is_head_neck = false;
};

class SubjectReader {
 public:
  explicit SubjectReader(ConfigTable subject) : subject_(std::move(subject)) {}

  BodyDescription read() {
    read_measures();
    read_groups();
    read_sections();
    read_bodies();
    share_masses();
    place_segments();
    read_regions();
    read_ellipsoids();
    read_bushings();
    read_self_contacts();
    read_contact();
    return std::move(out_);
  }

 private:
  // ---- formulas
  std::vector<double> formula(ConfigTable& table, std::string_view key, std::size_t count,
                              const std::string& doc, const Variables& variables) {
    const std::string text = table.text(key, doc);
    std::vector<double> values(count == 0 ? 1 : count, 1.0);
    if (text.empty()) return values;
    try {
      values = evaluate_formula(text, variables);
      if (count != 0 && values.size() != count) {
        table.problem(key, fmt::format("{} formulas", count), fmt::format("{}", values.size()));
        values.assign(count, 1.0);
      }
    } catch (const FormulaError& error) {
      table.problem(key, "a formula in body measures", error.what());
    }
    return values;
  }
  Vec3 vector(ConfigTable& table, std::string_view key, const std::string& doc) {
    const std::vector<double> v = formula(table, key, 3, doc, now_);
    return {v[0], v[1], v[2]};
  }
  double scalar(ConfigTable& table, std::string_view key, const std::string& doc) {
    return formula(table, key, 1, doc, now_)[0];
  }
  double girth(ConfigTable& table, std::string_view key = "girth") {
    return std::clamp(scalar(table, key, "girth ratio to the reference person"), kGirthMin,
                      kGirthMax);
  }
  double length_ratio(ConfigTable& table) {
    return scalar(table, "length", "length ratio to the reference person");
  }

  // ---- measures, groups, sections
  void read_measures() {
    out_.name = subject_.text_or("name", "subject", "name of the subject");
    const Anthropometry reference = read_complete_anthropometry(
        subject_.table("reference", "measures of the reference person"));
    out_.measures = read_anthropometry(subject_, reference);
    ConfigTable table = subject_.table("override", "corrections after the height reconciliation");
    HeightOverrides overrides;
    overrides.SJC = table.quantity_or("z_SJC", Dimension::Length, kNonNegative, 0,
                                      "height of the shoulder joints; 0: reconciled");
    overrides.C7T1 = table.quantity_or("z_C7T1", Dimension::Length, kNonNegative, 0,
                                       "height of C7/T1; 0: reconciled");
    overrides.stance_half_width =
        table.quantity_or("stance_half_width", Dimension::Length, kNonNegative, 0,
                          "half distance of the hip joints; 0: 0.245 of the hip breadth");
    const JointHeights heights = solve_heights(out_.measures, overrides);
    now_ = body_variables(out_.measures, heights, overrides);
    reference_ = body_variables(reference, solve_heights(reference), {});
    out_.height_residuals = heights.residuals;
    for (const char* length : {"L_th", "L_sh", "L_ua", "L_fa", "z_ankle"}) {
      if (now_[length] > 0) continue;
      subject_.problem("", fmt::format("measures that leave {} positive", length),
                       fmt::format("{:.1f} mm", 1e3 * now_[length]),
                       "the measured heights contradict each other");
    }
    bone_quality_ = subject_.quantity_or("bone_quality", Dimension::None, {0.3, 1.5}, 1,
                                         "factor on fracture moments for age");
  }

  void read_groups() {
    ConfigTable groups = subject_.table("mass_group", "groups that share out the body mass");
    for (const std::string& name : groups.table_names()) {
      ConfigTable table = groups.table(name, "one mass group");
      Group& group = groups_[name];
      group.fraction = table.quantity("fraction", Dimension::None, {0, 1},
                                      "fraction of body mass of the reference person, one side");
      group.paired = table.flag_or("paired", false, "one on each side");
      group.is_head_neck = table.flag_or("is_head_neck", false, "part of head and neck");
      const double keep = table.quantity_or("keep", Dimension::None, {0, 1}, 1,
                                            "part that is left after an amputation");
      double ratio = 1;
      if (!group.is_head_neck) {
        const std::string doc = "volume measure of the group";
        const double now = formula(table, "volume", 1, doc, now_)[0];
        ratio = now / formula(table, "volume", 1, doc, reference_)[0];
      }
      group.weight = group.fraction * ratio * keep;
    }
  }

  Curve section_curve(ConfigTable& table, std::string_view x, std::string_view y) {
    const std::vector<double> xs = formula(table, x, 0, "stations", now_);
    const std::vector<double> ys = formula(table, y, xs.size(), "values at the stations", now_);
    try {
      return Curve(xs, ys);
    } catch (const std::invalid_argument& error) {
      table.problem(x, "rising stations", error.what());
      return Curve({0, 1}, {1, 1});
    }
  }

  void read_sections() {
    ConfigTable sections = subject_.table("section", "shapes of uniform density");
    for (const std::string& name : sections.table_names()) {
      ConfigTable table = sections.table(name, "one shape");
      Section& section = sections_[name];
      section.is_trunk =
          table.choice_or("kind", {"trunk", "limb"}, "limb", "kind of shape") == "trunk";
      if (section.is_trunk) {
        section.a = section_curve(table, "z", "a");
        section.b = section_curve(table, "z", "b");
        section.x = section_curve(table, "z", "x");
      } else {
        section.top = vector(table, "top", "proximal end");
        section.length = scalar(table, "length", "length");
        section.a = section_curve(table, "station", "radius");
      }
    }
  }

  // ---- bodies
  void read_bodies() {
    const std::vector<std::string> gone =
        words(subject_.text_or("amputated", "", "bodies that are missing on both sides"));
    ConfigTable bodies = subject_.table("body", "rigid bodies, parents first");
    for (const std::string& name : bodies.table_names()) {
      ConfigTable table = bodies.table(name, "one rigid body");
      Draft draft = read_draft(table, name);
      if (std::find(gone.begin(), gone.end(), name) == gone.end()) drafts_.push_back(draft);
    }
    for (const std::string& name : gone) {
      if (bodies.has(name)) continue;
      subject_.problem("amputated", "names of bodies", fmt::format("`{}`", name));
    }
    ConfigTable joints = subject_.table("joint", "restraints, by child body");
    for (const std::string& name : joints.table_names()) {
      ConfigTable table = joints.table(name, "restraint of one joint");
      const JointRestraint restraint = read_restraint(table);
      for (Draft& draft : drafts_) {
        if (draft.name == name) draft.segment.restraint = restraint;
      }
    }
  }

  Draft read_draft(ConfigTable& table, const std::string& name) {
    static const std::map<std::string, JointType> kJoints = {
        {"free", JointType::Free},       {"ball", JointType::Ball},
        {"hinge_x", JointType::HingeX},  {"hinge_y", JointType::HingeY},
        {"hinge_z", JointType::HingeZ},  {"universal_xy", JointType::UniversalXY},
        {"slider_y", JointType::SliderY}};
    std::vector<std::string> kinds;
    for (const auto& [kind, type] : kJoints) kinds.push_back(kind);
    Draft draft;
    draft.name = name;
    draft.paired = table.flag_or("paired", false, "written for the left, mirrored for the right");
    draft.parent = table.text_or("parent", "", "parent body");
    draft.segment.joint =
        kJoints.at(table.choice_or("joint", kinds, "ball", "joint to the parent"));
    draft.segment.joint_centre = vector(table, "at", "joint centre");
    draft.group = table.text("group", "mass group");
    if (groups_.count(draft.group) == 0) {
      table.problem("group", "a mass group", fmt::format("`{}`", draft.group));
    }
    draft.shape = table.choice_or(
        "shape", {"section", "box", "ellipsoid", "sphere", "cylinder_y", "cylinder_z", "direct"},
        "section", "how the inertia follows from the mass");
    draft.is_section = draft.shape == "section";
    if (draft.is_section) {
      cut_section(table, draft);
    } else {
      draft.segment.com = vector(table, "com", "centre of mass");
      draft.share =
          table.quantity_or("share", Dimension::None, {0, 1}, 1, "part of the group mass");
      if (draft.shape == "direct") {
        draft.inertia_formula = table.text("inertia", "moments about the centre of mass");
      } else {
        const std::size_t count = draft.shape == "sphere"                              ? 1
                                  : draft.shape == "box" || draft.shape == "ellipsoid" ? 3
                                                                                       : 2;
        draft.size = formula(table, "size", count,
                             "box edges; semi-axes; radius; radius and length of a cylinder", now_);
      }
    }
    if (table.has("body_mass")) {
      draft.explicit_mass = scalar(table, "body_mass", "mass taken out of the group first");
    }
    return draft;
  }

  void cut_section(ConfigTable& table, Draft& draft) {
    const std::string name = table.text("section", "shape the body is cut from");
    const std::vector<double> cut =
        formula(table, "cut", 2, "levels of the trunk, or s of a limb", now_);
    const auto found = sections_.find(name);
    if (found == sections_.end()) {
      table.problem("section", "a section", fmt::format("`{}`", name));
      draft.volume = {1, Vec3::Zero(), Vec3::Ones()};
      return;
    }
    const Section& section = found->second;
    if (section.is_trunk) {
      const auto z = section.a.x();
      const auto level = [&](double index) {
        return z[std::clamp<std::size_t>(static_cast<std::size_t>(index), 0, z.size() - 1)];
      };
      draft.volume = trunk_volume(section.a, section.b, section.x, level(cut[0]), level(cut[1]));
    } else {
      draft.volume = limb_volume(section.top, section.length, section.a, cut[0], cut[1]);
    }
    draft.segment.com = draft.volume.centre;
  }

  // ---- masses
  void share_masses() {
    const double W = out_.measures.mass;
    double head_neck_fraction = 0, weights = 0;
    for (const auto& [name, group] : groups_) {
      if (group.is_head_neck) head_neck_fraction += group.fraction;
      if (!group.is_head_neck) weights += (group.paired ? 2 : 1) * group.weight;
    }
    const double head_neck =
        subject_.quantity_or("head_neck_mass", Dimension::Mass, kPositive, head_neck_fraction * W,
                             "mass of head and neck; default: their fractions of body mass");
    for (auto& [name, group] : groups_) {
      group.mass = group.is_head_neck ? head_neck * group.fraction / head_neck_fraction
                                      : (W - head_neck) * group.weight / weights;
    }
    for (const auto& [name, group] : groups_) {
      double rest = group.mass, volume = 0;
      for (const Draft& draft : drafts_) {
        if (draft.group != name) continue;
        rest -= draft.explicit_mass;
        if (draft.is_section) volume += draft.volume.volume;
      }
      for (Draft& draft : drafts_) {
        if (draft.group != name) continue;
        draft.segment.mass = draft.explicit_mass > 0 ? draft.explicit_mass
                             : draft.is_section      ? rest * draft.volume.volume / volume
                                                     : rest * draft.share;
        draft.segment.inertia = inertia(draft).asDiagonal();
      }
    }
    correct_head_inertia();
  }

  Vec3 inertia(const Draft& draft) {
    const double m = draft.segment.mass;
    const auto& s = draft.size;
    if (draft.is_section) return draft.volume.moments * (m / draft.volume.volume);
    if (draft.shape == "box") {
      const Vec3 e2(s[0] * s[0], s[1] * s[1], s[2] * s[2]);
      return m / 12 * Vec3(e2.y() + e2.z(), e2.x() + e2.z(), e2.x() + e2.y());
    }
    if (draft.shape == "ellipsoid") {
      const Vec3 a2(s[0] * s[0], s[1] * s[1], s[2] * s[2]);
      return m / 5 * Vec3(a2.y() + a2.z(), a2.x() + a2.z(), a2.x() + a2.y());
    }
    if (draft.shape == "sphere") return Vec3::Constant(0.4 * m * s[0] * s[0]);
    if (draft.shape == "direct") {
      Variables variables = now_;
      variables["m"] = m;
      ConfigTable table = subject_.table("body", "").table(draft.name, "");
      const std::vector<double> v =
          formula(table, "inertia", 3, "moments about the centre of mass", variables);
      return {v[0], v[1], v[2]};
    }
    const double r2 = s[0] * s[0], l2 = s[1] * s[1];
    const double across = m * (l2 / 12 + r2 / 4), along = m * r2 / 2;
    return draft.shape == "cylinder_y" ? Vec3(across, along, across) : Vec3(across, across, along);
  }

  // The printed moments of head and neck are the sum of the central moments of their bodies [E].
  void correct_head_inertia() {
    if (!subject_.has("head_neck_inertia")) return;
    const std::vector<double> table = subject_.quantities(
        "head_neck_inertia", Dimension::Inertia, 3,
        "sum of the central moments of head and neck bodies; default: from head mass and size");
    Vec3 rest(table[0], table[1], table[2]);
    Draft* head = nullptr;
    for (Draft& draft : drafts_) {
      if (draft.group == "neck") rest -= draft.segment.inertia.diagonal();
      if (draft.name == "head") head = &draft;
    }
    const bool is_sound = rest.minCoeff() > 0 && 2 * rest.maxCoeff() <= rest.sum();
    if (head != nullptr && is_sound) {
      head->segment.inertia = rest.asDiagonal();
    } else if (head != nullptr) {
      subject_.problem("head_neck_inertia", "moments that leave a possible inertia to the head",
                       fmt::format("{:.4g}, {:.4g}, {:.4g} kg m2 left", rest[0], rest[1], rest[2]));
    }
  }

  // ---- left and right
  void place_segments() {
    for (const Draft& draft : drafts_) {
      if (!draft.paired) add_segment(draft, "", 1);
    }
    for (const auto& [suffix, side] : {std::pair{"_l", 1}, std::pair{"_r", -1}}) {
      for (const Draft& draft : drafts_) {
        if (draft.paired) add_segment(draft, suffix, side);
      }
    }
  }

  void add_segment(const Draft& draft, const std::string& suffix, int side) {
    Segment segment = draft.segment;
    segment.name = draft.name + suffix;
    segment.joint_centre.y() *= side;
    segment.com.y() *= side;
    if (segment.joint == JointType::Free) {
      segment.parent = -1;
    } else {
      segment.parent = out_.find_segment(draft.parent + suffix);
      if (segment.parent < 0) segment.parent = out_.find_segment(draft.parent);
      if (segment.parent < 0) {
        subject_.problem("body", "a parent above its child",
                         fmt::format("parent `{}` of `{}`", draft.parent, draft.name));
      }
    }
    if (side < 0) mirror(segment.restraint);
    if (segment.restraint.bone.bending > 0) segment.restraint.bone.bone += suffix;
    out_.segments.push_back(segment);
  }

  static void mirror(JointRestraint& restraint) {
    for (int i = 1; i < 3; ++i) {
      CoordinateLaw& law = restraint.angle[i];
      std::swap(law.min, law.max);
      law.min = -law.min;
      law.max = -law.max;
      std::swap(law.low, law.high);
    }
  }

  // ---- restraints
  JointRestraint read_restraint(ConfigTable& table) {
    JointRestraint restraint;
    const double g = girth(table);
    const double l = length_ratio(table);
    restraint.coordinates =
        table.choice_or("coordinates", {"cardan", "swing_twist"}, "cardan",
                        "how the three angles of a ball joint are taken") == "cardan"
            ? Coordinates::Cardan
            : Coordinates::SwingTwist;
    constexpr std::array<const char*, 3> kNames = {"alpha", "beta", "gamma"};
    for (int i = 0; i < 3; ++i) {
      if (!table.has(kNames[i])) continue;
      ConfigTable angle = table.table(kNames[i], "restraint about y (alpha), x (beta), z (gamma)");
      restraint.angle[i] = read_coordinate(angle, g, l);
    }
    if (table.has("bone")) {
      ConfigTable bone = table.table("bone", "bending and torsion of a long bone");
      restraint.bone = read_bone(bone, g, l);
    }
    if (table.has("shear_x")) {
      restraint.shear = table
                            .curve("shear", Dimension::Length, Dimension::Force,
                                   Curve::Outside::LastSlope, "lateral shear force, odd")
                            .scaled(g, g * g);
      restraint.shear_damping = g * g *
                                table.quantity("shear_c", Dimension::Damping, kNonNegative,
                                               "damping of the lateral shear");
    }
    return restraint;
  }

  CoordinateLaw read_coordinate(ConfigTable& table, double g, double l) {
    CoordinateLaw law;
    const double stiffness = std::pow(g, 4) / l, moment = std::pow(g, 3), damping = std::pow(g, 4);
    law.damping = damping * table.quantity("c", Dimension::AngularDamping, kNonNegative, "damping");
    law.friction = moment * table.quantity_or("friction", Dimension::Moment, kNonNegative, 0,
                                              "Coulomb friction moment");
    if (table.has("ligament_x")) {
      law.min = -10;  // no stop: the ligament curve bounds the motion
      law.max = 10;
      law.ligament = read_ligament(table, moment);
      return law;
    }
    const std::vector<double> range =
        table.quantities("range", Dimension::Angle, 2, "free range between the stops");
    law.min = range[0];
    law.max = range[1];
    law.k0 = stiffness * table.quantity_or("k0", Dimension::AngularStiffness, kNonNegative, 0,
                                           "stiffness about the initial angle");
    const double k1 = table.quantity("k1", Dimension::AngularStiffness, kNonNegative,
                                     "linear stop stiffness beyond the range");
    const double k2 =
        table.quantity("k2", Dimension::None, kNonNegative, "quadratic stop stiffness, N m/rad2");
    law.high = {stiffness * k1, stiffness * k2};
    law.low = {
        stiffness * table.quantity_or("k1_low", Dimension::AngularStiffness, kNonNegative, k1,
                                      "linear stop stiffness below the range; default k1"),
        stiffness * table.quantity_or("k2_low", Dimension::None, kNonNegative, k2,
                                      "quadratic stop stiffness below the range; default k2")};
    const std::string passive = table.choice_or("passive", {"none", "hip", "knee", "ankle"}, "none",
                                                "two-joint passive moment [riener1999]");
    law.passive = passive == "hip"     ? PassiveMoment::Hip
                  : passive == "knee"  ? PassiveMoment::Knee
                  : passive == "ankle" ? PassiveMoment::Ankle
                                       : PassiveMoment::None;
    law.passive_factor = moment;
    return law;
  }

  static LigamentLaw read_ligament(ConfigTable& table, double moment) {
    LigamentLaw law;
    law.moment = table
                     .curve("ligament", Dimension::Angle, Dimension::Moment,
                            Curve::Outside::LastSlope, "moment about the initial angle, odd")
                     .scaled(1, moment);
    law.unloading = moment * table.quantity("unloading", Dimension::AngularStiffness, kPositive,
                                            "slope of unloading");
    law.failure = table.quantity("failure", Dimension::Angle, kPositive, "angle at which it tears");
    law.undamaged = moment * table.quantity("undamaged", Dimension::AngularStiffness, kPositive,
                                            "slope beyond 12 deg when failure is off");
    return law;
  }

  BoneLaw read_bone(ConfigTable& table, double g, double l) {
    const double stiffness = std::pow(g, 4) / l, damping = std::pow(g, 4);
    BoneLaw law;
    law.bone = table.text("name", "bone the joint belongs to");
    law.bending = stiffness * table.quantity("bending", Dimension::AngularStiffness, kPositive,
                                             "bending stiffness");
    law.torsion = stiffness * table.quantity("torsion", Dimension::AngularStiffness, kPositive,
                                             "torsion stiffness");
    law.bending_damping = damping * table.quantity("bending_c", Dimension::AngularDamping,
                                                   kNonNegative, "bending damping");
    law.torsion_damping = damping * table.quantity("torsion_c", Dimension::AngularDamping,
                                                   kNonNegative, "torsion damping");
    law.fracture_moment =
        bone_quality_ * std::pow(girth(table, "fracture_girth"), 3) *
        table.quantity("fracture", Dimension::Moment, kPositive, "bending moment at fracture");
    return law;
  }

  // ---- surfaces and contacts
  void read_regions() {
    ConfigTable contact = subject_.table("contact", "contact of the body");
    const double permanent =
        contact.quantity("flesh_permanent_fraction", Dimension::None, {0, 0.99},
                         "penetration left after unloading, as a fraction of the largest");
    const double exponent = contact.quantity("unloading_exponent", Dimension::None, {1, 10},
                                             "exponent of the unloading curve");
    ConfigTable regions = subject_.table("region", "contact curves of the body surface");
    for (const std::string& name : regions.table_names()) {
      ConfigTable table = regions.table(name, "contact curve of one region");
      const double g = girth(table);
      const double l = length_ratio(table);
      const Curve force = table.curve("force", Dimension::Length, Dimension::Force,
                                      Curve::Outside::LastSlope, "force against penetration");
      out_.regions.push_back({name, {force.scaled(g, g * l), permanent, exponent}});
    }
  }

  void read_ellipsoids() {
    std::vector<std::string> region_names;
    for (const Region& region : out_.regions) region_names.push_back(region.name);
    ConfigTable ellipsoids = subject_.table("ellipsoid", "surface ellipsoids");
    for (const std::string& name : ellipsoids.table_names()) {
      ConfigTable table = ellipsoids.table(name, "one surface ellipsoid");
      const std::string body = table.text("body", "body that carries it");
      const bool paired = table.flag_or("paired", false, "two of them on one unpaired body");
      const std::string region = table.choice_or("region", region_names, "", "contact region");
      SurfaceEllipsoid shape;
      shape.centre = vector(table, "centre", "centre");
      shape.semi_axes = vector(table, "semi_axes", "semi-axes");
      if (!(shape.semi_axes.minCoeff() > 0)) {
        table.problem("semi_axes", "three positive lengths",
                      fmt::format("{:.1f} mm", 1e3 * shape.semi_axes.minCoeff()));
      }
      const auto found = std::find(region_names.begin(), region_names.end(), region);
      if (found == region_names.end()) table.problem("region", "a contact region", region);
      shape.region = static_cast<int>(found - region_names.begin());
      add_ellipsoid(shape, name, body, paired);
    }
  }

  void add_ellipsoid(SurfaceEllipsoid shape, const std::string& name, const std::string& body,
                     bool paired_on_one_body) {
    const int single = out_.find_segment(body);
    if (single >= 0 && !paired_on_one_body) {
      shape.name = name;
      shape.segment = single;
      out_.ellipsoids.push_back(shape);
      return;
    }
    for (const auto& [suffix, side] : {std::pair{"_l", 1}, std::pair{"_r", -1}}) {
      SurfaceEllipsoid copy = shape;
      copy.name = name + suffix;
      copy.centre.y() *= side;
      copy.segment = single >= 0 ? single : out_.find_segment(body + suffix);
      if (copy.segment >= 0) out_.ellipsoids.push_back(copy);  // else amputated
    }
  }

  void read_bushings() {
    ConfigTable table = subject_.table("scapulothoracic", "scapula on the rib cage");
    const std::vector<double> k =
        table.quantities("stiffness", Dimension::Stiffness, 3, "along x, y, z of torso_up");
    const double g = girth(table);
    Bushing bushing;
    bushing.stiffness = g * Vec3(k[0], k[1], k[2]);
    bushing.damping =
        g * g * table.quantity("damping", Dimension::Damping, kNonNegative, "damping");
    bushing.stop = g * table.quantity("stop", Dimension::Length, kPositive,
                                      "lateral travel before the quadratic stop");
    bushing.stop_stiffness = 1e6 * table.quantity("stop_MN_per_m2", Dimension::None, kNonNegative,
                                                  "quadratic lateral stop, MN/m2");
    bushing.base = out_.find_segment("torso_up");
    for (const char* name : {"scapula_l", "scapula_r"}) {
      bushing.segment = out_.find_segment(name);
      if (bushing.segment >= 0 && bushing.base >= 0) out_.bushings.push_back(bushing);
    }
  }

  void read_self_contacts() {
    ConfigTable table = subject_.table("self_contact", "contacts of the body with itself");
    out_.contact.friction_self =
        table.quantity("friction", Dimension::None, {0, 2}, "friction of body on body");
    const auto pair_up = [this](const std::string& a, const std::string& b) {
      const int first = out_.find_ellipsoid(a), second = out_.find_ellipsoid(b);
      if (first >= 0 && second >= 0) out_.self_contacts.emplace_back(first, second);
    };
    const auto trunk = words(table.text("trunk", "trunk ellipsoids that the limbs may touch"));
    for (const std::string& limb :
         words(table.text("limbs", "limb ellipsoids that may touch it"))) {
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

  void read_contact() {
    ConfigTable table = subject_.table("contact", "contact of the body");
    ContactSettings& contact = out_.contact;
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

  struct Section {
    bool is_trunk = false;
    Vec3 top = Vec3::Zero();
    double length = 0;
    Curve a, b, x;  // a: radius of a limb
  };

  ConfigTable subject_;
  Variables now_, reference_;
  double bone_quality_ = 1;
  std::map<std::string, Group> groups_;
  std::map<std::string, Section> sections_;
  std::vector<Draft> drafts_;
  BodyDescription out_;
};

}  // namespace

BodyDescription read_body_description(ConfigTable subject) {
  return SubjectReader(std::move(subject)).read();
}

}  // namespace crosswalk
