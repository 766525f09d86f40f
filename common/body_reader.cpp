// Reads a subject file (formulas in body measures) into a BodyDescription.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "common/body_description.h"
#include "common/body_formulas.h"
#include "common/body_scaling.h"
#include "common/joint_reader.h"
#include "common/surface_reader.h"
#include "common/words.h"

namespace crosswalk {
namespace {

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
};

struct Group {
  double fraction = 0, weight = 0, mass = 0;
  bool paired = false, is_head_neck = false;
};

/// A shape of uniform density that bodies are cut from.
struct Section {
  bool is_trunk = false;
  Vec3 top = Vec3::Zero();
  double length = 0;
  Curve a, b, x;  // a: radius of a limb
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
    read_surface(subject_, formulas_, out_);
    return std::move(out_);
  }

 private:
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
    refuse_contradiction();
    const JointHeights heights = solve_heights(out_.measures, overrides);
    Variables now = body_variables(out_.measures, heights, overrides);
    out_.height_residuals = heights.residuals;
    for (const char* length : {"L_th", "L_sh", "L_ua", "L_fa", "z_ankle"}) {
      if (now[length] > 0) continue;
      subject_.problem("", fmt::format("measures that leave {} positive", length),
                       fmt::format("{:.1f} mm", 1e3 * now[length]),
                       "the measured heights contradict each other");
    }
    formulas_ =
        BodyFormulas(std::move(now), body_variables(reference, solve_heights(reference), {}));
    bone_quality_ = subject_.quantity_or("bone_quality", Dimension::None, {0.3, 1.5}, 1,
                                         "factor on fracture moments for age");
  }

  /// Of the heights that were given, the one that the others contradict most.
  void refuse_contradiction() {
    HeightContradiction worst;
    for (const HeightContradiction& c : height_contradictions(out_.measures)) {
      if (subject_.has(c.measure) && c.sigmas > worst.sigmas) worst = c;
    }
    if (worst.sigmas <= kContradiction) return;
    double given = 0;
    for (const Measure& measure : anthropometry_measures()) {
      if (measure.name == worst.measure) given = out_.measures.*measure.value;
    }
    subject_.problem(
        worst.measure,
        fmt::format("about {:.1f} mm, as the other heights say", 1e3 * (given - worst.excess)),
        fmt::format("{:.1f} mm", 1e3 * given),
        fmt::format("{:.1f} mm too {}, {:.1f} standard deviations of the height "
                    "equations; {:g} are allowed",
                    1e3 * std::abs(worst.excess), worst.excess > 0 ? "much" : "little",
                    worst.sigmas, kContradiction));
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
        ratio = formulas_.ratio(table, "volume", "volume measure of the group");
      }
      group.weight = group.fraction * ratio * keep;
    }
  }

  Curve section_curve(ConfigTable& table, std::string_view x, std::string_view y) {
    const std::vector<double> xs = formulas_.list(table, x, 0, "stations");
    const std::vector<double> ys = formulas_.list(table, y, xs.size(), "values at the stations");
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
        section.top = formulas_.vector(table, "top", "proximal end");
        section.length = formulas_.scalar(table, "length", "length");
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
      const JointRestraint restraint = read_restraint(table, formulas_, bone_quality_);
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
    draft.segment.joint_centre = formulas_.vector(table, "at", "joint centre");
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
      draft.segment.com = formulas_.vector(table, "com", "centre of mass");
      draft.share =
          table.quantity_or("share", Dimension::None, {0, 1}, 1, "part of the group mass");
      if (draft.shape != "direct") {
        const std::size_t count = draft.shape == "sphere"                              ? 1
                                  : draft.shape == "box" || draft.shape == "ellipsoid" ? 3
                                                                                       : 2;
        draft.size = formulas_.list(
            table, "size", count, "box edges; semi-axes; radius; radius and length of a cylinder");
      }
    }
    if (table.has("body_mass")) {
      draft.explicit_mass =
          formulas_.scalar(table, "body_mass", "mass taken out of the group first");
    }
    return draft;
  }

  void cut_section(ConfigTable& table, Draft& draft) {
    const std::string name = table.text("section", "shape the body is cut from");
    const std::vector<double> cut =
        formulas_.list(table, "cut", 2, "levels of the trunk, or s of a limb");
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
      ConfigTable table = subject_.table("body", "").table(draft.name, "");
      return formulas_.moments(table, "inertia", "moments about the centre of mass", m);
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
    const Mat3 across = Vec3(1, -1, 1).asDiagonal();
    restraint.frame.R_PZ = across * restraint.frame.R_PZ * across;
    for (int i = 1; i < 3; ++i) {
      CoordinateLaw& law = restraint.angle[i];
      std::swap(law.min, law.max);
      law.min = -law.min;
      law.max = -law.max;
      std::swap(law.low, law.high);
    }
  }

  ConfigTable subject_;
  BodyFormulas formulas_;
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
