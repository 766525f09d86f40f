// Fixed and prescribed nodes, initial velocities, loads, masses and damping.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "fe_node/model_builder/build_context.h"

namespace crosswalk::fe {
namespace {

class ConditionStage {
 public:
  explicit ConditionStage(BuildContext& context) : c_(context) {}

  void run() {
    body_of_node_.assign(c_.mesh().node_count(), -1);
    const std::vector<RigidBody>& bodies = c_.model().bodies;
    for (int b = 0; b < static_cast<int>(bodies.size()); ++b)
      for (int n : bodies[b].nodes) body_of_node_[n] = b;
    for (const DeckNode& node : c_.deck.nodes) fix_by_code(node);
    for (const auto& [id, n] : c_.node_index)
      if (id.value < 0) c_.model().fixed.push_back({n, {true, true, true}, {true, true, true}});
    for (const Spc& spc : c_.deck.spcs) add_spc(spc);
    merge_fixed();
    for (const PrescribedMotion& motion : c_.deck.prescribed_motions) add_motion(motion);
    find_prescribed_bodies();
    add_velocities();
    for (const LoadNode& load : c_.deck.nodal_loads) add_load(load);
    for (const LoadBody& load : c_.deck.body_loads) add_body_load(load);
    for (const MassElement& mass : c_.deck.masses) add_mass(mass);
    for (const Damping& damping : c_.deck.dampings) add_damping(damping);
    refuse_the_rest();
  }

 private:
  void fix(int node, const std::array<bool, 3>& translation, const std::array<bool, 3>& rotation) {
    if (body_of_node_[node] >= 0) return;  // a rigid body is fixed by its material card
    c_.model().fixed.push_back({node, translation, rotation});
  }

  void fix_by_code(const DeckNode& node) {
    if (node.fixed_translation == 0 && node.fixed_rotation == 0) return;
    constexpr std::array<int, 8> kMask{0, 1, 2, 4, 3, 6, 5, 7};  // bits x y z of codes 0..7
    const int t = kMask[std::clamp(node.fixed_translation, 0, 7)];
    const int r = kMask[std::clamp(node.fixed_rotation, 0, 7)];
    fix(c_.node_index.at(node.id), {(t & 1) != 0, (t & 2) != 0, (t & 4) != 0},
        {(r & 1) != 0, (r & 2) != 0, (r & 4) != 0});
  }

  std::vector<int> targets(NodeTarget kind, DeckId id, Source source, const char* who) {
    if (kind == NodeTarget::Set) return c_.node_set(id, source);
    const int n = c_.node(id, source, who);
    return n < 0 ? std::vector<int>{} : std::vector<int>{n};
  }

  void add_spc(const Spc& spc) {
    if (spc.axes.given() || spc.birth > 0 || spc.death < kNever)
      c_.problem(spc.source, "*BOUNDARY_SPC", "global axes and no birth or death time",
                 "a local system or a time");
    for (int n : targets(spc.kind, spc.target, spc.source, "*BOUNDARY_SPC"))
      fix(n, {spc.fixed[0] != 0, spc.fixed[1] != 0, spc.fixed[2] != 0},
          {spc.fixed[3] != 0, spc.fixed[4] != 0, spc.fixed[5] != 0});
  }

  /// One entry per node, so that each is held once.
  void merge_fixed() {
    std::vector<FixedNode>& fixed = c_.model().fixed;
    std::stable_sort(fixed.begin(), fixed.end(),
                     [](const FixedNode& a, const FixedNode& b) { return a.node < b.node; });
    std::vector<FixedNode> merged;
    for (const FixedNode& f : fixed) {
      if (merged.empty() || merged.back().node != f.node) merged.push_back({f.node, {}, {}});
      for (int axis = 0; axis < 3; ++axis) {
        merged.back().translation[axis] |= f.translation[axis];
        merged.back().rotation[axis] |= f.rotation[axis];
      }
    }
    fixed = std::move(merged);
  }

  std::optional<std::pair<MotionKind, double>> motion_kind(const PrescribedMotion& motion) {
    const bool rotates = motion.dof >= 5;
    const double length = rotates ? 1.0 : c_.units.length;
    switch (motion.quantity) {
      case 0:
        return std::pair(MotionKind::Velocity, length / c_.units.time);
      case 1:
        return std::pair(MotionKind::Acceleration, length / c_.units.time / c_.units.time);
      case 2:
        return std::pair(MotionKind::Displacement, length);
      default:
        break;
    }
    c_.problem(motion.source, "*BOUNDARY_PRESCRIBED_MOTION field VAD", "0, 1 or 2",
               std::to_string(motion.quantity));
    return std::nullopt;
  }

