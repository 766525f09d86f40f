#include "fe_node/contact/edge_contact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/error.h"
#include "fe_node/contact/broad_phase.h"
#include "fe_node/contact/edge_pair.h"
#include "fe_node/contact/pair.h"

namespace crosswalk::fe {
namespace {

/// What a near pair keeps between steps.
enum PairSlot { kDirection = 0, kFriction = 3, kAllowance = 6, kStiffness, kTouches, kPairSlots };
/// Head of the value array; then the reference positions of the last search, then the pairs.
enum ValueHead { kMargin = 0, kReference = 1 };
constexpr int kIndicesPerPair = 2;  // of the first list, of the second; the list is all indices

struct PairResult {
  bool touches = false;
  EdgeForces forces;
  PairAnswer answer;
  double penetration = 0, omega2 = 0, friction_lost = 0;
};

class EdgeContact final : public ContactInterface {
 public:
  EdgeContact(std::string name, std::vector<ContactEdge> first, std::vector<ContactEdge> second,
              const ContactSurface& surface, const PenaltySettings& settings)
      : ContactInterface(std::move(name)),
        first_(std::move(first)),
        second_(std::move(second)),
        is_single_(second_.empty()),
        settings_(settings) {
    CW_ASSERT(settings_.nominal_step > 0);
    if (is_single_) {
      second_ = first_;
      find_neighbours(surface);
    }
    for (const auto* edges : {&first_, &second_})
      for (const ContactEdge& edge : *edges)
        watched_.insert(watched_.end(), edge.node.begin(), edge.node.end());
    std::sort(watched_.begin(), watched_.end());
    watched_.erase(std::unique(watched_.begin(), watched_.end()), watched_.end());
  }

  void initialise(ContactHistory& history, const ContactContext& context) const override {
    history = {};
    history.values.assign(kReference + 3 * watched_.size(), 0.0);
    double length = 0;
    for (const ContactEdge& edge : first_) {
      const EdgeEnds x = ends(edge, context);
      length += (x[1] - x[0]).norm() / static_cast<double>(first_.size());
    }
    history.values[kMargin] = settings_.search_margin > 0 ? settings_.search_margin : 0.5 * length;
    search(history, context);
    if (settings_.initial != InitialPenetration::Accepted) return;
    for (int i = 0; i < pair_count(history); ++i) {
      double* memory = pair_memory(history, i);
      const auto [a, b] = pair_at(history, i);
      const EdgePair pair = closest_pair(ends(first_[a], context), ends(second_[b], context));
      memory[kAllowance] = std::max(0.0, reach(first_[a], second_[b]) - pair.distance);
    }
  }

  /// Pairs are found anew as edges move, so any number may touch; each node of an edge counts.
  int max_nodal_loads() const override {
    return 4 * kTouchingPerEdge * static_cast<int>(first_.size());
  }

  ContactReport forces(const ContactContext& context, ContactHistory& history,
                       ContactLoads& loads) const override;

 private:
  static constexpr int kTouchingPerEdge = 4;  // room reserved; more only cost an allocation

  static EdgeEnds ends(const ContactEdge& edge, const ContactContext& context) {
    return {context.nodes[edge.node[0]].position(), context.nodes[edge.node[1]].position()};
  }
  double reach(const ContactEdge& a, const ContactEdge& b) const {
    return settings_.thickness_scale * (a.radius + b.radius);
  }
  static int pair_count(const ContactHistory& history) {
    return static_cast<int>(history.indices.size()) / kIndicesPerPair;
  }
  static std::pair<int, int> pair_at(const ContactHistory& history, int i) {
    return {history.indices[kIndicesPerPair * i], history.indices[kIndicesPerPair * i + 1]};
  }
  double* pair_memory(ContactHistory& history, int i) const {
    return history.values.data() + kReference + 3 * watched_.size() +
           static_cast<std::size_t>(kPairSlots) * i;
  }

