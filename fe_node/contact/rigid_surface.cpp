#include "fe_node/contact/rigid_surface.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {
namespace {

constexpr int kStepsBetweenSearches = 32;
constexpr double kSlowest = -3, kFastest = 6;  ///< m/s, range of the rate factor

/// History values of a patch: deepest penetration so far and the loading force there.
enum Slot { kDepthMax, kForceMax, kSlots };

struct Touching {
  int node = 0;
  double depth = 0;
  Vec3 normal = Vec3::Zero();    ///< W, from the body to the node
  Vec3 velocity = Vec3::Zero();  ///< of the node relative to the body's material point, W
};

class RigidSurfaceContact final : public ContactInterface {
 public:
  explicit RigidSurfaceContact(RigidSurfaceSpec spec)
      : ContactInterface(spec.name), spec_(std::move(spec)) {}

  int max_nodal_loads() const override {
    return static_cast<int>(spec_.nodes.size() * spec_.patches.size());
  }

  /// indices: for each patch the number of candidates, then the candidates of all patches in order.
  void initialise(ContactHistory& history, const ContactContext& context) const override {
    // After the patches' slots, one flag per patch and node: inside at the start.
    const std::size_t patches = spec_.patches.size(), nodes = spec_.nodes.size();
    history.values.assign((kSlots + nodes) * patches, 0.0);
    const Pose X_BW = context.bodies[spec_.body].X_WB.inverse();
    for (std::size_t k = 0; k < patches; ++k)
      for (std::size_t i = 0; i < nodes; ++i)
        if (deepest(spec_.patches[k], X_BW * context.nodes[spec_.nodes[i]].position()).depth > 0)
          history.values[kSlots * patches + k * nodes + i] = 1;
    history.indices.reserve(spec_.patches.size() * (spec_.nodes.size() + 1));
    search(context, history);
  }

  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override {
    if (context.step % kStepsBetweenSearches == 0) search(context, history);
    ContactReport report;
    const int patch_count = static_cast<int>(spec_.patches.size());
    int next = patch_count;
    for (int k = 0; k < patch_count; ++k) {
      const int count = history.indices[k];
      if (count > 0)
        patch_forces(spec_.patches[k], context,
                     {history.indices.data() + next, history.indices.data() + next + count},
                     history.values.data() + kSlots * k, loads, report);
      next += count;
    }
    return report;
  }

