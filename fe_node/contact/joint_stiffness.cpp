#include "fe_node/contact/joint_stiffness.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

/// Transposed inverse of the right Jacobian of the exponential map at q: with
/// J^-1 = I + [q]/2 + g [q]^2, g = 1/t^2 - (1 + cos t) / (2 t sin t), t = |q|.
Mat3 inverse_right_jacobian(const Vec3& q) {
  const double t = q.norm();
  constexpr double kSmall = 1e-3;  // below, the series of g is exact to 1e-14
  const double g =
      t < kSmall ? 1.0 / 12 + t * t / 720 : 1 / (t * t) - (1 + std::cos(t)) / (2 * t * std::sin(t));
  const Mat3 S = skew(q);
  return Mat3::Identity() + 0.5 * S + g * S * S;
}

double steepest(const Curve& curve) {
  double slope = 0;
  for (std::size_t i = 1; i < curve.x().size(); ++i)
    slope = std::max(
        slope, std::abs((curve.y()[i] - curve.y()[i - 1]) / (curve.x()[i] - curve.x()[i - 1])));
  return slope;
}

class JointStiffness final : public ContactInterface {
 public:
  JointStiffness(JointStiffnessSpec spec, const JointBody& a, const JointBody& b, double step)
      : ContactInterface(spec.name), spec_(std::move(spec)) {
    const double mobility = spec_.is_translational ? a.mobility(spec_.origin_a - a.centre) +
                                                         b.mobility(spec_.origin_a - b.centre)
                                                   : a.spin_mobility() + b.spin_mobility();
    CW_ASSERT(step > 0 && mobility > 0);  // the model builder refuses two driven bodies
    double stiffness = 0, damping = 0;
    for (JointStiffnessAxis& axis : spec_.axes) {
      const bool has_stop = std::isfinite(axis.stop_low) || std::isfinite(axis.stop_high);
      const double stiff = kStopScale / (mobility * step * step);
      if (has_stop && axis.stop_stiffness == 0) axis.stop_stiffness = stiff;
      if (axis.friction_stiffness == 0) axis.friction_stiffness = stiff;
      double sum = steepest(axis.load);
      if (has_stop) sum += axis.stop_stiffness;
      if (axis.friction_limit > 0) sum += axis.friction_stiffness;
      stiffness = std::max(stiffness, sum);
      damping = std::max(damping, steepest(axis.damping));
    }
    // The damper works on the velocity half a step back: dt <= (sqrt(1 + z^2) - z) 2 / w.
    const double w = std::sqrt(stiffness * mobility),
                 z = 0.5 * damping * mobility / std::max(w, 1e-30);
    if (w > 0)
      stable_step_ = 2 / (w * (std::sqrt(1 + z * z) + z));
    else if (damping > 0)
      stable_step_ = 1 / (damping * mobility);
  }

  void initialise(ContactHistory& history, const ContactContext& context) const override {
    history = {};
    const Quat q_WD = context.bodies[static_cast<std::size_t>(spec_.reference_body)].X_WB.q;
    const auto in_body = [&](int body, const Mat3& axes) {
      const Quat q_BW = context.bodies[static_cast<std::size_t>(body)].X_WB.q.conjugate();
      return Quat(q_BW * q_WD * Quat(axes)).normalized();
    };
    const Quat a = in_body(spec_.body_a, spec_.axes_a), b = in_body(spec_.body_b, spec_.axes_b);
    history.values.assign(kValues, 0.0);
    Eigen::Map<Eigen::Vector4d>(history.values.data()) = a.coeffs();
    Eigen::Map<Eigen::Vector4d>(history.values.data() + 4) = b.coeffs();
    place(history, context, spec_.body_a, spec_.origin_a, 8);
    place(history, context, spec_.body_b, spec_.origin_b, 11);
    at(history, kLast) = coordinates(frames(context, history));
  }

  int max_nodal_loads() const override { return 0; }

  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override {
    ContactReport report;
    report.stable_step = stable_step_;
    report.active = 1;
    const Frames f = frames(context, history);
    const Vec3 q = coordinates(f);
    const Mat3 rate_map = spec_.is_translational ? Mat3::Identity() : inverse_right_jacobian(q);
    const Vec3 rate = rate_map * relative_velocity(f);
    Vec3 load = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      load[i] = along(spec_.axes[static_cast<std::size_t>(i)], q[i], rate[i], context.dt,
                      q[i] - at(history, kLast)[i], at(history, kFriction)[i], report);
    at(history, kLast) = q;
    apply(f, f.R_WB * (rate_map.transpose() * load), loads, report);
    return report;
  }

