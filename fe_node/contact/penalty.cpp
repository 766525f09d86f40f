#include "fe_node/contact/penalty.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/contact/pair.h"
#include "fe_node/contact/search.h"

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
  kNodeSlots
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
/// Head of the value array: the search margin, then the watched positions of the last search.
constexpr int kMargin = 0, kReference = 1;
/// Head of the index array: the step at which motion is looked at next, then the lists' lengths.
constexpr int kNextCheckLow = 0, kNextCheckHigh = 1, kLists = 2;
constexpr int kCheckEvery = 10;  // steps between looks at how far things have moved

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
  PenaltyContact(std::string name, std::vector<ContactPass> passes,
                 const PenaltySettings& settings);
  void initialise(ContactHistory& history, const ContactContext& context) const override;
  int max_nodal_loads() const override { return 5 * node_entries_; }
  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override;

 private:
  void search_all(ContactHistory& history, const ContactContext& context) const;
  bool must_search(ContactHistory& history, const ContactContext& context) const;
  void solve_near(const ContactPass& pass, const NearNode& near, const ContactContext& context,
                  double* memory, double* result) const;
  Touch nearest(const ContactPass& pass, const NearNode& near, const ContactContext& context,
                const double* memory) const;
  PairLaw law_of(const ContactNode& node, const ContactFacet& facet, const ContactContext& context,
                 double& mass) const;
  double* memory_of(ContactHistory& history, int pass) const {
    return history.values.data() + memory_begin_[pass];
  }

  std::vector<ContactPass> passes_;
  PenaltySettings settings_;
  std::vector<int> watched_;  ///< mesh nodes of all passes, rising
  std::vector<std::size_t> memory_begin_;
  std::size_t result_begin_ = 0;
  int node_entries_ = 0;
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

double mean_edge(const std::vector<ContactPass>& passes, std::span<const NodeRecord> nodes) {
  double sum = 0, count = 0;
  for (const ContactPass& pass : passes)
    for (const ContactFacet& facet : pass.facets)
      for (int i = 0; i < 2; ++i) {
        sum += (nodes[facet.node[i]].position() - nodes[facet.node[i + 1]].position()).norm();
        count += 1;
      }
  return sum / std::max(count, 1.0);
}

PenaltyContact::PenaltyContact(std::string name, std::vector<ContactPass> passes,
                               const PenaltySettings& settings)
    : ContactInterface(std::move(name)), passes_(std::move(passes)), settings_(settings) {
  CW_ASSERT(settings_.nominal_step > 0);
  for (ContactPass& pass : passes_) {
    pass.thickness_scale = settings_.thickness_scale;
    node_entries_ += static_cast<int>(pass.nodes.size());
    for (const ContactNode& node : pass.nodes) watched_.push_back(node.node);
    for (const ContactFacet& facet : pass.facets)
      watched_.insert(watched_.end(), facet.node.begin(), facet.node.end());
  }
  std::sort(watched_.begin(), watched_.end());
  watched_.erase(std::unique(watched_.begin(), watched_.end()), watched_.end());
  std::size_t place = kReference + 3 * watched_.size();
  for (const ContactPass& pass : passes_) {
    memory_begin_.push_back(place);
    place += kNodeSlots * pass.nodes.size();
  }
  result_begin_ = place;
}

void PenaltyContact::initialise(ContactHistory& history, const ContactContext& context) const {
  history.values.assign(result_begin_, 0.0);
  history.values[kMargin] = settings_.search_margin > 0 ? settings_.search_margin
                                                        : 0.5 * mean_edge(passes_, context.nodes);
  search_all(history, context);
  if (settings_.initial != InitialPenetration::Accepted) return;
  std::size_t place = kLists + passes_.size();
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const CandidateList list({history.indices.data() + place, history.indices.size() - place});
    place += history.indices[kLists + p];
    for (int i = 0; i < list.count(); ++i) {
      const NearNode near = list[i];
      double* memory = memory_of(history, static_cast<int>(p)) + kNodeSlots * near.node;
      const Touch touch = nearest(passes_[p], near, context, memory);
      if (touch.facet && touch.penetration > 0) memory[kAllowance] = touch.penetration;
    }
  }
}

void PenaltyContact::search_all(ContactHistory& history, const ContactContext& context) const {
  double* reference = history.values.data() + kReference;
  for (std::size_t i = 0; i < watched_.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      reference[3 * i + axis] = context.nodes[watched_[i]].x[axis];
  history.indices.assign(kLists + passes_.size(), 0);
  std::size_t near = 0;
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const std::size_t before = history.indices.size();
    search(passes_[p], context.nodes, history.values[kMargin], history.indices);
    history.indices[kLists + p] = static_cast<int>(history.indices.size() - before);
    near = std::max(near, static_cast<std::size_t>(history.indices[before]));
  }
  history.values.resize(result_begin_ + kResultSlots * near);
}

