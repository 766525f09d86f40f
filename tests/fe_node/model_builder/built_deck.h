// Small decks as text and the models built of them.
#pragma once

#include <string>

#include "fe_node/model_builder/model_builder.h"
#include "tests/fe_node/deck/deck_text.h"

namespace crosswalk::fe {

/// A cube of 10 mm edge in mm, kg, ms: nodes 1..8, part 1 of steel-like elasticity.
inline const std::string kCubeNodes =
    "*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,0,0,10\n6,10,0,10\n7,10,10,10\n8,0,10,10\n";
inline const std::string kCubePart =
    "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,7.8e-6,210.0,0.3\n";
inline const std::string kCubeElement = "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n";
inline const std::string kCube = kCubeNodes + kCubePart + kCubeElement;

inline BuiltModel build(const std::string& text, BuildOptions options = {}) {
  if (options.units == UnitSystem::Unknown) options.units = UnitSystem::MmKgMs;
  return build_model(sound(text), options);
}

/// Built and finished.
inline BuiltModel model_of(const std::string& text, const BuildOptions& options = {}) {
  BuiltModel built = build(text, options);
  finish_model(built);
  return built;
}

/// Index of the node with that number.
inline int node_of(const Model& model, int id) {
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (model.mesh.node_id[n] == DeckId(id)) return n;
  ADD_FAILURE() << "no node " << id;
  return -1;
}

}  // namespace crosswalk::fe
