// The stable step of the mesh, found node by node, and the mass that lengthens it.
//
// Every element bounds its own stiffness at its corners, u^T k_e u <= k_e sum |u_I|^2
// (ElementBlock), so the whole mesh is bounded by what meets at each node: u^T K u <= sum_I |u_I|^2
// sum_e k_e, and the largest frequency by omega^2 <= max_I (sum_e k_e) / m_I, dt = 2 / omega. Never
// below the step of the worst element alone, and well above it where a thin or distorted element
// shares its nodes with heavier ones. Known as the nodal time step.
//
// What counts at a node is the mass of its own elements, also where a free body carries it or a
// facet: the body's or facet's energy holds that mass moving as the node does. Nodes whose motion
// is prescribed bound nothing.
#pragma once

#include <vector>

namespace crosswalk::fe {

struct Model;

/// kg and kg m2 per node; the inertia is empty without shells and beams.
struct NodalMass {
  std::vector<double> mass, inertia;
};
/// Of elements and mass points, before mass scaling. The model need not be finished.
NodalMass lumped_mass(const Model& model);
/// What of it resists the elements: none where the motion is prescribed.
NodalMass resisting_mass(const Model& model);

/// omega^2 of a node, 1/s2; zero where the motion is prescribed.
inline double frequency_squared(double stiffness, double mass) {
  return mass > 0 ? stiffness / mass : 0;
}
/// The stable step at the largest frequency of all, s; infinite at zero.
double step_at(double frequency_squared);

/// The stable step at the start, s, unscaled; of a finished model with its added mass.
double initial_stable_step(const Model& model);

/// Share of a part that mass scaling may add. A brain floats, and weighs 4 % of its mass in its
/// fluid: one per cent more of it changed the strain of V2370 by five (docs/head_neck_model.md,
/// "Sizes"), so near fluids get less.
inline constexpr double kPartLimit = 0.01, kNearFluidLimit = 0.002;

/// Mass to add so that no node needs a smaller unscaled step than `step`, s: kg and kg m2 per node,
/// and the kg that every part is the cause of.
struct AddedMass {
  NodalMass nodes;
  std::vector<double> parts;
};
AddedMass added_mass_for(const Model& model, double step);

/// The largest unscaled step for which mass scaling adds at most `limit` of the whole mass and no
/// more to any part than it may have, s; 0: no element has one. For a model built without scaling.
double mass_scaling_step_for(const Model& model, double limit);

}  // namespace crosswalk::fe
