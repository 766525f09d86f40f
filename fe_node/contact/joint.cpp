#include "fe_node/contact/joint.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

class Joint final : public ContactInterface {
 public:
  Joint(JointSpec spec, const JointBody& a, const JointBody& b, std::span<const Vec3> points,
        double step)
      : ContactInterface(spec.name), spec_(std::move(spec)), a_(a), b_(b) {
    CW_ASSERT(step > 0 && !spec_.points.empty());
    double omega2 = 0;
    for (const auto& [first, second] : spec_.points) {
      const double sum =
          a.mobility(points[first] - a.centre) + b.mobility(points[second] - b.centre);
      CW_ASSERT(sum > 0);  // the model builder refuses joints between driven bodies
      const double k = spec_.stiffness_scale / (sum * step * step);
      stiffness_.push_back(k);
      damping_.push_back(2 * spec_.damping_ratio * std::sqrt(k / sum));
      omega2 += k * sum;
    }
    stable_step_ = 2 / std::sqrt(2 * omega2);
    if (spec_.axes == JointAxes::Free) return;
    const double spin = a.spin_mobility() + b.spin_mobility();
    axis_stiffness_ = spec_.stiffness_scale / (spin * step * step);
    axis_damping_ = 2 * spec_.damping_ratio * std::sqrt(axis_stiffness_ / spin);
  }

  /// Places of the points in their bodies, a and b in turn; then the axis in a and in b.
  void initialise(ContactHistory& history, const ContactContext& context) const override {
    history = {};
    const Pose in_a = body(context, spec_.body_a).X_WB.inverse(),
               in_b = body(context, spec_.body_b).X_WB.inverse();
    const auto add = [&](const Vec3& v) {
      history.values.insert(history.values.end(), {v.x(), v.y(), v.z()});
    };
    const auto at = [&](int node) {
      return context.nodes[static_cast<std::size_t>(node)].position();
    };
    for (const auto& [first, second] : spec_.points) {
      add(in_a * at(first));
      add(in_b * at(second));
    }
    if (!has_axes()) return;
    const auto direction = [&](const std::pair<int, int>& nodes) {
      return Vec3((at(nodes.second) - at(nodes.first)).normalized());
    };
    add(in_a.q * direction(spec_.axis));
    const bool has_arms = spec_.axes == JointAxes::AtRightAngles;
    add(in_b.q * direction(has_arms ? spec_.axis_b : spec_.axis));
  }

  int max_nodal_loads() const override { return 0; }

  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override {
    ContactReport report;
    const BodyMotionView &a = body(context, spec_.body_a), &b = body(context, spec_.body_b);
    const double* axes = history.values.data() + 6 * spec_.points.size();
    Vec3 axis = Vec3::Zero();
    if (has_axes()) axis = a.X_WB.q * Vec3(Eigen::Map<const Vec3>(axes));
    double omega2 = 0;
    for (std::size_t i = 0; i < spec_.points.size(); ++i) {
      const double* place = history.values.data() + 6 * i;
      const Vec3 at_a = a.X_WB * Vec3(Eigen::Map<const Vec3>(place)),
                 at_b = b.X_WB * Vec3(Eigen::Map<const Vec3>(place + 3));
      // The axis turns with a, so the force acts on a where it acts on b; without an axis half way.
      const Vec3 where = spec_.hold == JointHold::All ? Vec3(0.5 * (at_a + at_b)) : at_b;
      const Vec3 gap = held(at_b - at_a, axis);
      const Vec3 velocity =
          held(b.V_WB.shifted(where - b.X_WB.p).v - a.V_WB.shifted(where - a.X_WB.p).v, axis);
      const Vec3 force = stiffness_[i] * gap + damping_[i] * velocity;
      Wrench &on_a = on(loads, spec_.body_a), &on_b = on(loads, spec_.body_b);
      on_a.f += force;
      on_a.tau += (where - a.X_WB.p).cross(force);
      on_b.f -= force;
      on_b.tau -= (where - b.X_WB.p).cross(force);
      report.force += force;
      report.stored += 0.5 * stiffness_[i] * gap.squaredNorm();
      report.damping_dissipated += damping_[i] * velocity.squaredNorm() * context.dt;
      report.max_penetration = std::max(report.max_penetration, gap.norm());
      omega2 += stiffness_[i] * (a_.mobility(where - a.X_WB.p) + b_.mobility(where - b.X_WB.p));
    }
    report.active = static_cast<int>(spec_.points.size());
    report.stable_step = stable_step_;
    if (!has_axes()) return report;
    if (spec_.axes != JointAxes::Free) {
      const Vec3 axis_b = b.X_WB.q * Vec3(Eigen::Map<const Vec3>(axes + 3));
      if (spec_.axes == JointAxes::Parallel)
        keep_parallel(a, b, axis, axis_b, context.dt, loads, report);
      else
        keep_at_right_angles(a, b, axis, axis_b, context.dt, loads, report);
      omega2 += axis_stiffness_ * (a_.spin_mobility() + b_.spin_mobility());
    }
    report.stable_step = 2 / std::sqrt(2 * omega2);  // arms change as the bodies slide
    return report;
  }

