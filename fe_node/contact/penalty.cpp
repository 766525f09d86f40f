#include "fe_node/contact/penalty.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "fe_node/contact/candidates.h"
#include "fe_node/contact/pair.h"

namespace crosswalk::fe {
namespace {

/// What a node keeps between steps, as doubles.
enum NodeSlot {
  kDirection = 0,
  kFriction = 3,
  kAllowance = 6,
  kStiffness,
  kTouches,
  kLastFacet,
  kLastDistance,
  kNodeSlots  ///< behind them those of BreakingTies, where there are ties
};
/// What a near node leaves for the serial sum of a step.
enum ResultSlot {
  kFacet = 0,  ///< -1: no contact
  kOnNode = 1,
  kOnCorner = 4,
  kStored = 16,
  kFrictionLoss,
  kDampingLoss,
  kPenetration,
  kOmega2,
  kResultSlots
};
/// Facets nearer to each other than this, of distance and reach, are equally near; the slack, of
/// the farthest reach, leaves no doubt.
constexpr double kTie = 1e-9, kTieSlack = 1e-6;

struct Touch {
  const ContactFacet* facet = nullptr;
  int index = -1;
  FacetCorners corners;
  Projection projection;
  Vec3 u = Vec3::Zero();
  double distance = 0;     ///< signed along u
  double penetration = 0;  ///< of the thicknesses, before allowance
  double steepness = 0;
};

class PenaltyContact final : public ContactInterface {
 public:
  /// `ties`: of the nodes of the first pass.
  PenaltyContact(std::string name, std::vector<ContactPass> passes, const PenaltySettings& settings,
                 std::optional<BreakingTies> ties = std::nullopt);
  void initialise(ContactHistory& history, const ContactContext& context) const override;
  int max_nodal_loads() const override { return 5 * candidates_.node_entries(); }
  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override;

 private:
  int slots() const { return kNodeSlots + (ties_ ? static_cast<int>(BreakingTies::kSlots) : 0); }
  bool hold(const NearNode& near, const ContactContext& context, double* memory,
            double* result) const;
  /// `tied`: what BreakingTies keeps, of the first node.
  void solve_near(int pass, const NearNode& near, const ContactContext& context, double travel,
                  const double* tied, double* due_candidates, double* memory, double* result) const;
  Touch nearest(int pass, const NearNode& near, const ContactContext& context, const double* memory,
                double travel, double* due_candidates) const;
  PairLaw law_of(const ContactNode& node, const ContactFacet& facet, const ContactContext& context,
                 double& mass) const;
  void add(int pass, int node, const double* result, ContactReport& report,
           ContactLoads& loads) const;

  std::optional<BreakingTies> ties_;
  ContactCandidates candidates_;
  PenaltySettings settings_;
};

/// Has a node that touched `last` at `last_distance` gone through the sheet it is now `distance`
/// beyond? A passage is gradual and stays on neighbouring facets; a node between two sheets that
/// comes nearer to the other one has not passed anything.
bool has_passed(const ContactFacet& facet, const ContactFacet& last, double distance,
                double last_distance, double reach) {
  const bool are_neighbours = std::any_of(facet.node.begin(), facet.node.end(), [&](int n) {
    return std::find(last.node.begin(), last.node.end(), n) != last.node.end();
  });
  constexpr double kJump = 0.25;  // of the reach, in one step
  return are_neighbours && std::abs(distance + last_distance) < kJump * reach;
}

std::vector<ContactPass> scaled(std::vector<ContactPass> passes, double thickness_scale) {
  for (ContactPass& pass : passes) pass.thickness_scale = thickness_scale;
  return passes;
}

PenaltyContact::PenaltyContact(std::string name, std::vector<ContactPass> passes,
                               const PenaltySettings& settings, std::optional<BreakingTies> ties)
    : ContactInterface(std::move(name)),
      ties_(std::move(ties)),
      candidates_(scaled(std::move(passes), settings.thickness_scale), slots(), kResultSlots),
      settings_(settings) {
  CW_ASSERT(settings_.nominal_step > 0);
}

void PenaltyContact::initialise(ContactHistory& history, const ContactContext& context) const {
  candidates_.initialise(history, context, settings_.search_margin);
  if (ties_) {
    const ContactCandidates::View view = candidates_.view(history, 0);
    ties_->tie(candidates_.passes()[0], view.list, context.nodes, view.memory + kNodeSlots,
               slots());
  }
  if (settings_.initial != InitialPenetration::Accepted) return;
  for (int p = 0; p < static_cast<int>(candidates_.passes().size()); ++p) {
    const ContactCandidates::View view = candidates_.view(history, p);
    for (int i = 0; i < view.list.count(); ++i) {
      const NearNode near = view.list[i];
      double* memory = view.memory + slots() * near.node;
      const Touch touch =
          nearest(p, near, context, memory, 0, view.due_candidates + view.list.first_candidate(i));
      if (touch.facet && touch.penetration > 0) memory[kAllowance] = touch.penetration;
    }
  }
}

/// The nearest of the facets that are due is not farther than this.
double farthest_of_nearest(const ContactPass& pass, const NearNode& near,
                           const ContactContext& context, const Vec3& x, double travel,
                           const double* due_candidates) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < near.candidates.size(); ++i) {
    if (travel < due_candidates[i]) continue;
    const FacetCorners corners = corners_of(pass.facets[near.candidates[i]], context.nodes);
    least = std::min(least, distance_bounds(x, corners).most);
  }
  return least;
}