/// Looks every few steps whether anything could leave half the margin before the next look.
bool PenaltyContact::must_search(ContactHistory& history, const ContactContext& context) const {
  const std::int64_t next =
      (std::int64_t{history.indices[kNextCheckHigh]} << 31) + history.indices[kNextCheckLow];
  if (context.step < next) return false;
  const double margin = history.values[kMargin];
  const double* reference = history.values.data() + kReference;
  double moved2 = 0, speed2 = 0;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const NodeRecord& node = context.nodes[watched_[i]];
    const Vec3 moved = node.position() - Eigen::Map<const Vec3>(reference + 3 * i);
    moved2 = std::max(moved2, moved.squaredNorm());
    speed2 = std::max(speed2, node.velocity().squaredNorm());
  }
  const double dt = std::max(context.dt, settings_.nominal_step);
  const bool is_due =
      !(std::sqrt(moved2) + 2 * kCheckEvery * dt * std::sqrt(speed2) < 0.5 * margin);
  const std::int64_t then = context.step + kCheckEvery;
  if (is_due) search_all(history, context);
  history.indices[kNextCheckLow] = static_cast<int>(then & 0x7fffffff);
  history.indices[kNextCheckHigh] = static_cast<int>(then >> 31);
  return is_due;
}

/// The nearest facet; of two equally near ones, that which the node faces more squarely.
Touch PenaltyContact::nearest(const ContactPass& pass, const NearNode& near,
                              const ContactContext& context, const double* memory) const {
  Touch best;
  double best_distance = 1e300;
  const ContactNode& node = pass.nodes[near.node];
  const Vec3 x = context.nodes[node.node].position();
  const Vec3 last_u = Eigen::Map<const Vec3>(memory + kDirection);
  const bool was_touching = memory[kTouches] > 0;
  for (int f : near.candidates) {
    const ContactFacet& facet = pass.facets[f];
    Touch t;
    t.corners = corners_of(facet, context.nodes);
    t.projection = closest_point(x, t.corners, facet.is_triangle());
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
    const double tie = 1e-9 * (d + reach);
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

PairLaw PenaltyContact::law_of(const ContactNode& node, const ContactFacet& facet,
                               const ContactContext& context, double& mass) const {
  double heaviest = 0;
  for (int n : facet.node) heaviest = std::max(heaviest, context.nodes[n].inverse_mass);
  const double inverse = context.nodes[node.node].inverse_mass + heaviest;
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

void PenaltyContact::solve_near(const ContactPass& pass, const NearNode& near,
                                const ContactContext& context, double* memory,
                                double* result) const {
  result[kFacet] = -1;
  result[kFrictionLoss] = 0;
  const Touch t = nearest(pass, near, context, memory);
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
  result[kOmega2] = law.stiffness * inverse;
}

ContactReport PenaltyContact::forces(const ContactContext& context, ContactHistory& history,
                                     ContactLoads& loads) const {
  ContactReport report;
  if (context.time < settings_.birth || context.time > settings_.death) return report;
  must_search(history, context);
  double omega2 = 0;
  std::size_t place = kLists + passes_.size();
  for (std::size_t p = 0; p < passes_.size(); ++p) {
    const ContactPass& pass = passes_[p];
    const CandidateList list({history.indices.data() + place, history.indices.size() - place});
    place += history.indices[kLists + p];
    double* memory = memory_of(history, static_cast<int>(p));
    double* results = history.values.data() + result_begin_;
    const int count = list.count();
#pragma omp parallel for schedule(static) num_threads(context.threads) if (count > 512)
    for (int i = 0; i < count; ++i) {
      const NearNode near = list[i];
      solve_near(pass, near, context, memory + kNodeSlots * near.node, results + kResultSlots * i);
    }
    for (int i = 0; i < count; ++i) {
      const double* r = results + kResultSlots * i;
      report.friction_dissipated += r[kFrictionLoss];
      if (r[kFacet] < 0) continue;
      const Vec3 force = Eigen::Map<const Vec3>(r + kOnNode);
      loads.nodal.push_back({pass.nodes[list[i].node].node, force});
      const ContactFacet& facet = pass.facets[static_cast<std::size_t>(r[kFacet])];
      const int corners = facet.is_triangle() ? 3 : 4;
      for (int c = 0; c < corners; ++c)
        loads.nodal.push_back({facet.node[c], Eigen::Map<const Vec3>(r + kOnCorner + 3 * c)});
      report.force += p == 0 ? force : Vec3(-force);
      report.stored += r[kStored];
      report.damping_dissipated += r[kDampingLoss];
      report.max_penetration = std::max(report.max_penetration, r[kPenetration]);
      omega2 = std::max(omega2, r[kOmega2]);
      ++report.active;
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

}  // namespace

std::unique_ptr<ContactInterface> make_node_contact(std::string name, ContactSurface nodes,
                                                    ContactSurface facets,
                                                    const PenaltySettings& settings) {
  return std::make_unique<PenaltyContact>(
      std::move(name), std::vector<ContactPass>{make_pass(nodes, facets)}, settings);
}

std::unique_ptr<ContactInterface> make_surface_contact(std::string name, ContactSurface first,
                                                       ContactSurface second,
                                                       const PenaltySettings& settings) {
  return std::make_unique<PenaltyContact>(
      std::move(name), std::vector<ContactPass>{make_pass(first, second), make_pass(second, first)},
      settings);
}

std::unique_ptr<ContactInterface> make_single_surface_contact(std::string name,
                                                              ContactSurface surface,
                                                              const PenaltySettings& settings) {
  ContactPass pass = make_pass(surface, surface);
  pass.find_neighbours();
  return std::make_unique<PenaltyContact>(std::move(name),
                                          std::vector<ContactPass>{std::move(pass)}, settings);
}

}  // namespace crosswalk::fe
