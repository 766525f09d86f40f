// Rigid bodies: parts of *MAT_RIGID (merged ones together, with their extra nodes), nodal rigid
// bodies, and followers of the multibody side.
#include <algorithm>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "fe_node/element/hex8.h"
#include "fe_node/element/tet4.h"
#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

/// Codes 0..7 of TC and RC: none, x, y, z, xy, yz, zx, xyz; others are none.
void lock(std::array<bool, 6>& locked, int first, double code) {
  constexpr std::array<std::array<bool, 3>, 8> kAxes{{{false, false, false},
                                                      {true, false, false},
                                                      {false, true, false},
                                                      {false, false, true},
                                                      {true, true, false},
                                                      {false, true, true},
                                                      {true, false, true},
                                                      {true, true, true}}};
  if (!(code >= 1 && code < 8)) return;
  for (int axis = 0; axis < 3; ++axis)
    if (kAxes[static_cast<std::size_t>(code)][axis]) locked[first + axis] = true;
}

double shell_thickness(const BuildContext& c, const Part& part) {
  const Section* section = c.section_of(part);
  if (section == nullptr) return 0;
  const auto* shell = std::get_if<SectionShell>(&section->law);
  return shell == nullptr ? 0 : c.units.length * shell->thickness[0];
}

/// Mass of a rigid part's elements, lumped on their corners.
Inertia lumped_inertia(const BuildContext& c, int index) {
  const Part& part = c.deck.parts[index];
  const Mesh& mesh = c.built.model.mesh;
  const double density = c.material_of(part)->density * c.units.density();
  const double thickness = shell_thickness(c, part);
  Inertia sum;
  for (ElementKind kind :
       {ElementKind::Hex8, ElementKind::Tet4, ElementKind::Quad4, ElementKind::Tri3}) {
    const ElementTable& table = mesh.table(kind);
    for (int e = 0; e < table.size(); ++e) {
      if (table.part[e] != index) continue;
      const std::span<const int> corners = mesh.corners(kind, e);
      double mass = 0;
      if (kind == ElementKind::Hex8) {
        Vec3 x[8];
        for (int k = 0; k < 8; ++k) x[k] = mesh.position[corners[k]];
        mass = density * hex8_volume(x);
      } else if (kind == ElementKind::Tet4) {
        const std::vector<Vec3>& x = mesh.position;
        mass = density * tet4_volume(x[corners[0]], x[corners[1]], x[corners[2]], x[corners[3]]);
      } else {
        const Vec3 a = mesh.position[corners[2]] - mesh.position[corners[0]];
        const Vec3 b = mesh.position[corners.back()] - mesh.position[corners[1]];
        mass = 0.5 * density * thickness * a.cross(b).norm();
      }
      for (int n : corners)
        sum = sum + Inertia::of_point(mass / static_cast<double>(corners.size()), mesh.position[n]);
    }
  }
  return sum;
}

Inertia given_inertia(BuildContext& c, const PartInertia& given, Source source, DeckId part) {
  Inertia inertia;
  inertia.mass = given.mass * c.units.mass;
  inertia.com = given.center * c.units.length;
  if (given.center_node.given())
    if (const int n = c.node(given.center_node, source, "*PART_INERTIA"); n >= 0)
      inertia.com = c.mesh().position[n];
  Mat3 tensor;
  tensor << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz,
      given.izz;
  inertia.about_com = tensor * c.units.inertia();
  constexpr double kRounded = 1e-6;  // of the trace; a slender body may have none about its axis
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvalues();
  if (!(principal[0] >= -kRounded * tensor.trace()) || !(tensor.trace() > 0))
    c.problem(source, fmt::format("*PART_INERTIA {}", part.value),
              "principal moments of inertia above zero",
              fmt::format("{:.3g}, {:.3g} and {:.3g}", principal[0], principal[1], principal[2]));
  if (given.axes_kind == 1) {
    if (given.axes.given() || given.x_axis.norm() == 0) {
      c.problem(source, fmt::format("*PART_INERTIA {}", part.value), "local axes by two vectors",
                "a coordinate system", "write XL..ZLIP instead of CID2");
      return inertia;
    }
    Mat3 R;
    R.col(0) = given.x_axis.normalized();
    R.col(2) = given.x_axis.cross(given.in_plane).normalized();
    R.col(1) = R.col(2).cross(R.col(0));
    inertia.about_com = R * inertia.about_com * R.transpose();
  }
  return inertia;
}

