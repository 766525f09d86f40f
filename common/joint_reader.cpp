#include "common/joint_reader.h"

#include <array>
#include <cmath>

namespace crosswalk {
namespace {

LigamentLaw read_ligament(ConfigTable& table, double moment) {
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
  law.low = {stiffness * table.quantity_or("k1_low", Dimension::AngularStiffness, kNonNegative, k1,
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

BoneLaw read_bone(ConfigTable& table, const BodyFormulas& formulas, double bone_quality, double g,
                  double l) {
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
      bone_quality * std::pow(formulas.girth(table, "fracture_girth"), 3) *
      table.quantity("fracture", Dimension::Moment, kPositive, "bending moment at fracture");
  return law;
}

}  // namespace

JointRestraint read_restraint(ConfigTable& table, const BodyFormulas& formulas,
                              double bone_quality) {
  JointRestraint restraint;
  const double g = formulas.girth(table);
  const double l = formulas.length_ratio(table);
  restraint.frame.coordinates =
      table.choice_or("coordinates", {"cardan", "swing_twist"}, "cardan",
                      "how the three angles of a ball joint are taken") == "cardan"
          ? Coordinates::Cardan
          : Coordinates::SwingTwist;
  if (table.has("zero_swing")) {
    const std::vector<double> swing =
        table.quantities("zero_swing", Dimension::Angle, 2,
                         "swing (alpha, beta) of the limb from which its angles are counted");
    restraint.frame.R_PZ = exp_rotation({swing[1], swing[0], 0}).toRotationMatrix();
  }
  constexpr std::array<const char*, 3> kNames = {"alpha", "beta", "gamma"};
  for (int i = 0; i < 3; ++i) {
    if (!table.has(kNames[i])) continue;
    ConfigTable angle = table.table(kNames[i], "restraint about y (alpha), x (beta), z (gamma)");
    restraint.angle[i] = read_coordinate(angle, g, l);
  }
  if (table.has("bone")) {
    ConfigTable bone = table.table("bone", "bending and torsion of a long bone");
    restraint.bone = read_bone(bone, formulas, bone_quality, g, l);
    // The same about all lateral axes: the swing is the bend itself, and a broken bone may fold by
    // more than the 90 deg at which Cardan angles end.
    restraint.frame.coordinates = Coordinates::SwingTwist;
  }
  if (table.has("shear_x")) {
    restraint.shear = table
                          .curve("shear", Dimension::Length, Dimension::Force,
                                 Curve::Outside::LastSlope, "lateral shear force, odd")
                          .scaled(g, g * g);
    restraint.shear_damping =
        g * g *
        table.quantity("shear_c", Dimension::Damping, kNonNegative, "damping of the lateral shear");
  }
  return restraint;
}

}  // namespace crosswalk