/// The nearest facet; of two equally near ones, that which the node faces more squarely.
Touch PenaltyContact::nearest(int pass_index, const NearNode& near, const ContactContext& context,
                              const double* memory, double travel, double* due_candidates) const {
  const ContactPass& pass = candidates_.passes()[pass_index];
  const double farthest = candidates_.reach(pass_index);
  Touch best;
  double best_distance = 1e300;
  const ContactNode& node = pass.nodes[near.node];
  const Vec3 x = context.nodes[node.node].position();
  const double most = farthest_of_nearest(pass, near, context, x, travel, due_candidates);
  const Vec3 last_u = Eigen::Map<const Vec3>(memory + kDirection);
  const bool was_touching = memory[kTouches] > 0;
  // A facet out of reach, or farther than the nearest by a gap of which each has to move half
  // before that can change, is not looked at until then.
  const auto can_wait = [&](std::size_t i, double distance) {
    const double gap = distance - std::min(best_distance, most) - kTieSlack * farthest;
    const double wait = std::max(distance - farthest, 0.5 * gap);
    if (wait > 0) due_candidates[i] = travel + wait;
    return wait > 0;
  };
  for (std::size_t i = 0; i < near.candidates.size(); ++i) {
    if (travel < due_candidates[i]) continue;
    const int f = near.candidates[i];
    const ContactFacet& facet = pass.facets[f];
    Touch t;
    t.corners = corners_of(facet, context.nodes);
    if (can_wait(i, distance_bounds(x, t.corners).least)) continue;
    t.projection = closest_point(x, t.corners, facet.is_triangle());
    if (can_wait(i, t.projection.distance)) continue;
    const double reach = settings_.thickness_scale * (node.half_thickness + facet.half_thickness);
    const double d = t.projection.distance;
    const Vec3 away = x - t.projection.point;
    const double side = away.dot(t.projection.normal);
    t.steepness = d > 0 ? std::abs(side) / d : 1;
    // round-off spoils the direction of a tiny gap
    t.u = d > 1e-10 + 1e-9 * reach ? Vec3(away / d)
                                   : Vec3(side < 0 ? -t.projection.normal : t.projection.normal);
    t.distance = d;
    const bool is_behind =
        facet.is_two_sided
            ? was_touching && t.u.dot(last_u) < 0 &&
                  has_passed(facet, pass.facets[static_cast<std::size_t>(memory[kLastFacet])], d,
                             memory[kLastDistance], reach)
            : side < 0;
    if (is_behind) {
      t.u = -t.u;
      t.distance = -d;
    }
    t.penetration = reach - t.distance;
    const double tie = kTie * (d + reach);
    if (d < best_distance - tie || (d < best_distance + tie && t.steepness > best.steepness)) {
      best = t;
      best.facet = &facet;
      best.index = f;
      best_distance = std::min(d, best_distance);
    }
  }
  // Only the nearest facet can be touched: seen from above one face of a brick, a node lies behind
  // the planes of the others.
  const bool is_lost = best.facet && -best.distance > best.facet->depth_limit;
  if (best.facet == nullptr || best.penetration <= 0 || is_lost) return {};
  return best;
}

/// Of two nodes that rigid bodies move: their shares of the bodies' masses.
double inverse_of_shares(const ContactNode& node, const ContactFacet& facet,
                         const ContactContext& context) {
  double lightest = context.nodal_mass[facet.node[0]];
  for (int n : facet.node) lightest = std::min(lightest, context.nodal_mass[n]);
  const double own = context.nodal_mass[node.node];
  return own > 0 && lightest > 0 ? 1 / own + 1 / lightest : 0;
}

