// *CONSTRAINED_JOINT_STIFFNESS cards to springs, dampers, friction and stops between rigid bodies.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

/// A triad of the deck: columns x y z, and its origin, m.
struct Triad {
  Mat3 axes = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
};

/// Of two vectors: the first lies on axis `k`, the second in the plane of that and the next.
std::optional<Mat3> axes_of(const Vec3& on_axis, const Vec3& in_plane, int k) {
  const Vec3 normal = on_axis.cross(in_plane);
  if (!(normal.norm() > 1e-9 * on_axis.norm() * in_plane.norm())) return std::nullopt;
  Mat3 axes;
  axes.col(k) = on_axis.normalized();
  axes.col((k + 2) % 3) = normal.normalized();
  axes.col((k + 1) % 3) = axes.col((k + 2) % 3).cross(axes.col(k));
  return axes;
}

/// The curve of a joint goes on with its last slope; one that starts at zero holds both ways.
Curve both_ways(const Curve& curve) {
  if (curve.x().front() != 0 || curve.y().front() != 0 || curve.x().size() < 2) return curve;
  std::vector<double> x, y;
  for (std::size_t i = curve.x().size(); i-- > 1;) {
    x.push_back(-curve.x()[i]);
    y.push_back(-curve.y()[i]);
  }
  x.insert(x.end(), curve.x().begin(), curve.x().end());
  y.insert(y.end(), curve.y().begin(), curve.y().end());
  return {std::move(x), std::move(y), curve.outside()};
}

class JointStiffnessStage {
 public:
  JointStiffnessStage(BuildContext& context, const JointStiffness& card)
      : c_(context),
        card_(card),
        who_(fmt::format("*CONSTRAINED_JOINT_STIFFNESS {}", card.id.value)) {}

  void run() {
    JointStiffnessSpec spec;
    spec.name =
        card_.title.empty() ? fmt::format("joint stiffness {}", card_.id.value) : card_.title;
    spec.body_a = body(card_.parts[0]);
    spec.body_b = body(card_.parts[1]);
    const auto a = triad(card_.axes[0]);
    const auto b = card_.axes[1].given() ? triad(card_.axes[1]) : a;
    if (spec.body_a < 0 || spec.body_b < 0 || !a || !b) return;
    const std::vector<RigidBody>& bodies = c_.model().bodies;
    const bool a_is_free = bodies[spec.body_a].role == BodyRole::Free;
    if (spec.body_a == spec.body_b || (!a_is_free && bodies[spec.body_b].role != BodyRole::Free))
      return problem(
          "two bodies of which one moves freely",
          fmt::format("'{}' and '{}'", bodies[spec.body_a].name, bodies[spec.body_b].name));
    spec.reference_body = a_is_free ? spec.body_a : spec.body_b;
    spec.is_translational = card_.is_translational;
    spec.axes_a = a->axes, spec.origin_a = a->origin;
    spec.axes_b = b->axes, spec.origin_b = b->origin;
    for (std::size_t i = 0; i < 3; ++i)
      if (!axis(i, spec.axes[i])) return;
    c_.built.joint_stiffnesses.push_back(std::move(spec));
  }

 private:
  void problem(std::string expected, std::string found, std::string hint = {}) {
    c_.problem(card_.source, who_, std::move(expected), std::move(found), std::move(hint));
  }

  /// Index of the body of a rigid part or nodal rigid body.
  int body(DeckId id) {
    if (const auto part = c_.part_index.find(id); part != c_.part_index.end())
      if (const auto found = c_.body_of_part.find(part->second); found != c_.body_of_part.end())
        return found->second;
    for (const NodalRigidBody& record : c_.deck.nodal_rigid_bodies)
      if (record.id == id)
        for (int n : c_.node_set(record.node_set, record.source))
          for (std::size_t b = 0; b < c_.model().bodies.size(); ++b)
            if (const auto& nodes = c_.model().bodies[b].nodes;
                std::binary_search(nodes.begin(), nodes.end(), n))
              return static_cast<int>(b);
    problem("two rigid parts", fmt::format("part {}", id.value));
    return -1;
  }

  std::optional<Triad> triad(DeckId id) {
    if (!id.given()) {
      problem("a coordinate system CIDA", "none");
      return std::nullopt;
    }
    for (const CoordinateNodes& axes : c_.deck.coordinate_nodes)
      if (axes.id == id) return of_nodes(axes);
    for (const CoordinateSystem& axes : c_.deck.coordinate_systems)
      if (axes.id == id) return of_points(axes);
    problem("a coordinate system of the deck", std::to_string(id.value));
    return std::nullopt;
  }

  std::optional<Triad> of_nodes(const CoordinateNodes& axes) {
    std::array<Vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
      const int n = c_.node(axes.nodes[i], axes.source, who_);
      if (n < 0) return std::nullopt;
      x[i] = c_.mesh().position[n];
    }
    const int k = axes.axis == "Y" ? 1 : axes.axis == "Z" ? 2 : 0;
    return checked(axes_of(x[1] - x[0], x[2] - x[0], k), x[0], axes.id);
  }

  std::optional<Triad> of_points(const CoordinateSystem& axes) {
    if (axes.axes.given()) {
      problem("a coordinate system in global axes", fmt::format("one within {}", axes.axes.value));
      return std::nullopt;
    }
    const double L = axes.is_vector_form ? 1 : c_.units.length;
    const Vec3 origin = L * axes.origin;
    return checked(axes_of(L * axes.x_point - origin, L * axes.xy_point - origin, 0), origin,
                   axes.id);
  }

  std::optional<Triad> checked(const std::optional<Mat3>& axes, const Vec3& origin, DeckId id) {
    if (axes) return Triad{*axes, origin};
    problem("a coordinate system of three points that span a plane", std::to_string(id.value));
    return std::nullopt;
  }

  bool axis(std::size_t i, JointStiffnessAxis& out) {
    const UnitFactors& u = c_.units;
    const bool slides = card_.is_translational;
    const double way = slides ? u.length : 1.0, load = slides ? u.force() : u.force() * u.length;
    const auto read = [&](DeckId id, double x_unit, Curve& curve) {
      if (!id.given()) return true;
      const auto found = c_.curve(id, x_unit, load, card_.source, who_, Curve::Outside::LastSlope);
      if (found) curve = both_ways(*found);
      return found.has_value();
    };
    if (!read(card_.stiffness_curves[i], way, out.load) ||
        !read(card_.damping_curves[i], way / u.time, out.damping))
      return false;
    if (card_.friction_limit[i] < 0 || card_.friction_stiffness[i] < 0) {
      problem("friction and its stiffness as numbers", "a curve, or a number below zero");
      return false;
    }
    out.friction_stiffness = out.stop_stiffness = card_.friction_stiffness[i] * load / way;
    out.friction_limit = card_.friction_limit[i] * load;
    const double stop = slides ? u.length : std::numbers::pi / 180;
    if (card_.stop_negative[i] != 0) out.stop_low = -std::abs(card_.stop_negative[i]) * stop;
    if (card_.stop_positive[i] != 0) out.stop_high = std::abs(card_.stop_positive[i]) * stop;
    return true;
  }

  BuildContext& c_;
  const JointStiffness& card_;
  std::string who_;
};

}  // namespace

void build_joint_stiffness(BuildContext& context) {
  for (const JointStiffness& card : context.deck.joint_stiffnesses)
    JointStiffnessStage(context, card).run();
}

}  // namespace crosswalk::fe