  void find_neighbours(const ContactSurface& surface);
  bool skips(int a, int b) const;
  bool needs_search(const ContactHistory& history, const ContactContext& context) const;
  void search(ContactHistory& history, const ContactContext& context) const;
  PairLaw law_of(const ContactEdge& a, const ContactEdge& b, const ContactContext& context) const;
  PairResult solve(const ContactEdge& a, const ContactEdge& b, const ContactContext& context,
                   double* memory) const;

  std::vector<ContactEdge> first_, second_;
  bool is_single_;
  PenaltySettings settings_;
  std::vector<int> watched_;                 ///< mesh nodes, rising
  std::map<int, std::set<int>> neighbours_;  ///< of a node, by facets and edges; single only
};

void EdgeContact::find_neighbours(const ContactSurface& surface) {
  for (const ContactFacet& facet : surface.facets)
    for (int n : facet.node) neighbours_[n].insert(facet.node.begin(), facet.node.end());
  for (const ContactEdge& edge : first_)
    for (int n : edge.node) neighbours_[n].insert(edge.node.begin(), edge.node.end());
}

bool EdgeContact::skips(int a, int b) const {
  if (!is_single_) return false;
  if (b <= a) return true;  // each pair once
  for (int n : first_[a].node) {
    const std::set<int>& around = neighbours_.at(n);
    for (int m : second_[b].node)
      if (around.contains(m)) return true;
  }
  return false;
}

bool EdgeContact::needs_search(const ContactHistory& history, const ContactContext& context) const {
  const double* reference = history.values.data() + kReference;
  Vec3 mean = Vec3::Zero();
  const auto moved = [&](std::size_t i) {
    return Vec3(context.nodes[watched_[i]].position() - Eigen::Map<const Vec3>(reference + 3 * i));
  };
  for (std::size_t i = 0; i < watched_.size(); ++i) mean += moved(i);
  mean /= static_cast<double>(std::max<std::size_t>(watched_.size(), 1));
  double farthest2 = 0;
  for (std::size_t i = 0; i < watched_.size(); ++i)
    farthest2 = std::max(farthest2, (moved(i) - mean).squaredNorm());
  return !(2 * std::sqrt(farthest2) < history.values[kMargin]);
}

/// Pairs whose boxes come within the margin, rising; what known pairs remember is kept.
void EdgeContact::search(ContactHistory& history, const ContactContext& context) const {
  std::map<std::pair<int, int>, std::array<double, kPairSlots>> known;
  for (int i = 0; i < pair_count(history); ++i) {
    const double* memory = pair_memory(history, i);
    if (memory[kTouches] > 0 || memory[kAllowance] > 0)
      std::copy_n(memory, kPairSlots, known[pair_at(history, i)].begin());
  }
  double* reference = history.values.data() + kReference;
  for (std::size_t i = 0; i < watched_.size(); ++i)
    Eigen::Map<Vec3>(reference + 3 * i) = context.nodes[watched_[i]].position();

  // The middle of an edge lies in the box of another, grown by half its length and the reach.
  double longest = 0, widest = 0;
  for (const ContactEdge& edge : first_) {
    const EdgeEnds x = ends(edge, context);
    longest = std::max(longest, 0.5 * (x[1] - x[0]).norm());
    widest = std::max(widest, settings_.thickness_scale * edge.radius);
  }
  Box3 region;
  std::vector<Vec3> middle;
  for (const ContactEdge& edge : first_) {
    const EdgeEnds x = ends(edge, context);
    middle.push_back(0.5 * (x[0] + x[1]));
    region.add(middle.back());
  }
  std::vector<Box3> boxes;
  for (const ContactEdge& edge : second_) {
    Box3& box = boxes.emplace_back();
    for (const Vec3& x : ends(edge, context)) box.add(x);
    box.grow(longest + widest + settings_.thickness_scale * edge.radius + history.values[kMargin]);
  }
  const BoxGrid grid(boxes, region);
  history.indices.clear();
  std::vector<int> found;
  for (int a = 0; a < static_cast<int>(first_.size()); ++a) {
    found.clear();
    grid.find(middle[static_cast<std::size_t>(a)], found);
    const EdgeEnds x = ends(first_[a], context);
    for (int b : found) {
      if (skips(a, b)) continue;
      const double far = closest_pair(x, ends(second_[b], context)).distance;
      if (far > reach(first_[a], second_[b]) + history.values[kMargin]) continue;
      history.indices.insert(history.indices.end(), {a, b});
    }
  }
  history.values.resize(kReference + 3 * watched_.size());
  history.values.resize(history.values.size() +
                        static_cast<std::size_t>(kPairSlots) * pair_count(history));
  for (int i = 0; i < pair_count(history); ++i)
    if (const auto it = known.find(pair_at(history, i)); it != known.end())
      std::copy(it->second.begin(), it->second.end(), pair_memory(history, i));
}

PairLaw EdgeContact::law_of(const ContactEdge& a, const ContactEdge& b,
                            const ContactContext& context) const {
  double inverse = 0;
  for (const ContactEdge* edge : {&a, &b})
    inverse += std::max(context.nodes[edge->node[0]].inverse_mass,
                        context.nodes[edge->node[1]].inverse_mass);
  if (inverse == 0) {  // both rigid: their shares of the bodies' masses
    for (const ContactEdge* edge : {&a, &b}) {
      const double share =
          std::min(context.nodal_mass[edge->node[0]], context.nodal_mass[edge->node[1]]);
      inverse += share > 0 ? 1 / share : 0;
    }
  }
  PairLaw law;
  law.stiffness = settings_.stiffness_scale * std::min(a.stiffness, b.stiffness);
  if (inverse > 0) {
    const double per_step = 1 / (inverse * settings_.nominal_step * settings_.nominal_step);
    law.stiffness = std::max(law.stiffness, 0.5 * settings_.soft_scale * per_step);
    law.stiffness = std::min(law.stiffness, 0.25 * per_step);
    law.damping = 2 * settings_.damping_ratio * std::sqrt(law.stiffness / inverse);
  }
  law.static_friction = settings_.static_friction;
  law.dynamic_friction = settings_.dynamic_friction;
  law.friction_decay = settings_.friction_decay;
  return law;
}

PairResult EdgeContact::solve(const ContactEdge& a, const ContactEdge& b,
                              const ContactContext& context, double* memory) const {
  PairResult result;
  EdgePair pair = closest_pair(ends(a, context), ends(b, context));
  const double limit = reach(a, b);
  Eigen::Map<Vec3> last(memory + kDirection), friction(memory + kFriction);
  const bool was_touching = memory[kTouches] > 0;
  if (pair.distance < 1e-10 + 1e-9 * limit) pair.u = last;  // round-off spoils its direction
  if (was_touching && pair.u.dot(last) < 0) {               // gone through the other's axis
    pair.u = -pair.u;
    pair.distance = -pair.distance;
    for (Vec3& lever : pair.lever) lever = -lever;
  }
  const bool may_touch = (pair.is_between || a.is_line || b.is_line) && !pair.u.isZero(0);
  const double overlap = may_touch ? limit - pair.distance : 0;
  memory[kAllowance] = std::clamp(overlap, 0.0, memory[kAllowance]);
  const double penetration = overlap - memory[kAllowance];
  if (!(penetration > 0)) {
    if (was_touching && memory[kStiffness] > 0)
      result.friction_lost = 0.5 * friction.squaredNorm() / memory[kStiffness];
    friction.setZero();
    memory[kTouches] = 0;
    return result;
  }
  const PairLaw law = law_of(a, b, context);
  PairFrame frame;  // what the law of a touching pair asks for
  frame.u = pair.u;
  frame.carries_friction = pair.carries_friction;
  const EdgeEnds v_a{context.nodes[a.node[0]].velocity(), context.nodes[a.node[1]].velocity()},
      v_b{context.nodes[b.node[0]].velocity(), context.nodes[b.node[1]].velocity()};
  const Vec3 velocity = relative_velocity(pair, v_a, v_b);
  result.answer = touch(law, frame, penetration, velocity, friction, context.dt);
  result.forces = balanced_forces(pair, result.answer.force);
  result.touches = true;
  result.penetration = penetration;
  double inverse = 0;
  for (int side = 0; side < 2; ++side)
    for (int end = 0; end < 2; ++end) {
      const double along = pair.along[static_cast<std::size_t>(side)];
      const double weight = end == 0 ? 1 - along : along;
      const ContactEdge& edge = side == 0 ? a : b;
      inverse +=
          weight * weight * context.nodes[edge.node[static_cast<std::size_t>(end)]].inverse_mass;
    }
  result.omega2 = law.stiffness * inverse;
  last = pair.u;
  friction = result.answer.friction;
  memory[kStiffness] = law.stiffness;
  memory[kTouches] = 1;
  return result;
}

ContactReport EdgeContact::forces(const ContactContext& context, ContactHistory& history,
                                  ContactLoads& loads) const {
  ContactReport report;
  if (needs_search(history, context)) search(history, context);
  if (context.time < settings_.birth || context.time > settings_.death) return report;
  const auto is_gone = [&](const ContactEdge& edge) {
    return context.failed != nullptr && context.failed->contains(edge.kind, edge.element);
  };
  double omega2 = 0;
  for (int i = 0; i < pair_count(history); ++i) {
    const auto [ia, ib] = pair_at(history, i);
    const ContactEdge &a = first_[ia], &b = second_[ib];
    if (is_gone(a) || is_gone(b)) continue;
    const PairResult r = solve(a, b, context, pair_memory(history, i));
    report.friction_dissipated += r.friction_lost;
    if (!r.touches) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      loads.nodal.push_back({a.node[end], r.forces[0][end]});
      loads.nodal.push_back({b.node[end], r.forces[1][end]});
    }
    report.force += r.answer.force;
    report.stored += r.answer.stored;
    report.friction_dissipated += r.answer.friction_dissipated;
    report.damping_dissipated += r.answer.damping_dissipated;
    report.max_penetration = std::max(report.max_penetration, r.penetration);
    omega2 = std::max(omega2, r.omega2);
    ++report.active;
  }
  if (omega2 > 0) report.stable_step = 2 / std::sqrt(2 * omega2);
  return report;
}

}  // namespace