class BodyStage {
 public:
  explicit BodyStage(BuildContext& context) : c_(context) {}

  void run() {
    group_parts();
    for (std::size_t p = 0; p < c_.deck.parts.size(); ++p) add_part(static_cast<int>(p));
    for (const ExtraNodes& extra : c_.deck.extra_nodes) add_extra_nodes(extra);
    for (const NodalRigidBody& body : c_.deck.nodal_rigid_bodies) add_nodal_body(body);
    for (const NodeTie& tie : c_.deck.node_ties) add_weld(tie);
    claim_nodes();
    for (const std::string& name : c_.options.followers) {
      RigidBody body;
      body.name = name;
      body.role = BodyRole::Follower;
      c_.model().bodies.push_back(body);
    }
  }

 private:
  int leader(int part) const {
    while (leader_[part] != part) part = leader_[part];
    return part;
  }

  void group_parts() {
    leader_.resize(c_.deck.parts.size());
    std::iota(leader_.begin(), leader_.end(), 0);
    for (const MergedRigidBodies& merged : c_.deck.merged_rigid_bodies) {
      const auto lead = c_.part_index.find(merged.lead),
                 other = c_.part_index.find(merged.follower);
      if (lead == c_.part_index.end() || other == c_.part_index.end())
        c_.problem(merged.source, "*CONSTRAINED_RIGID_BODIES", "two rigid parts of the deck",
                   fmt::format("{} and {}", merged.lead.value, merged.follower.value));
      else
        leader_[leader(other->second)] = leader(lead->second);
    }
  }

  RigidBody& body_of(int part) { return c_.model().bodies[c_.body_of_part.at(leader(part))]; }

  void add_part(int index) {
    const Part& part = c_.deck.parts[index];
    if (!c_.mesh().parts[index].is_rigid) return;
    const int lead = leader(index);
    if (!c_.body_of_part.contains(lead)) {
      c_.body_of_part[lead] = static_cast<int>(c_.model().bodies.size());
      RigidBody body;
      body.name = c_.mesh().parts[lead].name;
      c_.model().bodies.push_back(body);
    }
    c_.body_of_part[index] = c_.body_of_part[lead];
    RigidBody& body = body_of(index);
    body.parts.push_back(index);
    const std::vector<int> nodes = c_.nodes_of_parts({index});
    body.nodes.insert(body.nodes.end(), nodes.begin(), nodes.end());
    body.own = body.own + (part.inertia ? given_inertia(c_, *part.inertia, part.source, part.id)
                                        : lumped_inertia(c_, index));
    const auto& driven = c_.options.driven_parts;
    if (std::find(driven.begin(), driven.end(), c_.mesh().parts[index].name) != driven.end())
      body.role = BodyRole::Driven;
    const mat::Rigid& law = std::get<mat::Rigid>(c_.material_of(part)->law);
    if (law.constraint_option == 1) {
      lock(body.locked, 0, law.constraint_1);
      lock(body.locked, 3, law.constraint_2);
    } else if (law.constraint_option != 0) {
      c_.problem(part.source, fmt::format("*MAT_RIGID of part {}", part.id.value),
                 "constraints in global axes (CMO 0 or 1)",
                 fmt::format("{}", law.constraint_option));
    }
  }