 private:
  static const BodyMotionView& body(const ContactContext& context, int index) {
    return context.bodies[static_cast<std::size_t>(index)];
  }
  static Wrench& on(ContactLoads& loads, int index) {
    return loads.on_body[static_cast<std::size_t>(index)];
  }

  bool has_axes() const { return spec_.hold != JointHold::All || spec_.axes != JointAxes::Free; }

  Vec3 held(const Vec3& v, const Vec3& axis) const {
    switch (spec_.hold) {
      case JointHold::AcrossAxis:
        return v - axis.dot(v) * axis;
      case JointHold::AlongAxis:
        return axis.dot(v) * axis;
      case JointHold::All:
        break;
    }
    return v;
  }

  /// Couples that turn the axis of b back to that of a: the potential is k/2 times the square of
  /// the sine between them.
  void keep_parallel(const BodyMotionView& a, const BodyMotionView& b, const Vec3& axis_a,
                     const Vec3& axis_b, double dt, ContactLoads& loads,
                     ContactReport& report) const {
    const auto across = [&](const Vec3& v) { return Vec3(v - axis_a.dot(v) * axis_a); };
    const Vec3 off = across(axis_b), rate = across((b.V_WB.w - a.V_WB.w).cross(axis_b));
    const Vec3 couple = axis_b.cross(Vec3(axis_stiffness_ * off + axis_damping_ * rate));
    on(loads, spec_.body_a).tau += couple;
    on(loads, spec_.body_b).tau -= couple;
    report.stored += 0.5 * axis_stiffness_ * off.squaredNorm();
    report.damping_dissipated += axis_damping_ * rate.squaredNorm() * dt;
  }

  /// Couples about the common normal of the arms, so without a moment about either: the potential
  /// is k/2 times the square of the cosine between them.
  void keep_at_right_angles(const BodyMotionView& a, const BodyMotionView& b, const Vec3& arm_a,
                            const Vec3& arm_b, double dt, ContactLoads& loads,
                            ContactReport& report) const {
    const Vec3 normal = arm_a.cross(arm_b);
    const double off = arm_a.dot(arm_b), rate = (a.V_WB.w - b.V_WB.w).dot(normal);
    const Vec3 couple = (axis_stiffness_ * off + axis_damping_ * rate) * normal;
    on(loads, spec_.body_a).tau -= couple;
    on(loads, spec_.body_b).tau += couple;
    report.stored += 0.5 * axis_stiffness_ * off * off;
    report.damping_dissipated += axis_damping_ * rate * rate * dt;
  }

  JointSpec spec_;
  JointBody a_, b_;
  std::vector<double> stiffness_, damping_;
  double stable_step_ = 0, axis_stiffness_ = 0, axis_damping_ = 0;
};

}  // namespace

std::unique_ptr<ContactInterface> make_joint(JointSpec spec, const JointBody& a, const JointBody& b,
                                             std::span<const Vec3> points, double step) {
  return std::make_unique<Joint>(std::move(spec), a, b, points, step);
}

}  // namespace crosswalk::fe