  void add_motion(const PrescribedMotion& motion) {
    const char* who = "*BOUNDARY_PRESCRIBED_MOTION";
    const auto kind = motion_kind(motion);
    if (!kind) return;
    const auto curve = c_.curve(motion.curve, c_.units.time, kind->second, motion.source, who);
    if (!curve) return;
    const bool is_rigid =
        motion.kind == MotionTarget::Rigid || motion.kind == MotionTarget::RigidLocal;
    const int last_dof = is_rigid ? 7 : 3;
    if (motion.dof < 1 || motion.dof > last_dof || motion.dof == 4 || motion.vector.given() ||
        motion.birth > 0 || motion.death < kNever || motion.kind == MotionTarget::RigidLocal) {
      c_.problem(motion.source, who, "global directions 1 2 3 (rigid parts: and 5 6 7), no times",
                 fmt::format("direction {}", motion.dof));
      return;
    }
    if (is_rigid) {
      const auto part = c_.part_index.find(motion.target);
      const auto body =
          part == c_.part_index.end() ? c_.body_of_part.end() : c_.body_of_part.find(part->second);
      if (body == c_.body_of_part.end()) {
        c_.problem(motion.source, who, "a rigid part", std::to_string(motion.target.value));
        return;
      }
      const int axis = motion.dof <= 3 ? motion.dof - 1 : motion.dof - 2;
      c_.model().guided_bodies.push_back({body->second, axis, kind->first, *curve, motion.scale});
      return;
    }
    GuidedNodes guide;
    guide.direction = Vec3::Unit(motion.dof - 1);
    guide.kind = kind->first;
    guide.curve = *curve;
    guide.scale = motion.scale;
    const NodeTarget target =
        motion.kind == MotionTarget::Node ? NodeTarget::Node : NodeTarget::Set;
    for (int n : targets(target, motion.target, motion.source, who))
      if (body_of_node_[n] < 0) guide.nodes.push_back(n);
    c_.model().guided.push_back(guide);
  }

  /// A body whose six directions all follow curves moves by them alone.
  void find_prescribed_bodies() {
    std::vector<std::set<int>> axes(c_.model().bodies.size());
    for (const GuidedBody& guide : c_.model().guided_bodies) axes[guide.body].insert(guide.axis);
    for (std::size_t b = 0; b < axes.size(); ++b)
      if (axes[b].size() == 6) c_.model().bodies[b].role = BodyRole::Prescribed;
  }

  void add_velocities() {
    const double v = c_.units.velocity();
    for (const InitialVelocity& start : c_.deck.initial_velocities) {
      std::vector<int> nodes;
      if (start.set.given())
        nodes = c_.node_set(start.set, start.source);
      else
        for (int n = 0; n < c_.mesh().node_count(); ++n) nodes.push_back(n);
      if (start.excepted_set.given()) {
        const std::vector<int> out = c_.node_set(start.excepted_set, start.source);
        std::erase_if(nodes, [&](int n) { return std::binary_search(out.begin(), out.end(), n); });
        c_.model().start_velocities.push_back({out, v * start.excepted_velocity});
      }
      c_.model().start_velocities.push_back({nodes, v * start.velocity});
    }
    for (const InitialVelocityOf& start : c_.deck.nodal_velocities)
      if (const int n = c_.node(start.target, start.source, "*INITIAL_VELOCITY_NODE"); n >= 0)
        c_.model().start_velocities.push_back({{n}, v * start.velocity});
    for (const InitialVelocityOf& start : c_.deck.rigid_velocities) {
      const auto part = c_.part_index.find(start.target);
      if (part != c_.part_index.end())
        add_spin(c_.nodes_of_parts({part->second}), v * start.velocity,
                 start.angular / c_.units.time, centre_of(part->second));
    }
    for (const InitialVelocityGeneration& start : c_.deck.generated_velocities) {
      const Vec3 axis = start.axis.norm() > 0 ? Vec3(start.axis.normalized()) : Vec3::Zero();
      add_spin(generated_nodes(start), v * start.velocity, start.omega / c_.units.time * axis,
               c_.units.length * start.center);
    }
  }

