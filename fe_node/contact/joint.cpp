#include "fe_node/contact/joint.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

double mobility(const JointBody& body, const Vec3& point) {
  if (body.mass <= 0) return 0;
  return 1 / body.mass + (point - body.centre).squaredNorm() / body.least_inertia;
}

class Joint final : public ContactInterface {
 public:
  Joint(JointSpec spec, const JointBody& a, const JointBody& b, std::span<const Vec3> points,
        double step)
      : ContactInterface(spec.name), spec_(std::move(spec)) {
    CW_ASSERT(step > 0 && !spec_.points.empty());
    double omega2 = 0;
    for (const auto& [first, second] : spec_.points) {
      const double sum = mobility(a, points[first]) + mobility(b, points[second]);
      CW_ASSERT(sum > 0);  // the model builder refuses joints between driven bodies
      const double k = spec_.stiffness_scale / (sum * step * step);
      stiffness_.push_back(k);
      damping_.push_back(2 * spec_.damping_ratio * std::sqrt(k / sum));
      omega2 += k * sum;
    }
    stable_step_ = 2 / std::sqrt(2 * omega2);
  }

  /// Places of the points in their bodies, a and b in turn.
  void initialise(ContactHistory& history, const ContactContext& context) const override {
    history = {};
    for (const auto& [first, second] : spec_.points) {
      const Vec3 a = context.bodies[spec_.body_a].X_WB.inverse() * context.nodes[first].position();
      const Vec3 b = context.bodies[spec_.body_b].X_WB.inverse() * context.nodes[second].position();
      history.values.insert(history.values.end(), {a.x(), a.y(), a.z(), b.x(), b.y(), b.z()});
    }
  }

  int max_nodal_loads() const override { return 0; }

  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override {
    ContactReport report;
    const BodyMotionView &a = context.bodies[spec_.body_a], &b = context.bodies[spec_.body_b];
    for (std::size_t i = 0; i < spec_.points.size(); ++i) {
      const double* place = history.values.data() + 6 * i;
      const Vec3 at_a = a.X_WB * Vec3(Eigen::Map<const Vec3>(place)),
                 at_b = b.X_WB * Vec3(Eigen::Map<const Vec3>(place + 3));
      const Vec3 gap = at_b - at_a, middle = 0.5 * (at_a + at_b);
      const Vec3 velocity =
          b.V_WB.shifted(middle - b.X_WB.p).v - a.V_WB.shifted(middle - a.X_WB.p).v;
      const Vec3 force = stiffness_[i] * gap + damping_[i] * velocity;
      loads.on_body[spec_.body_a].f += force;
      loads.on_body[spec_.body_a].tau += (middle - a.X_WB.p).cross(force);
      loads.on_body[spec_.body_b].f -= force;
      loads.on_body[spec_.body_b].tau -= (middle - b.X_WB.p).cross(force);
      report.force += force;
      report.stored += 0.5 * stiffness_[i] * gap.squaredNorm();
      report.damping_dissipated += damping_[i] * velocity.squaredNorm() * context.dt;
      report.max_penetration = std::max(report.max_penetration, gap.norm());
    }
    report.active = static_cast<int>(spec_.points.size());
    report.stable_step = stable_step_;
    return report;
  }

 private:
  JointSpec spec_;
  std::vector<double> stiffness_, damping_;
  double stable_step_ = 0;
};

}  // namespace

std::unique_ptr<ContactInterface> make_joint(JointSpec spec, const JointBody& a, const JointBody& b,
                                             std::span<const Vec3> points, double step) {
  return std::make_unique<Joint>(std::move(spec), a, b, points, step);
}

}  // namespace crosswalk::fe
