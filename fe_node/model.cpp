#include "fe_node/model.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

void lump_masses(Model& model) {
  NodalMass lumped = lumped_mass(model);
  model.mass = std::move(lumped.mass);
  model.inertia = std::move(lumped.inertia);
  model.added_mass.assign(model.mesh.parts.size(), 0.0);
  model.part_mass.assign(model.mesh.parts.size(), 0.0);
  for (const auto& block : model.blocks)
    for (int element = 0; element < block->element_count(); ++element)
      model.part_mass[block->part()] += block->corners() * block->corner_mass(element);
}

/// Adds the mass that the wanted step lacks, and notes what resists the elements of each node.
void scale_masses(Model& model) {
  model.resisting = resisting_mass(model);
  if (!(model.settings.mass_scaling_step > 0)) return;
  const AddedMass added = added_mass_for(model, model.settings.mass_scaling_step);
  model.added_mass = added.parts;
  for (std::size_t n = 0; n < model.mass.size(); ++n) {
    model.mass[n] += added.nodes.mass[n];
    model.resisting.mass[n] += added.nodes.mass[n];
  }
  for (std::size_t n = 0; n < model.inertia.size(); ++n) {
    model.inertia[n] += added.nodes.inertia[n];
    model.resisting.inertia[n] += added.nodes.inertia[n];
  }
}

/// A tied node hands its mass to the nodes it follows.
void hand_over_tied_masses(Model& model) {
  for (const TiedNode& tie : model.tied) {
    for (int i = 0; i < tie.count; ++i)
      model.mass[tie.master[i]] += tie.weight[i] * model.mass[tie.node];
    model.mass[tie.node] = 0;
  }
}

void finish_body(Model& model, int index) {
  RigidBody& body = model.bodies[index];
  Inertia total = body.own;
  for (int node : body.nodes) {
    CW_ASSERT(model.body_of_node[node] == -1);  // the model builder merges bodies that share nodes
    model.body_of_node[node] = index;
    total = total + Inertia::of_point(model.mass[node], model.mesh.position[node]);
    if (model.has_rotations()) total.about_com += model.inertia[node] * Mat3::Identity();
  }
  // The spin of nodes at one place moves none of them: any inertia will do, that of 1 mm for one.
  constexpr double kPoint = 1e-3;  // m
  if (total.about_com.isZero(0)) total.about_com = total.mass * kPoint * kPoint * Mat3::Identity();
  // Nodes on one line leave the spin about it without inertia, and it moves none of them.
  constexpr double kSlender = 1e-6;  // of the trace
  const double trace = total.about_com.trace();
  if (total.about_com.determinant() < std::pow(kSlender, 2) * std::pow(trace, 3))
    total.about_com += kSlender * trace * Mat3::Identity();
  if (body.role == BodyRole::Follower) return;
  CW_ASSERT(body.role != BodyRole::Free || total.mass > 0);
  body.origin = total.com;
  total.com.setZero();
  body.inertia = total;
  body.p_BN.clear();
  for (int node : body.nodes) body.p_BN.push_back(model.mesh.position[node] - body.origin);
}

}  // namespace

void Model::finish() {
  CW_ASSERT(mass.empty());
  tiles = make_force_tiles(blocks, mesh.node_count());
  lump_masses(*this);
  scale_masses(*this);
  hand_over_tied_masses(*this);
  body_of_node.assign(mesh.node_count(), -1);
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) finish_body(*this, b);
  contact_mass = mass;
  for (const RigidBody& body : bodies)
    for (int n : body.nodes)
      contact_mass[n] =
          std::max(mass[n], body.inertia.mass / static_cast<double>(body.nodes.size()));
}

double Model::total_mass() const {
  double sum = 0;
  for (double m : mass) sum += m;
  for (const RigidBody& body : bodies) sum += body.own.mass;
  return sum;
}

}  // namespace crosswalk::fe