  Vec3 centre_of(int part) const {
    Vec3 sum = Vec3::Zero();
    const std::vector<int> nodes = c_.nodes_of_parts({part});
    for (int n : nodes) sum += c_.mesh().position[n];
    return nodes.empty() ? sum : Vec3(sum / static_cast<double>(nodes.size()));
  }

  std::vector<int> generated_nodes(const InitialVelocityGeneration& start) {
    std::vector<int> all;
    if (!start.target.given()) {
      for (int n = 0; n < c_.mesh().node_count(); ++n) all.push_back(n);
      return all;
    }
    if (start.target_kind == 3) return c_.node_set(start.target, start.source);
    if (start.target_kind == 2) {
      const auto part = c_.part_index.find(start.target);
      return part == c_.part_index.end() ? all : c_.nodes_of_parts({part->second});
    }
    return c_.nodes_of_parts(c_.part_set(start.target, start.source));
  }

  void add_spin(const std::vector<int>& nodes, const Vec3& v, const Vec3& omega,
                const Vec3& centre) {
    if (omega.norm() == 0) {
      c_.model().start_velocities.push_back({nodes, v});
      return;
    }
    for (int n : nodes)
      c_.model().start_velocities.push_back({{n}, v + omega.cross(c_.mesh().position[n] - centre)});
  }

  void add_load(const LoadNode& load) {
    if (load.dof < 1 || load.dof > 3 || load.axes.given()) {
      c_.problem(load.source, "*LOAD_NODE", "a force along 1, 2 or 3 in global axes",
                 fmt::format("direction {}", load.dof));
      return;
    }
    const auto curve =
        c_.curve(load.curve, c_.units.time, c_.units.force(), load.source, "*LOAD_NODE");
    if (!curve) return;
    c_.model().nodal_forces.push_back({targets(load.kind, load.target, load.source, "*LOAD_NODE"),
                                       Vec3::Unit(load.dof - 1), *curve, load.scale});
  }

  void add_body_load(const LoadBody& load) {
    const auto curve =
        c_.curve(load.curve, c_.units.time, c_.units.acceleration(), load.source, "*LOAD_BODY");
    if (!curve) return;
    if (load.axis > 2)
      c_.problem(load.source, "*LOAD_BODY", "X, Y or Z", "a rotation");
    else  // a base acceleration: the masses feel the opposite one
      c_.model().base_accelerations.push_back({-Vec3::Unit(load.axis), *curve, load.scale});
  }

  void add_mass(const MassElement& mass) {
    std::vector<double>& point_mass = c_.model().point_mass;
    point_mass.resize(c_.mesh().node_count(), 0.0);
    const double kg = mass.mass * c_.units.mass;
    if (mass.kind == MassTarget::Node) {
      if (const int n = c_.node(mass.target, mass.source, "*ELEMENT_MASS"); n >= 0)
        point_mass[n] += kg;
    } else if (mass.kind == MassTarget::NodeSet) {
      const std::vector<int> nodes = c_.node_set(mass.target, mass.source);
      for (int n : nodes) point_mass[n] += kg / static_cast<double>(nodes.size());
    } else {
      c_.problem(mass.source, "*ELEMENT_MASS", "a mass on a node or node set", "one on parts");
    }
  }

  void add_damping(const Damping& damping) {
    if (damping.kind == Damping::Kind::Global && !damping.curve.given()) {
      c_.model().settings.mass_damping = damping.value / c_.units.time;
      return;
    }
    c_.problem(damping.source, "*DAMPING", "a constant *DAMPING_GLOBAL", "another form");
  }

  template <class Record>
  void refuse(const std::vector<Record>& records, const char* keyword, const char* instead) {
    if (!records.empty())
      c_.problem(records.front().source, keyword, instead,
                 fmt::format("{} of them", records.size()));
  }

  void refuse_the_rest() {
    const Deck& d = c_.deck;
    refuse(d.rigid_loads, "*LOAD_RIGID_BODY", "loads on nodes");
    refuse(d.interpolations, "*CONSTRAINED_INTERPOLATION", "ties without interpolation");
    refuse(d.inertias, "*ELEMENT_INERTIA", "*ELEMENT_MASS or *PART_INERTIA");
    refuse(d.erosions, "*MAT_ADD_EROSION", "failure within the material law");
    refuse(d.body_load_parts, "*LOAD_BODY_PARTS", "body loads on everything");
  }

  BuildContext& c_;
  std::vector<int> body_of_node_;
};

}  // namespace

void build_conditions(BuildContext& context) { ConditionStage(context).run(); }

}  // namespace crosswalk::fe