  void add_extra_nodes(const ExtraNodes& extra) {
    const auto part = c_.part_index.find(extra.part);
    if (part == c_.part_index.end() || !c_.mesh().parts[part->second].is_rigid) {
      c_.problem(extra.source, "*CONSTRAINED_EXTRA_NODES", "a rigid part",
                 std::to_string(extra.part.value));
      return;
    }
    std::vector<int>& nodes = body_of(part->second).nodes;
    if (extra.kind == NodeTarget::Node) {
      const int n = c_.node(extra.target, extra.source, "*CONSTRAINED_EXTRA_NODES_NODE");
      if (n >= 0) nodes.push_back(n);
    } else {
      const std::vector<int> more = c_.node_set(extra.target, extra.source);
      nodes.insert(nodes.end(), more.begin(), more.end());
    }
  }

  void add_nodal_body(const NodalRigidBody& record) {
    RigidBody body;
    body.name =
        record.title.empty() ? fmt::format("nodal rigid body {}", record.id.value) : record.title;
    body.nodes = c_.node_set(record.node_set, record.source);
    const auto& driven = c_.options.driven_parts;
    if (std::find(driven.begin(), driven.end(), body.name) != driven.end())
      body.role = BodyRole::Driven;
    if (record.has_inertia) body.own = given_inertia(c_, record.inertia, record.source, record.id);
    c_.model().bodies.push_back(body);
  }

  /// A spot weld that never fails is a small rigid body of its nodes.
  void add_weld(const NodeTie& tie) {
    if (tie.kind != NodeTie::Kind::Spotweld && tie.kind != NodeTie::Kind::GeneralizedSpot) {
      c_.problem(tie.source, "node tie", "a spot weld", "another tie of nodes",
                 "use *CONSTRAINED_SPOTWELD or *CONSTRAINED_NODAL_RIGID_BODY");
      return;
    }
    const bool can_fail = tie.normal_force > 0 || tie.shear_force > 0 ||
                          (tie.failure_strain > 0 && tie.failure_strain < kNever) ||
                          (tie.failure_time > 0 && tie.failure_time < kNever);
    if (can_fail || tie.axes.given()) {
      c_.problem(tie.source, "spot weld", "one that never fails, in global axes",
                 can_fail ? "a failure force, strain or time" : "local axes",
                 "leave the failure fields blank to weld the nodes for good");
      return;
    }
    RigidBody body;
    body.name = fmt::format("spot weld {}", c_.model().bodies.size());
    if (tie.kind == NodeTie::Kind::Spotweld) {
      for (DeckId id : tie.nodes)
        if (const int n = c_.node(id, tie.source, "*CONSTRAINED_SPOTWELD"); n >= 0)
          body.nodes.push_back(n);
    } else {
      body.nodes = c_.node_set(tie.node_set, tie.source);
    }
    if (body.nodes.size() > 1) c_.model().bodies.push_back(body);
  }

  /// A node belongs to one body; the first to claim it keeps it and the other is a problem.
  void claim_nodes() {
    std::vector<int> owner(c_.mesh().node_count(), -1);
    std::vector<RigidBody>& bodies = c_.model().bodies;
    for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
      std::sort(bodies[b].nodes.begin(), bodies[b].nodes.end());
      bodies[b].nodes.erase(std::unique(bodies[b].nodes.begin(), bodies[b].nodes.end()),
                            bodies[b].nodes.end());
      for (int n : bodies[b].nodes) {
        if (owner[n] >= 0)
          c_.problem({}, fmt::format("rigid body '{}'", bodies[b].name), "nodes of its own",
                     fmt::format("node {} also of '{}'", c_.mesh().node_id[n].value,
                                 bodies[owner[n]].name),
                     "merge the two with *CONSTRAINED_RIGID_BODIES");
        else
          owner[n] = b;
      }
    }
  }

  BuildContext& c_;
  std::vector<int> leader_;
};

}  // namespace

void build_bodies(BuildContext& context) { BodyStage(context).run(); }

}  // namespace crosswalk::fe