PairLaw PenaltyContact::law_of(const ContactNode& node, const ContactFacet& facet,
                               const ContactContext& context, double& mass) const {
  double heaviest = 0;
  for (int n : facet.node) heaviest = std::max(heaviest, context.nodes[n].inverse_mass);
  double inverse = context.nodes[node.node].inverse_mass + heaviest;
  if (inverse == 0) inverse = inverse_of_shares(node, facet, context);
  const double node_stiffness = node.stiffness > 0 ? node.stiffness : facet.stiffness;
  PairLaw law;
  law.stiffness = settings_.stiffness_scale * std::min(node_stiffness, facet.stiffness);
  mass = context.nodal_mass[node.node];
  if (inverse > 0) {
    mass = 1 / inverse;
    const double per_step = mass / (settings_.nominal_step * settings_.nominal_step);
    law.stiffness = std::max(law.stiffness, 0.5 * settings_.soft_scale * per_step);
    law.stiffness = std::min(law.stiffness, 0.25 * per_step);
  }
  law.damping = 2 * settings_.damping_ratio * std::sqrt(law.stiffness * mass);
  law.static_friction = settings_.static_friction;
  law.dynamic_friction = settings_.dynamic_friction;
  law.friction_decay = settings_.friction_decay;
  return law;
}

/// A tied node: true, and its force unless the tie has just broken.
bool PenaltyContact::hold(const NearNode& near, const ContactContext& context, double* memory,
                          double* result) const {
  double* slots_of_tie = memory + kNodeSlots;
  if (slots_of_tie[BreakingTies::kTied] == 0) return false;
  const BreakingTies::Answer answer =
      ties_->hold(candidates_.passes()[0], near.node, context, slots_of_tie);
  result[kFrictionLoss] = answer.lost;
  if (!answer.holds) return true;
  result[kFacet] = answer.facet;
  Eigen::Map<Vec3>(result + kOnNode) = answer.forces.on_node;
  for (int i = 0; i < 4; ++i)
    Eigen::Map<Vec3>(result + kOnCorner + 3 * i) = answer.forces.on_corner[i];
  result[kStored] = answer.stored;
  result[kDampingLoss] = result[kPenetration] = 0;
  result[kOmega2] = answer.omega2;
  return true;
}

void PenaltyContact::solve_near(int pass_index, const NearNode& near, const ContactContext& context,
                                double travel, const double* tied, double* due_candidates,
                                double* memory, double* result) const {
  const ContactPass& pass = candidates_.passes()[pass_index];
  result[kFacet] = -1;
  result[kFrictionLoss] = 0;
  if (tied != nullptr && pass_index == 0 && hold(near, context, memory, result)) {
    due_candidates[0] = 0;  // again in every step
    return;
  }
  const Touch t = nearest(pass_index, near, context, memory, travel, due_candidates);
  if (tied != nullptr && pass_index == 1 && t.facet != nullptr &&
      ties_->hold_facet(t.index, tied, slots()))
    return;
  if (t.facet == nullptr) memory[kAllowance] = 0;
  const double allowance = t.facet ? std::min(memory[kAllowance], t.penetration) : 0;
  const double penetration = t.facet ? t.penetration - allowance : 0;
  Eigen::Map<Vec3> friction(memory + kFriction);
  memory[kAllowance] = allowance;
  if (penetration <= 0) {
    if (memory[kTouches] > 0) {
      // what the stick still held is lost with the contact
      if (memory[kStiffness] > 0)
        result[kFrictionLoss] = 0.5 * friction.squaredNorm() / memory[kStiffness];
      friction.setZero();
      memory[kTouches] = 0;
    }
    return;
  }
  const ContactNode& node = pass.nodes[near.node];
  double mass = 0;
  const PairLaw law = law_of(node, *t.facet, context, mass);
  const PairFrame frame =
      pair_frame(t.corners, t.facet->is_triangle(), t.projection, t.u, t.distance);
  std::array<Vec3, 4> corner_velocity;
  double inverse = context.nodes[node.node].inverse_mass;
  for (int i = 0; i < 4; ++i) {
    const NodeRecord& corner = context.nodes[t.facet->node[i]];
    corner_velocity[i] = corner.velocity();
    inverse += frame.weight[i] * frame.weight[i] * corner.inverse_mass;
  }
  const Vec3 velocity =
      relative_velocity(frame, context.nodes[node.node].velocity(), corner_velocity);
  const PairAnswer answer = touch(law, frame, penetration, velocity, friction, context.dt);
  const PairForces forces = balanced_forces(frame, answer.force);

  friction = answer.friction;
  Eigen::Map<Vec3>(memory + kDirection) = t.u;
  memory[kStiffness] = law.stiffness;
  memory[kTouches] = 1;
  memory[kLastFacet] = t.index;
  memory[kLastDistance] = t.distance;
  result[kFacet] = t.index;
  Eigen::Map<Vec3>(result + kOnNode) = forces.on_node;
  for (int i = 0; i < 4; ++i) Eigen::Map<Vec3>(result + kOnCorner + 3 * i) = forces.on_corner[i];
  result[kStored] = answer.stored;
  result[kFrictionLoss] = answer.friction_dissipated;
  result[kDampingLoss] = answer.damping_dissipated;
  result[kPenetration] = penetration;
  result[kOmega2] = law.stiffness * (inverse > 0 || mass <= 0 ? inverse : 1 / mass);
}

