// A mesh-to-mesh contact as data: everything but the step it will run with.
#pragma once

#include "fe_node/contact/edge_contact.h"
#include "fe_node/contact/penalty.h"
#include "fe_node/contact/tied.h"

namespace crosswalk::fe {

struct MeshContactSpec {
  enum class Kind { Single, Surfaces, NodesToSurface, Tied, Edges };
  std::string name;
  Kind kind = Kind::Surfaces;
  ContactSurface first, second;  ///< `second` is empty for a single surface
  PenaltySettings settings;      ///< of all but tied ones
  /// Of contact between edges; `first_edges` among themselves when there are no others.
  std::vector<ContactEdge> first_edges, second_edges;
};

/// `step` is the solver's own, safety factor included, s.
inline std::unique_ptr<ContactInterface> make_mesh_contact(MeshContactSpec spec, double step) {
  spec.settings.nominal_step = step;
  switch (spec.kind) {
    case MeshContactSpec::Kind::Single:
      return make_single_surface_contact(spec.name, std::move(spec.first), spec.settings);
    case MeshContactSpec::Kind::Surfaces:
      return make_surface_contact(spec.name, std::move(spec.first), std::move(spec.second),
                                  spec.settings);
    case MeshContactSpec::Kind::NodesToSurface:
      return make_node_contact(spec.name, std::move(spec.first), std::move(spec.second),
                               spec.settings);
    case MeshContactSpec::Kind::Edges:
      return make_edge_contact(spec.name, std::move(spec.first_edges), std::move(spec.second_edges),
                               spec.first, spec.settings);
    case MeshContactSpec::Kind::Tied:
      break;
  }
  return make_tied_contact(spec.name, std::move(spec.first), std::move(spec.second), {step, 0});
}

}  // namespace crosswalk::fe
