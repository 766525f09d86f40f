// Rigid walls.
#include <fmt/format.h>

#include "fe_node/contact/rigid_surface.h"
#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

std::vector<int> wall_nodes(BuildContext& c, const RigidWall& wall) {
  std::vector<int> nodes;
  if (wall.node_set.given())
    nodes = c.node_set(wall.node_set, wall.source);
  else
    for (int n = 0; n < c.mesh().node_count(); ++n) nodes.push_back(n);
  if (wall.excepted_set.given()) {
    const std::vector<int> out = c.node_set(wall.excepted_set, wall.source);
    std::erase_if(nodes, [&](int n) { return std::binary_search(out.begin(), out.end(), n); });
  }
  return nodes;
}

std::optional<RigidShape> wall_shape(BuildContext& c, const RigidWall& wall) {
  const double length = c.units.length;
  const Vec3 normal = (wall.head - wall.tail).normalized();
  const bool is_plane = wall.shape == RigidWall::Shape::Plane,
             is_sphere = wall.shape == RigidWall::Shape::Sphere,
             is_cylinder = wall.shape == RigidWall::Shape::Cylinder;
  if (((is_sphere || is_cylinder) && !(wall.radius > 0)) ||
      ((is_plane || is_cylinder) && normal.isZero(0))) {
    c.problem(wall.source, "*RIGIDWALL", "a radius and a direction of its axis or normal",
              "one of length zero");
    return std::nullopt;
  }
  if (is_plane && !wall.is_finite && !wall.is_moving) return RigidPlane{length * wall.tail, normal};
  if (is_sphere && !wall.motion_curve.given())
    return RigidEllipsoid{{Quat::Identity(), length * wall.tail},
                          Vec3::Constant(length * wall.radius)};
  if (is_cylinder && !wall.motion_curve.given())
    return RigidCylinder{length * wall.tail, normal, length * wall.radius};
  c.problem(wall.source, "*RIGIDWALL", "a fixed infinite plane, sphere or cylinder", "another");
  return std::nullopt;
}

}  // namespace

void build_contacts(BuildContext& c) {
  for (const RigidWall& wall : c.deck.rigid_walls) {
    const std::optional<RigidShape> shape = wall_shape(c, wall);
    if (!shape) continue;
    RigidSurfaceSpec spec;
    spec.name = wall.title.empty() ? fmt::format("rigid wall {}", wall.id.value) : wall.title;
    spec.body = static_cast<int>(c.model().bodies.size());
    spec.nodes = wall_nodes(c, wall);
    // The reference step is the deck's own scale of time: set when the stable step is known.
    spec.patches = {{spec.name, {*shape}, PenaltyLaw{}}};
    spec.friction = wall.friction;
    RigidBody body;
    body.name = spec.name;
    body.role = BodyRole::Follower;
    c.model().bodies.push_back(body);
    c.built.walls.push_back(std::move(spec));
  }
}

}  // namespace crosswalk::fe
