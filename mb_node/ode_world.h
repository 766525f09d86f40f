// The Open Dynamics Engine behind values: rigid bodies, ideal joints, one step, raw state in and
// out.
//
// The only file pair that knows ODE. Joints are bilateral equalities (ball, hinge, universal,
// slider); restraints, contacts and car are forces that the caller adds before each step, so the
// step is ODE's semi-implicit Euler with a plain linear solve. World frame W, SI; body origin at
// the centre of mass.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/spatial.h"
#include "mb_node/tree_solver.h"

namespace crosswalk::mb {

enum class Stepper {
  Direct,  ///< ODE's equations of the step, joint forces solved along the tree (tree_solver.h)
  Dense,   ///< dWorldStep: ODE's dense factorisation of the same equations, ten times slower
  Quick    ///< dWorldQuickStep: successive over-relaxation, joints only nearly closed
};

/// Everything ODE remembers of its bodies between two steps, copied bit by bit.
struct WorldState {
  std::vector<double> bodies;  ///< per body: position 3, quaternion 4, rotation 12, velocities 6
  unsigned long random_seed = 0;
};

class OdeWorld {
 public:
  static constexpr int kQuickIterations = 20;  ///< more change no printed digit at 10 us

  explicit OdeWorld(Stepper stepper, int quick_iterations = kQuickIterations);
  ~OdeWorld();
  OdeWorld(OdeWorld&&) noexcept;
  OdeWorld& operator=(OdeWorld&&) noexcept;

  /// Adds a body at rest; `about_com` in body axes. Returns its index.
  int add_body(double mass, const Mat3& about_com, const Pose& X_WB);
  /// Joins `child` to `parent` (-1: the world) as they stand now. Hinge and slider move about/along
  /// `axis_1`; a universal joint has `axis_1` fixed in the parent and `axis_2` in the child.
  void add_joint(JointKind kind, int parent, int child, const Vec3& p_W,
                 const Vec3& axis_1 = Vec3::UnitX(), const Vec3& axis_2 = Vec3::UnitY());

  int body_count() const;
  double mass(int body) const;
  const Mat3& inertia(int body) const;
  Pose pose(int body) const;
  Mat3 rotation(int body) const;
  Vec3 position(int body) const;
  Twist twist(int body) const;  ///< of the centre of mass
  void set_pose(int body, const Pose& X_WB);
  void set_twist(int body, const Twist& V_WB);

  void set_gravity(const Vec3& g_W);
  /// Loads of the next step only.
  void add_force_at(int body, const Vec3& f_W, const Vec3& p_W);
  void add_torque(int body, const Vec3& tau_W);
  void clear_loads();
  void step(double dt);

  WorldState save() const;
  /// Bit-exact: a step after restore() repeats the step after save().
  void restore(const WorldState& state);

  double kinetic_energy() const;
  Vec3 linear_momentum() const;
  Vec3 angular_momentum(const Vec3& about_W) const;
  /// Largest distance between the two anchors of any ball, hinge or universal joint, and its child.
  struct JointDrift {
    double distance = 0;
    int child = -1;
  };
  JointDrift joint_drift() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A point fixed in a body.
struct BodyPoint {
  int body = -1;
  Vec3 p_B = Vec3::Zero();  ///< from the centre of mass, body axes
};

/// Velocity change (linear, angular) of each point per unit impulse (N s, N m s) on each, all
/// joints acting: W = J M^-1 J^T, 6n x 6n, measured by one step per column and symmetrised.
/// Positive definite, or semi-definite when a joint links two of the bodies. The world is left as
/// found. Throws NumericalError when the scaled W (unit diagonal) is not so to within
/// `kMobilityAsymmetry`.
inline constexpr double kMobilityAsymmetry = 1e-6;
Eigen::MatrixXd measure_mobility(OdeWorld& world, std::span<const BodyPoint> points, double dt,
                                 double time_s);

}  // namespace crosswalk::mb
