// The explicit central-difference (leap-frog) step: positions at t, velocities at t - dt/2
// [belytschko2014, 6.2]. A step is a visible list; nothing in it allocates.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

/// Working memory of the solver; holds nothing that a restart needs.
struct Scratch {
  Scratch(const Model& model, int threads);

  /// A corner whose force and moment are kept for outputs.
  struct Tap {
    int element = 0, corner = 0;  ///< block-local
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  };
  /// Keeps that corner from now on; taps[tile][index] holds its load after compute_forces().
  std::pair<int, int> add_tap(const Model& model, int block, int element, int corner);

  int threads = 1;
  /// Tiles [next, end) that a thread has still to do, or others when they have done theirs.
  struct alignas(64) TileQueue {
    std::atomic<int> next = 0;
    int end = 0;
  };
  std::vector<TileQueue> queues;  ///< per thread
  std::vector<BlockSums> tile_sums;
  std::vector<BlockSums> block_sums;
  LaneVector force_rows, moment_rows;  ///< see force_tiles.h
  std::vector<std::vector<Tap>> taps;  ///< per tile
  std::vector<Vec3> applied;           ///< N, by contacts, loads and ties in this step
  std::vector<int> loaded;             ///< nodes with such a load, some more than once
  /// Nodes of bodies, guides and supports, and the force and moment on each, N, N m.
  std::vector<int> constrained;
  std::vector<char> is_constrained;  ///< per node
  std::vector<Vec3> force, moment;   ///< per node; of constrained ones only
  ContactLoads contact_loads;
  FailedElements failed;  ///< found again from the histories whenever their number changes
  std::vector<ContactReport> contact_reports;
  std::vector<BodyMotionView> body_views;
  std::vector<Wrench> body_wrench;  ///< on each body about its origin, elements and contacts
  std::vector<Twist> body_command;  ///< next twist of driven bodies; see move()
  std::vector<Vec3> held;           ///< positions of fixed nodes before the move
  static constexpr int kNodesPerChunk = 512;
  std::vector<std::array<double, 3>> node_sums;  ///< per chunk, added up in their order

 private:
  void list_constrained(const Model& model);
};

/// Forces at the present positions and the energies that go with them. Throws NumericalError when
/// an element is inverted or a force is not a number.
StepReport compute_forces(const Model& model, State& state, Scratch& scratch);
/// On every node, with those forces and before the move, N: elements, contacts, loads and ties.
std::vector<Vec3> nodal_forces(const Model& model, const Scratch& scratch);
/// Kick and drift by dt with those forces. Driven bodies take scratch.body_command.
void move(const Model& model, State& state, Scratch& scratch, double dt);
/// Both, with driven bodies keeping their twist.
StepReport advance_step(const Model& model, State& state, Scratch& scratch, double dt);

/// The step to take, s: the scaled stable one, or less where the settings limit it.
double next_step(const Model& model, const State& state, const StepReport& report);
/// "element 10457 (part 88 'cerebrum', hex8)".
std::string describe_element(const Model& model, int block, int element);

}  // namespace crosswalk::fe
