// Forces of the ideal joints of a tree of bodies, in one sweep up and one down: O(bodies).
//
// ODE's direct step solves (J M^-1 J^T + cfm/h) lambda = c/h - J (v/h + M^-1 f) with a dense
// factorisation of all joint rows. Joints form a tree, so the same equations are eliminated from
// the leaves to the root without fill [baraff1996]: with M', b' of a child after its own children,
//   S = Jc M'^-1 Jc^T + cfm/h,   r = c/h - Jc M'^-1 b',   lambda = S^-1 (r - Jp a_parent),
//   M_parent' += Jp^T S^-1 Jp,   b_parent' += Jp^T S^-1 r,
// where b = M v/h + f and a = (new v)/h. Rows, right-hand sides and the gyroscopic torque are those
// of ODE 0.16. W axes, 6-vectors (linear, angular) at the centres of mass, SI.
#pragma once

#include <vector>

#include "common/spatial.h"

namespace crosswalk::mb {

/// Free: no joint (the child floats).
enum class JointKind { Free, Ball, Hinge, Universal, Slider };

struct JointSoftness {
  double erp = 0.2;    ///< share of a position error removed per step
  double cfm = 1e-10;  ///< compliance, times h: 1/kg
};

/// What changes of a body from step to step.
struct BodyNow {
  Vec3 p = Vec3::Zero();  ///< centre of mass
  Quat q = Quat::Identity();
  Mat3 R = Mat3::Identity();
  Twist V;
  Wrench load;  ///< all forces but those of the joints and the gyroscopic torque
};

class TreeSolver {
 public:
  void add_body(double mass, const Mat3& about_com);
  /// Joins `child` to `parent` (-1: the world) as they stand; arguments as OdeWorld::add_joint.
  void add_joint(JointKind kind, int parent, int child, const Vec3& p_W, const Vec3& axis_1,
                 const Vec3& axis_2, const std::vector<BodyNow>& now);
  /// Every body has one joint at most, to the world or to a body added before it.
  bool is_tree() const { return is_tree_; }
  /// Adds the joint forces of a step of length dt to `loads`, one per body.
  void add_joint_loads(double dt, const JointSoftness& softness, const std::vector<BodyNow>& now,
                       std::vector<Wrench>& loads);

 private:
  struct Body {
    double mass = 0;
    Mat3 about_com = Mat3::Zero();
    JointKind kind = JointKind::Free;
    int parent = -1;
    bool has_parent_body = false;
    Vec3 p_P = Vec3::Zero(), p_C = Vec3::Zero();        ///< anchor in both body frames
    Vec3 axis_P = Vec3::Zero(), axis_C = Vec3::Zero();  ///< in both body frames
    Quat q_PC = Quat::Identity();                       ///< of the start: sliders
  };
  /// One elimination: what is needed on the way down again.
  struct Work {
    Eigen::Matrix<double, 6, 6> mass;
    Vec6 load;                            ///< b'
    Eigen::Matrix<double, 5, 6> Jc, Jp;   ///< rows of the joint to the parent
    Eigen::Matrix<double, 5, 1> target;   ///< c/h, then S^-1 r
    Eigen::Matrix<double, 6, 5> inverse;  ///< M'^-1 Jc^T
    Eigen::Matrix<double, 5, 6> gain;     ///< S^-1 Jp
    Vec6 rest;                            ///< M'^-1 b', then the acceleration a
  };
  void write_rows(int child, double rate, const std::vector<BodyNow>& now);
  template <int Rows>
  void eliminate(int child, double compliance);
  template <int Rows>
  void resolve(int child, std::vector<Wrench>& loads);

  std::vector<Body> bodies_;
  std::vector<Work> work_;
  bool is_tree_ = true;
};

/// Torque that ODE adds to a free body for its implicit gyroscopic step [lacoursiere2006].
Vec3 gyroscopic_torque(const Mat3& I_W, const Vec3& w, double dt);

}  // namespace crosswalk::mb