/// One result of a pass into the report and onto the nodes.
void PenaltyContact::add(int pass_index, int node, const double* r, ContactReport& report,
                         ContactLoads& loads) const {
  const ContactPass& pass = candidates_.passes()[pass_index];
  const Vec3 force = Eigen::Map<const Vec3>(r + kOnNode);
  loads.nodal.push_back({pass.nodes[node].node, force});
  const ContactFacet& facet = pass.facets[static_cast<std::size_t>(r[kFacet])];
  const int corners = facet.is_triangle() ? 3 : 4;
  for (int c = 0; c < corners; ++c)
    loads.nodal.push_back({facet.node[c], Eigen::Map<const Vec3>(r + kOnCorner + 3 * c)});
  report.force += pass_index == 0 ? force : Vec3(-force);
  report.stored += r[kStored];
  report.damping_dissipated += r[kDampingLoss];
  report.max_penetration = std::max(report.max_penetration, r[kPenetration]);
  ++report.active;
}

ContactReport PenaltyContact::forces(const ContactContext& context, ContactHistory& history,
                                     ContactLoads& loads) const {
  ContactReport report;
  candidates_.update(history, context);
  if (context.time < settings_.birth || context.time > settings_.death) return report;
  const double travel = ContactCandidates::travel(history);
  const double* tied = ties_ ? candidates_.view(history, 0).memory + kNodeSlots : nullptr;
  double omega2 = 0;
  for (int p = 0; p < static_cast<int>(candidates_.passes().size()); ++p) {
    const ContactCandidates::View view = candidates_.view(history, p);
    int count = 0;
    for (int i = 0; i < view.list.count(); ++i)
      if (!(travel < view.due_nodes[i])) view.due_list[count++] = i;
#pragma omp parallel for schedule(static) num_threads(context.threads) if (count > 256)
    for (int k = 0; k < count; ++k) {
      const int i = view.due_list[k];
      const NearNode near = view.list[i];
      double* due = view.due_candidates + view.list.first_candidate(i);
      solve_near(p, near, context, travel, tied, due, view.memory + slots() * near.node,
                 view.results + kResultSlots * k);
      view.due_nodes[i] = *std::min_element(due, due + near.candidates.size());
    }
    for (int k = 0; k < count; ++k) {
      const double* r = view.results + kResultSlots * k;
      report.friction_dissipated += r[kFrictionLoss];
      if (r[kFacet] < 0) continue;
      add(p, view.list[view.due_list[k]].node, r, report, loads);
      omega2 = std::max(omega2, r[kOmega2]);
    }
  }
  // two opposed contacts on a node: twice the square of one frequency
  if (omega2 > 0) report.stable_step = 2 / std::sqrt(2 * omega2);
  return report;
}

ContactPass make_pass(const ContactSurface& nodes, const ContactSurface& facets) {
  ContactPass pass;
  pass.nodes = nodes.nodes;
  pass.facets = facets.facets;
  pass.neighbour_begin.assign(pass.nodes.size() + 1, 0);
  return pass;
}

std::optional<BreakingTies> ties_of(const ContactSurface& nodes, const PenaltySettings& settings) {
  if (!settings.tiebreak) return std::nullopt;
  return BreakingTies(*settings.tiebreak, settings.nominal_step, nodes.nodes, nodes.facets);
}

}  // namespace

std::unique_ptr<ContactInterface> make_node_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const PenaltySettings& settings) {
  return std::make_unique<PenaltyContact>(std::move(name),
                                          std::vector<ContactPass>{make_pass(nodes, facets)},
                                          settings, ties_of(nodes, settings));
}

std::unique_ptr<ContactInterface> make_surface_contact(std::string name, ContactSurface first,
                                                       ContactSurface second,
                                                       const PenaltySettings& settings) {
  std::vector<ContactPass> passes{make_pass(first, second), make_pass(second, first)};
  if (!first.facets.empty()) passes[0].surface_of_nodes = 1;
  if (!second.facets.empty()) passes[1].surface_of_nodes = 0;
  return std::make_unique<PenaltyContact>(std::move(name), std::move(passes), settings,
                                          ties_of(first, settings));
}

std::unique_ptr<ContactInterface> make_single_surface_contact(std::string name,
                                                              ContactSurface surface,
                                                              const PenaltySettings& settings) {
  ContactPass pass = make_pass(surface, surface);
  pass.find_neighbours();
  pass.surface_of_nodes = 0;
  return std::make_unique<PenaltyContact>(std::move(name),
                                          std::vector<ContactPass>{std::move(pass)}, settings);
}

}  // namespace crosswalk::fe
