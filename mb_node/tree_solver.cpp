#include "mb_node/tree_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/error.h"

namespace crosswalk::mb {
namespace {

int rows_of(JointKind kind) {
  switch (kind) {
    case JointKind::Free:
      return 0;
    case JointKind::Ball:
      return 3;
    case JointKind::Universal:
      return 4;
    case JointKind::Hinge:
    case JointKind::Slider:
      return 5;
  }
  return 0;
}

/// Inverse of a symmetric positive definite matrix by blocks of 3.
Eigen::Matrix<double, 6, 6> inverse_of(const Eigen::Matrix<double, 6, 6>& m) {
  const Mat3 A = m.topLeftCorner<3, 3>().inverse();
  const Mat3 B = m.topRightCorner<3, 3>();
  const Mat3 AB = A * B;
  const Mat3 S = (m.bottomRightCorner<3, 3>() - B.transpose() * AB).inverse();
  Eigen::Matrix<double, 6, 6> out;
  out.bottomRightCorner<3, 3>() = S;
  out.topRightCorner<3, 3>() = -AB * S;
  out.bottomLeftCorner<3, 3>() = out.topRightCorner<3, 3>().transpose();
  out.topLeftCorner<3, 3>() = A - AB * out.bottomLeftCorner<3, 3>();
  return out;
}

}  // namespace

Vec3 gyroscopic_torque(const Mat3& I_W, const Vec3& w, double dt) {
  const Vec3 L = I_W * w;
  const Mat3 tilted = I_W - dt * skew(L);
  return (I_W * (tilted.inverse() * L) - L) / dt;
}

void TreeSolver::add_body(double mass, const Mat3& about_com) {
  Body body;
  body.mass = mass;
  body.about_com = about_com;
  bodies_.push_back(body);
  work_.emplace_back();
}

void TreeSolver::add_joint(JointKind kind, int parent, int child, const Vec3& p_W,
                           const Vec3& axis_1, const Vec3& axis_2,
                           const std::vector<BodyNow>& now) {
  if (kind == JointKind::Free) return;
  Body& body = bodies_[child];
  if (parent >= child || body.kind != JointKind::Free) is_tree_ = false;
  body.kind = kind;
  body.parent = parent;
  const BodyNow world;
  const BodyNow& p = parent < 0 ? world : now[parent];
  const BodyNow& c = now[child];
  // A slider's anchor is the parent's centre of mass, as ODE has it.
  const Vec3 anchor = kind == JointKind::Slider ? p.p : p_W;
  body.p_P = p.R.transpose() * (anchor - p.p);
  body.p_C = c.R.transpose() * (anchor - c.p);
  body.axis_P = (p.R.transpose() * axis_1).normalized();
  body.axis_C = (c.R.transpose() * (kind == JointKind::Universal ? axis_2 : axis_1)).normalized();
  body.q_PC = p.q.conjugate() * c.q;
}

// ODE's rows: J v = c with c the share erp/h of the position error; signs parent +, child -.
void TreeSolver::write_rows(int child, double rate, const std::vector<BodyNow>& now) {
  const Body& body = bodies_[child];
  static const BodyNow kWorld;
  const BodyNow& p = body.parent < 0 ? kWorld : now[body.parent];
  const BodyNow& c = now[child];
  Work& work = work_[child];
  const Vec3 axis = p.R * body.axis_P;
  if (body.kind == JointKind::Slider) {
    work.Jp.topRows<3>() << Mat3::Zero(), Mat3::Identity();
    work.Jc.topRows<3>() = -work.Jp.topRows<3>();
    Quat error = (p.q.conjugate() * c.q) * body.q_PC.conjugate();
    if (error.w() < 0) error.coeffs() *= -1;
    work.target.head<3>() = rate * 2 * (p.R * error.vec());
    const Vec3 across = axis.unitOrthogonal(), third = axis.cross(across);
    const Vec3 between = c.p - p.p;
    const Vec3 gap = between + c.R * body.p_C;
    int row = 3;
    for (const Vec3& n : {across, third}) {
      const Vec3 arm = 0.5 * between.cross(n);
      work.Jp.row(row) << n.transpose(), arm.transpose();
      work.Jc.row(row) << -n.transpose(), arm.transpose();
      work.target[row++] = rate * n.dot(gap);
    }
    return;
  }
  const Vec3 arm_p = p.R * body.p_P, arm_c = c.R * body.p_C;
  work.Jp.topRows<3>() << Mat3::Identity(), -skew(arm_p);
  work.Jc.topRows<3>() << -Mat3::Identity(), skew(arm_c);
  work.target.head<3>() = rate * (c.p + arm_c - p.p - arm_p);
  if (body.kind == JointKind::Ball) return;
  const Vec3 axis_c = c.R * body.axis_C;
  const auto set_angular = [&work](int row, const Vec3& n, double target) {
    work.Jp.row(row) << 0, 0, 0, n.transpose();
    work.Jc.row(row) = -work.Jp.row(row);
    work.target[row] = target;
  };
  if (body.kind == JointKind::Universal) {
    set_angular(3, axis.cross(axis_c).normalized(), -rate * axis.dot(axis_c));
    return;
  }
  const Vec3 across = axis.unitOrthogonal(), third = axis.cross(across), u = axis.cross(axis_c);
  set_angular(3, across, rate * u.dot(across));
  set_angular(4, third, rate * u.dot(third));
}

template <int Rows>
void TreeSolver::eliminate(int child, double compliance) {
  Work& work = work_[child];
  const Eigen::Matrix<double, 6, 6> flexibility = inverse_of(work.mass);
  const Eigen::Matrix<double, Rows, 6> Jc = work.Jc.topRows<Rows>();
  const Eigen::Matrix<double, Rows, 6> Jp = work.Jp.topRows<Rows>();
  const Eigen::Matrix<double, 6, Rows> inverse = flexibility * Jc.transpose();
  Eigen::Matrix<double, Rows, Rows> S = Jc * inverse;
  S.diagonal().array() += compliance;
  const Eigen::LLT<Eigen::Matrix<double, Rows, Rows>> softness(S);
  work.rest = flexibility * work.load;
  const Eigen::Matrix<double, Rows, 1> r =
      work.target.head<Rows>() - inverse.transpose() * work.load;
  const Eigen::Matrix<double, Rows, 6> gain = softness.solve(Jp);
  work.inverse.leftCols<Rows>() = inverse;
  work.gain.topRows<Rows>() = gain;
  work.target.head<Rows>() = softness.solve(r);
  if (bodies_[child].parent < 0) return;
  Work& parent = work_[bodies_[child].parent];
  parent.mass += Jp.transpose() * gain;
  parent.load += gain.transpose() * r;
}

template <int Rows>
void TreeSolver::resolve(int child, std::vector<Wrench>& loads) {
  Work& work = work_[child];
  const int parent = bodies_[child].parent;
  Eigen::Matrix<double, Rows, 1> lambda = work.target.head<Rows>();
  if (parent >= 0) {
    lambda -= work.gain.topRows<Rows>() * work_[parent].rest;
    loads[parent] += wrench_from(Vec6(work.Jp.topRows<Rows>().transpose() * lambda));
  }
  loads[child] += wrench_from(Vec6(work.Jc.topRows<Rows>().transpose() * lambda));
  work.rest += work.inverse.leftCols<Rows>() * lambda;
}

void TreeSolver::add_joint_loads(double dt, const JointSoftness& softness,
                                 const std::vector<BodyNow>& now, std::vector<Wrench>& loads) {
  CW_ASSERT(is_tree_ && now.size() == bodies_.size() && loads.size() == bodies_.size());
  const int n = static_cast<int>(bodies_.size());
  for (int i = 0; i < n; ++i) {
    const BodyNow& b = now[i];
    const Mat3 I = b.R * bodies_[i].about_com * b.R.transpose();
    Work& work = work_[i];
    work.mass.setZero();
    work.mass.topLeftCorner<3, 3>().diagonal().setConstant(bodies_[i].mass);
    work.mass.bottomRightCorner<3, 3>() = I;
    work.load << b.load.f + bodies_[i].mass / dt * b.V.v,
        b.load.tau + gyroscopic_torque(I, b.V.w, dt) + I * b.V.w / dt;
    if (bodies_[i].kind != JointKind::Free) write_rows(i, softness.erp / (dt * dt), now);
  }
  const double compliance = softness.cfm / dt;
  for (int i = n - 1; i >= 0; --i) {
    switch (rows_of(bodies_[i].kind)) {
      case 3:
        eliminate<3>(i, compliance);
        break;
      case 4:
        eliminate<4>(i, compliance);
        break;
      case 5:
        eliminate<5>(i, compliance);
        break;
      default:
        work_[i].rest = inverse_of(work_[i].mass) * work_[i].load;
    }
  }
  for (int i = 0; i < n; ++i) {
    switch (rows_of(bodies_[i].kind)) {
      case 3:
        resolve<3>(i, loads);
        break;
      case 4:
        resolve<4>(i, loads);
        break;
      case 5:
        resolve<5>(i, loads);
        break;
      default:
        break;
    }
  }
}

}  // namespace crosswalk::mb