std::vector<ContactEdge> free_edges(const ContactSurface& surface) {
  std::map<std::pair<int, int>, int> count;
  const auto for_each = [&](auto&& visit) {
    for (const ContactFacet& facet : surface.facets) {
      if (!facet.is_two_sided) continue;
      const int corners = facet.is_triangle() ? 3 : 4;
      for (int c = 0; c < corners; ++c) {
        const int n = facet.node[static_cast<std::size_t>(c)],
                  m = facet.node[static_cast<std::size_t>((c + 1) % corners)];
        visit(facet, std::minmax(n, m));
      }
    }
  };
  for_each([&](const ContactFacet&, std::pair<int, int> key) { ++count[key]; });
  std::vector<ContactEdge> edges;
  for_each([&](const ContactFacet& facet, std::pair<int, int> key) {
    if (count[key] == 1)
      edges.push_back({{key.first, key.second},
                       facet.half_thickness,
                       facet.stiffness,
                       false,
                       facet.kind,
                       facet.element});
  });
  return edges;
}

std::vector<ContactEdge> line_edges(const Mesh& mesh, int part, double area, double bulk_modulus) {
  std::vector<ContactEdge> edges;
  const ElementTable& table = mesh.table(ElementKind::Line2);
  for (int e = 0; e < table.size(); ++e) {
    if (table.part[e] != part) continue;
    const std::span<const int> n = mesh.corners(ElementKind::Line2, e);
    const double length = (mesh.position[n[1]] - mesh.position[n[0]]).norm();
    if (!(length > 0)) continue;
    edges.push_back({{n[0], n[1]},
                     std::sqrt(area / std::numbers::pi),
                     bulk_modulus * area / length,
                     true,
                     ElementKind::Line2,
                     e});
  }
  return edges;
}

std::unique_ptr<ContactInterface> make_edge_contact(std::string name,
                                                    std::vector<ContactEdge> first,
                                                    std::vector<ContactEdge> second,
                                                    const ContactSurface& surface,
                                                    const PenaltySettings& settings) {
  return std::make_unique<EdgeContact>(std::move(name), std::move(first), std::move(second),
                                       surface, settings);
}

}  // namespace crosswalk::fe
