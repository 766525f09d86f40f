#include "fe_node/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fe_node/model.h"

namespace crosswalk::fe {
namespace {

/// Calls visit(block, element, node) for every corner.
template <class Visit>
void for_each_corner(const Model& model, Visit visit) {
  for (const auto& block : model.blocks)
    for (int e = 0; e < block->element_count(); ++e)
      for (int corner = 0; corner < block->corners(); ++corner)
        visit(*block, e, block->node(e / kLanes, corner, e % kLanes));
}

bool has_moments(const Model& model) {
  return std::any_of(model.blocks.begin(), model.blocks.end(),
                     [](const auto& b) { return b->has_moments(); });
}

/// Sums of the elements' stiffnesses at each node, N/m and N m.
struct NodalStiffness {
  std::vector<double> translation, rotation;

  explicit NodalStiffness(const Model& model) {
    translation.assign(model.mesh.node_count(), 0.0);
    if (has_moments(model)) rotation = translation;
    for_each_corner(model, [this](const ElementBlock& block, int e, int node) {
      translation[node] += block.initial_stiffness(e);
      if (block.has_moments()) rotation[node] += spin_stiffness(block, e);
    });
  }
  static double spin_stiffness(const ElementBlock& block, int e) {
    return block.initial_stiffness(e) * block.corner_inertia(e) / block.corner_mass(e);
  }
};

/// Mass that a node lacks for a step.
double lacking(double stiffness, double mass, double step) {
  return mass > 0 ? std::max(0.0, 0.25 * stiffness * step * step - mass) : 0.0;
}

AddedMass added_mass_for(const Model& model, const NodalStiffness& stiffness, const NodalMass& own,
                         double step) {
  AddedMass added;
  const int node_count = model.mesh.node_count();
  added.nodes.mass.resize(node_count);
  added.nodes.inertia.resize(own.inertia.size());
  added.parts.assign(model.mesh.parts.size(), 0.0);
  for (int n = 0; n < node_count; ++n)
    added.nodes.mass[n] = lacking(stiffness.translation[n], own.mass[n], step);
  for (std::size_t n = 0; n < own.inertia.size(); ++n)
    added.nodes.inertia[n] = lacking(stiffness.rotation[n], own.inertia[n], step);
  for_each_corner(model, [&](const ElementBlock& block, int e, int node) {
    if (added.nodes.mass[node] > 0)
      added.parts[block.part()] +=
          added.nodes.mass[node] * block.initial_stiffness(e) / stiffness.translation[node];
  });
  return added;
}

}  // namespace

double step_at(double frequency_squared) {
  return frequency_squared > 0 ? 2 / std::sqrt(frequency_squared)
                               : std::numeric_limits<double>::infinity();
}

NodalMass lumped_mass(const Model& model) {
  NodalMass own;
  own.mass.assign(model.mesh.node_count(), 0.0);
  if (!model.point_mass.empty()) own.mass = model.point_mass;
  if (has_moments(model)) own.inertia.assign(model.mesh.node_count(), 0.0);
  for_each_corner(model, [&own](const ElementBlock& block, int e, int node) {
    own.mass[node] += block.corner_mass(e);
    if (block.has_moments()) own.inertia[node] += block.corner_inertia(e);
  });
  return own;
}

NodalMass resisting_mass(const Model& model) {
  NodalMass own = lumped_mass(model);
  const auto bounds_nothing = [&own](int node) {
    own.mass[node] = 0;
    if (!own.inertia.empty()) own.inertia[node] = 0;
  };
  for (const RigidBody& body : model.bodies)
    if (body.role != BodyRole::Free)
      for (int n : body.nodes) bounds_nothing(n);
  return own;
}

double initial_stable_step(const Model& model) {
  const NodalMass own = model.resisting.mass.empty() ? resisting_mass(model) : model.resisting;
  const NodalStiffness stiffness(model);
  double largest = 0;
  for (std::size_t n = 0; n < own.mass.size(); ++n)
    largest = std::max(largest, frequency_squared(stiffness.translation[n], own.mass[n]));
  for (std::size_t n = 0; n < own.inertia.size(); ++n)
    largest = std::max(largest, frequency_squared(stiffness.rotation[n], own.inertia[n]));
  return step_at(largest);
}

AddedMass added_mass_for(const Model& model, double step) {
  return added_mass_for(model, NodalStiffness(model), resisting_mass(model), step);
}

double mass_scaling_step_for(const Model& model, double limit) {
  const NodalStiffness stiffness(model);
  const NodalMass own = resisting_mass(model);
  std::vector<double> allowed(model.mesh.parts.size(), 0.0);
  double total = 0;
  for_each_corner(model, [&](const ElementBlock& block, int e, int) {
    const double mass = block.corner_mass(e);
    allowed[block.part()] += (block.is_near_fluid() ? kNearFluidLimit : kPartLimit) * mass;
    total += mass;
  });
  for (const RigidBody& body : model.bodies) total += body.own.mass;
  for (double m : model.point_mass) total += m;
  const auto is_allowed = [&](double step) {
    const AddedMass added = added_mass_for(model, stiffness, own, step);
    double sum = 0;
    for (std::size_t p = 0; p < allowed.size(); ++p) {
      if (added.parts[p] > allowed[p]) return false;
      sum += added.parts[p];
    }
    return sum <= limit * total;
  };
  double low = initial_stable_step(model);
  if (!std::isfinite(low)) return 0;
  double high = 2 * low;
  while (is_allowed(high)) high *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (is_allowed(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace crosswalk::fe
