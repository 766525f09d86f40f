// A pedestrian as plain data, scaled to its subject: bodies, joints, surface ellipsoids,
// restraints.
//
// Reference posture: erect, arms hanging, all body axes along W (x forward, y left, z up), floor z
// = 0. Every position is given in that posture in W; a body's frame has its origin at the centre of
// mass.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/anthropometry.h"
#include "common/contact_shapes.h"
#include "common/curve.h"
#include "common/spatial.h"

namespace crosswalk {

enum class JointType { Free, Ball, HingeX, HingeY, HingeZ, UniversalXY, SliderY };
/// How the three angles of a ball joint are taken from a rotation R.
enum class Coordinates {
  Cardan,     ///< R = Ry(alpha) Rx(beta) Rz(gamma); singular at |beta| = 90 deg
  SwingTwist  ///< swing vector (beta about x, alpha about y) after a twist gamma about the limb
              ///< axis z; singular at a swing of 180 deg
};
/// The angles of a ball joint are those of R = R_PZ^T R_PC, so that the singularity can be laid
/// where the limb cannot go.
struct AngleFrame {
  Coordinates coordinates = Coordinates::Cardan;
  Mat3 R_PZ = Mat3::Identity();  ///< rotation of the child in its parent at zero angles
};
/// Passive moments that depend on the angles of two joints [riener1999].
enum class PassiveMoment { None, Hip, Knee, Ankle };

/// Stop moment k1 D + k2 D^2 at a depth D beyond the end of the free range.
struct StopLaw {
  double k1 = 0;  ///< N m/rad
  double k2 = 0;  ///< N m/rad2
};

/// A ligament that yields and tears: odd curve about the initial angle, unloading along a fixed
/// slope.
struct LigamentLaw {
  Curve moment;          ///< rad -> N m, x >= 0
  double unloading = 0;  ///< N m/rad
  double failure = 0;    ///< rad; beyond it the ligament is torn
  double undamaged = 0;  ///< N m/rad, slope past the last intact point when failure is switched off
};

/// Restraint of one generalised coordinate, SI, signs of the body's own side.
struct CoordinateLaw {
  double min = 0, max = 0;  ///< rad, free range
  double k0 = 0;            ///< N m/rad about the initial angle
  StopLaw low, high;
  double damping = 0;   ///< N m s/rad
  double friction = 0;  ///< N m
  PassiveMoment passive = PassiveMoment::None;
  double passive_factor = 1;
  LigamentLaw ligament;  ///< empty curve: none
};

/// Bending and torsion of a long bone, the same about all lateral axes.
struct BoneLaw {
  std::string bone;                 ///< such as "femur_l": at most one fracture each
  double bending = 0, torsion = 0;  ///< N m/rad
  double bending_damping = 0, torsion_damping = 0;  ///< N m s/rad
  double fracture_moment = 0;                       ///< N m
};

struct JointRestraint {
  AngleFrame frame;
  std::array<CoordinateLaw, 3> angle;  ///< alpha (y), beta (x), gamma (z); unused ones stay zero
  BoneLaw bone;                        ///< bending > 0: a bone joint, `angle` unused
  Curve shear;                         ///< m -> N, x >= 0, odd: lateral slider
  double shear_damping = 0;            ///< N s/m
};

struct Segment {
  std::string name;  ///< such as "torso_up", "femur_1_r"
  int parent = -1;
  JointType joint = JointType::Free;
  Vec3 joint_centre = Vec3::Zero();
  double mass = 0;
  Vec3 com = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass
  JointRestraint restraint;
};

struct SurfaceEllipsoid {
  std::string name;
  int segment = -1;
  int region = -1;
  Vec3 centre = Vec3::Zero();
  Vec3 semi_axes = Vec3::Zero();
};

struct Region {
  std::string name;
  Characteristic flesh;
};

/// Scapula on the rib cage: springs between the scapula's centre of mass and its initial image.
struct Bushing {
  int segment = -1, base = -1;
  Vec3 stiffness = Vec3::Zero();  ///< N/m along the axes of `base`
  double damping = 0;             ///< N s/m
  double stop = 0;                ///< m of |y| before the quadratic stop
  double stop_stiffness = 0;      ///< N/m2
};

struct ContactSettings {
  double rate = 0;  ///< s/m: force x (1 + rate v), v the approach speed
  double friction_ground = 0, friction_self = 0;
  double ground_foot = 0, ground_body = 0;  ///< N/m per ellipsoid
  double ground_damping = 0;                ///< N s/m
};

/// One equation of the height reconciliation, m: how well the solved heights satisfy it.
struct HeightResidual {
  std::string equation;
  double residual = 0;
  double sigma = 0;
};

struct BodyDescription {
  std::string name;
  Anthropometry measures;
  std::vector<HeightResidual> height_residuals;
  std::vector<Segment> segments;
  std::vector<SurfaceEllipsoid> ellipsoids;
  std::vector<Region> regions;
  std::vector<Bushing> bushings;
  std::vector<std::pair<int, int>> self_contacts;  ///< pairs of ellipsoids
  ContactSettings contact;

  /// -1 when absent.
  int find_segment(std::string_view name) const;
  int find_ellipsoid(std::string_view name) const;
  double total_mass() const;
};

/// Reads and scales the subject of a scenario's [subject] table; faults are problems of the
/// document.
BodyDescription read_body_description(ConfigTable subject);

/// The same pedestrian without head and neck, for the coupled run.
BodyDescription without_head_and_neck(const BodyDescription& body);

/// The 35 measures taken back from the description's own joints and ellipsoids.
Anthropometry measured_on(const BodyDescription& body);

}  // namespace crosswalk