 private:
  static constexpr int kFriction = 14, kLast = 17, kValues = 20;
  /// Of the triads.
  struct Frames {
    Mat3 R_WA, R_WB;
    Vec3 a, b;  ///< origins, m
    const BodyMotionView *body_a, *body_b;
  };

  static Eigen::Map<Vec3> at(ContactHistory& history, int slot) {
    return Eigen::Map<Vec3>(history.values.data() + slot);
  }
  /// A point of the deck in its body's axes.
  void place(ContactHistory& history, const ContactContext& context, int body, const Vec3& point,
             int slot) const {
    const Pose& X_WR = context.bodies[static_cast<std::size_t>(spec_.reference_body)].X_WB;
    const Vec3 in_world = X_WR * Vec3(point - spec_.reference_origin);
    at(history, slot) = context.bodies[static_cast<std::size_t>(body)].X_WB.inverse() * in_world;
  }

  Frames frames(const ContactContext& context, const ContactHistory& history) const {
    const double* v = history.values.data();
    const BodyMotionView& a = context.bodies[static_cast<std::size_t>(spec_.body_a)];
    const BodyMotionView& b = context.bodies[static_cast<std::size_t>(spec_.body_b)];
    return {(a.X_WB.q * Quat(v[3], v[0], v[1], v[2])).toRotationMatrix(),
            (b.X_WB.q * Quat(v[7], v[4], v[5], v[6])).toRotationMatrix(),
            a.X_WB * Vec3(Eigen::Map<const Vec3>(v + 8)),
            b.X_WB * Vec3(Eigen::Map<const Vec3>(v + 11)),
            &a,
            &b};
  }

  Vec3 coordinates(const Frames& f) const {
    if (spec_.is_translational) return f.R_WB.transpose() * (f.b - f.a);
    return log_rotation(Quat(Mat3(f.R_WA.transpose() * f.R_WB)));
  }

  /// In B's triad: of B against A; of the origins, as B's triad sees it.
  Vec3 relative_velocity(const Frames& f) const {
    const Twist &A = f.body_a->V_WB, &B = f.body_b->V_WB;
    if (!spec_.is_translational) return f.R_WB.transpose() * (B.w - A.w);
    const Vec3 v_a = A.shifted(f.a - f.body_a->X_WB.p).v, v_b = B.shifted(f.a - f.body_b->X_WB.p).v;
    return f.R_WB.transpose() * (v_b - v_a);  // at A's origin, as a point of each body
  }

  /// The load of one axis that holds back, and its energies.
  static double along(const JointStiffnessAxis& axis, double q, double rate, double dt, double dq,
                      double& friction, ContactReport& report) {
    double load = 0;
    if (!axis.load.empty()) {
      load += axis.load.value(q);
      report.stored += axis.load.integral(q) - axis.load.integral(0);
    }
    const double beyond = q - std::clamp(q, axis.stop_low, axis.stop_high);
    load += axis.stop_stiffness * beyond;
    report.stored += 0.5 * axis.stop_stiffness * beyond * beyond;
    report.max_penetration = std::max(report.max_penetration, std::abs(beyond));
    if (!axis.damping.empty()) {
      const double damper = axis.damping.value(rate);
      load += damper;
      report.damping_dissipated += damper * rate * dt;
    }
    if (axis.friction_limit > 0) {
      const double trial = friction + axis.friction_stiffness * dq;
      friction = std::clamp(trial, -axis.friction_limit, axis.friction_limit);
      report.friction_dissipated += friction * (trial - friction) / axis.friction_stiffness;
      report.stored += 0.5 * friction * friction / axis.friction_stiffness;
      load += friction;
    }
    return load;
  }

  /// `load` in world axes acts on A as it stands and on B the other way round.
  void apply(const Frames& f, const Vec3& load, ContactLoads& loads, ContactReport& report) const {
    Wrench &on_a = loads.on_body[static_cast<std::size_t>(spec_.body_a)],
           &on_b = loads.on_body[static_cast<std::size_t>(spec_.body_b)];
    if (!spec_.is_translational) {
      on_a.tau += load;
      on_b.tau -= load;
      return;
    }
    on_a.f += load;
    on_a.tau += (f.a - f.body_a->X_WB.p).cross(load);
    on_b.f -= load;
    on_b.tau -= (f.a - f.body_b->X_WB.p).cross(load);
    report.force = load;
  }

  JointStiffnessSpec spec_;
  double stable_step_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::unique_ptr<ContactInterface> make_joint_stiffness(JointStiffnessSpec spec, const JointBody& a,
                                                       const JointBody& b, double step) {
  return std::make_unique<JointStiffness>(std::move(spec), a, b, step);
}

}  // namespace crosswalk::fe