 private:
  static Penetration deepest(const RigidPatch& patch, const Vec3& p) {
    // Of several facets of one body, the shallowest penetration is the side the point came through.
    Penetration best{-std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
    bool is_inside = false;
    for (const RigidShape& shape : patch.shapes) {
      const Penetration here = penetration(shape, p);
      const bool inside = here.depth > 0;
      const bool better = inside == is_inside
                              ? (inside ? here.depth < best.depth : here.depth > best.depth)
                              : inside;
      if (better) {
        best = here;
        is_inside = inside;
      }
    }
    return best;
  }

  void search(const ContactContext& context, ContactHistory& history) const {
    const Pose X_BW = context.bodies[spec_.body].X_WB.inverse();
    const double margin = spec_.fastest * kStepsBetweenSearches * std::max(context.dt, 1e-6) + 1e-3;
    history.indices.assign(spec_.patches.size(), 0);
    const std::size_t patches = spec_.patches.size(), nodes = spec_.nodes.size();
    for (std::size_t k = 0; k < patches; ++k)
      for (std::size_t i = 0; i < nodes; ++i) {
        if (history.values[kSlots * patches + k * nodes + i] > 0) continue;
        const int n = spec_.nodes[i];
        const Vec3 p = X_BW * context.nodes[n].position();
        if (is_near(spec_.patches[k], p, margin)) {
          history.indices.push_back(n);
          ++history.indices[k];
        }
      }
  }

  static bool is_near(const RigidPatch& patch, const Vec3& p, double margin) {
    for (const RigidShape& shape : patch.shapes) {
      if (const auto* facet = std::get_if<RigidFacet>(&shape)) {
        RigidFacet wide = *facet;
        wide.corner -= margin * (wide.along + wide.across);
        wide.length += 2 * margin;
        wide.width += 2 * margin;
        wide.thickness += margin;
        if (penetration(wide, p).depth > -margin) return true;
      } else if (penetration(shape, p).depth > -margin) {
        return true;
      }
    }
    return false;
  }

  Touching touch(const RigidPatch& patch, const ContactContext& context, int n) const {
    const BodyMotionView& body = context.bodies[spec_.body];
    const Vec3 x = context.nodes[n].position();
    const Penetration found = deepest(patch, body.X_WB.q.conjugate() * (x - body.X_WB.p));
    return {n, found.depth, body.X_WB.q * found.normal,
            context.nodes[n].velocity() - body.V_WB.shifted(x - body.X_WB.p).v};
  }

  void patch_forces(const RigidPatch& patch, const ContactContext& context,
                    std::span<const int> candidates, double* history, ContactLoads& loads,
                    ContactReport& report) const {
    if (const auto* penalty = std::get_if<PenaltyLaw>(&patch.law)) {
      for (int n : candidates) {
        const Touching t = touch(patch, context, n);
        if (t.depth > 0) push_by_penalty(*penalty, t, context, loads, report);
      }
      return;
    }
    const CharacteristicLaw& law = std::get<CharacteristicLaw>(patch.law);
    double sum = 0;
    Touching deepest_node;
    for (int n : candidates) {
      const Touching t = touch(patch, context, n);
      if (t.depth <= 0) continue;
      sum += t.depth;
      if (t.depth > deepest_node.depth) deepest_node = t;
    }
    if (sum <= 0) return;
    const double force = characteristic_force(law, deepest_node, history);
    for (int n : candidates) {
      const Touching t = touch(patch, context, n);
      if (t.depth <= 0) continue;
      const double share = force * t.depth / sum;
      // Absorbed and given back: the loop area of the characteristic.
      report.damping_dissipated -= share * t.normal.dot(t.velocity) * context.dt;
      apply(t, share, context, loads, report);
    }
    const double slope = law.loading.slope(std::min(deepest_node.depth, history[kDepthMax]));
    bound_step(std::abs(slope), context.nodal_mass[deepest_node.node], report);
  }

  static double characteristic_force(const CharacteristicLaw& law, const Touching& deepest_node,
                                     double* history) {
    double force = 0;
    if (deepest_node.depth >= history[kDepthMax]) {
      force = law.loading.value(deepest_node.depth);
      history[kDepthMax] = deepest_node.depth;
      history[kForceMax] = force;
    } else {
      const double permanent = law.permanent_fraction * history[kDepthMax];
      const double share = (deepest_node.depth - permanent) / (history[kDepthMax] - permanent);
      if (share > 0) force = history[kForceMax] * std::pow(share, law.unloading_exponent);
    }
    const double approach = -deepest_node.normal.dot(deepest_node.velocity);
    return force * (1 + law.rate * std::clamp(approach, kSlowest, kFastest));
  }

  void push_by_penalty(const PenaltyLaw& law, const Touching& t, const ContactContext& context,
                       ContactLoads& loads, ContactReport& report) const {
    const double mass = context.nodal_mass[t.node];
    const double k = law.scale * mass / (law.reference_step * law.reference_step);
    const double c = 2 * law.damping_ratio * std::sqrt(k * mass);
    const double approach = -t.normal.dot(t.velocity);
    const double force = std::max(k * t.depth + c * approach, 0.0);
    report.stored += 0.5 * k * t.depth * t.depth;
    report.damping_dissipated += (force - k * t.depth) * approach * context.dt;
    bound_step(k, mass, report);
    apply(t, force, context, loads, report);
  }

  static void bound_step(double stiffness, double mass, ContactReport& report) {
    if (stiffness > 0 && mass > 0)
      report.stable_step = std::min(report.stable_step, 2 * std::sqrt(mass / stiffness));
  }

  void apply(const Touching& t, double normal_force, const ContactContext& context,
             ContactLoads& loads, ContactReport& report) const {
    Vec3 force = normal_force * t.normal;
    const Vec3 sliding = t.velocity - t.normal.dot(t.velocity) * t.normal;
    const double speed = sliding.norm();
    if (spec_.friction > 0 && speed > 0 && context.dt > 0) {
      const double cap = 0.5 * context.nodal_mass[t.node] * speed / context.dt;
      const double drag = std::min(spec_.friction * normal_force, cap);
      force -= drag / speed * sliding;
      report.friction_dissipated += drag * speed * context.dt;
    }
    loads.nodal.push_back({t.node, force});
    Wrench& reaction = loads.on_body[spec_.body];
    reaction.f -= force;
    reaction.tau -=
        (context.nodes[t.node].position() - context.bodies[spec_.body].X_WB.p).cross(force);
    report.force += force;
    report.max_penetration = std::max(report.max_penetration, t.depth);
    ++report.active;
  }

  RigidSurfaceSpec spec_;
};

}  // namespace

std::unique_ptr<ContactInterface> make_rigid_surface_contact(RigidSurfaceSpec spec) {
  return std::make_unique<RigidSurfaceContact>(std::move(spec));
}

}  // namespace crosswalk::fe
