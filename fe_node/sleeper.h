// A part of the model that rides rigidly on a driven body and costs nothing until it is needed: the
// windshield far from the head. While it sleeps its elements, nodes and contacts are left out of
// the step; its kinetic energy stays in the books. It wakes once and for good.
//
// Its nodes are the last of the mesh. Gravity does not act on them, awake or asleep: the shape
// given is the one it has under its own weight.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/spatial.h"

namespace crosswalk::fe {

struct Model;
struct State;

/// State::awake_from of a model whose sleeper has not been woken.
inline constexpr std::int64_t kAsleep = std::numeric_limits<std::int64_t>::max();

struct Sleeper {
  int body = -1;                       ///< index into Model::bodies
  int first_node = 0;                  ///< of the nodes that sleep
  std::vector<char> blocks, contacts;  ///< per block and contact of the model: sleeps with it
  Pose X_BD;                           ///< its mesh coordinates in the body's frame
  Inertia inertia;  ///< of what moves beside the body itself, in mesh coordinates
  double kinetic(const Pose& X_WB, const Twist& V_WB) const;  ///< J, carried rigidly
};

/// The sleeper made of these parts, carried by `body`. Call after Model::finish(); contacts named
/// `contact` sleep with it.
Sleeper make_sleeper(const Model& model, const std::vector<int>& parts, int body,
                     const std::string& contact);

bool is_asleep(const Model& model, const State& state);
/// Nodes that take part in the step.
int awake_node_count(const Model& model, const State& state);
/// Puts the sleeper's nodes, and its body at the start, where a pose and twist of its mesh frame
/// have them.
void place_sleeper(const Model& model, const Pose& X_WD, const Twist& V_WD, State& state);
/// Puts the nodes where the body has carried them; for outputs and waking.
void carry_sleeper(const Model& model, State& state);
void wake_sleeper(const Model& model, State& state);

}  // namespace crosswalk::fe
