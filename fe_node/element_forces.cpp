#include "fe_node/element_forces.h"

#include <algorithm>

#include <fmt/format.h>
#include <omp.h>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

constexpr int kMostCorners = 10;

/// The elements' stiffnesses, a tenth of a kernel's work, are found every so many steps. Within
/// four steps of 0.9 of it nothing moves further than a wave runs through three cells, and a cell
/// that is pressed in at a tenth of the wave speed loses less than the remaining tenth.
constexpr int kStepsPerLimit = 4;

bool wants_limit(const State& state) {
  return state.step % kStepsPerLimit == 0 || state.step == state.awake_from ||
         state.element_limit.stable_step <= 0;
}

void keep_taps(std::vector<Scratch::Tap>& taps, const ElementBlock& block, int first, int last,
               const double* forces, const double* moments) {
  for (Scratch::Tap& tap : taps) {
    const int group = tap.element / kLanes;
    if (group < first || group >= last) continue;
    const std::size_t slot = block.corner_slot(group - first, tap.corner, tap.element % kLanes);
    tap.force = Eigen::Map<const Vec3>(forces + slot);
    if (block.has_moments()) tap.moment = Eigen::Map<const Vec3>(moments + slot);
  }
}

void fetch_nodes(const ForceTiles& tiles, const StepContext& context, int call) {
  for (int k = tiles.arrivals_begin[call]; k < tiles.arrivals_begin[call + 1]; ++k) {
    __builtin_prefetch(&context.nodes[tiles.arrivals[k]]);
    if (!context.spin.empty()) __builtin_prefetch(&context.spin[tiles.arrivals[k]]);
  }
}

/// Corners of one call on their way from a kernel to the rows; those that no kernel fills belong to
/// padded lanes.
struct CornerBuffers {
  alignas(64) double forces[kGroupsPerCall * kMostCorners * kLanes * kCornerStride] = {};
  alignas(64) double moments[kGroupsPerCall * 4 * kLanes * kCornerStride] = {};
};

/// Forces of a tile's elements, added up in its rows.
void tile_forces(const Model& model, const StepContext& context, const ForceTile& tile,
                 std::span<double> history, Scratch& scratch, BlockSums& sums,
                 std::vector<Scratch::Tap>& taps) {
  const ElementBlock& block = *model.blocks[tile.block];
  const bool has_moments = block.has_moments();
  static thread_local CornerBuffers buffers;
  auto& [forces, moments] = buffers;
  double* force_rows = scratch.force_rows.data() + kCornerStride * tile.force_row;
  double* moment_rows = scratch.moment_rows.data() + kCornerStride * tile.moment_row;
  const std::size_t row_doubles = std::size_t{kCornerStride} * (tile.node_count + 1);
  std::fill_n(force_rows, row_doubles, 0.0);
  if (has_moments) std::fill_n(moment_rows, row_doubles, 0.0);
  const std::uint16_t* row = model.tiles.row_of_corner.data() + tile.corner;
  int call = tile.call;
  for (int first = tile.first; first < tile.last; first += kGroupsPerCall) {
    const int last = std::min(first + kGroupsPerCall, tile.last);
    const int corners = (last - first) * block.corners() * kLanes;
    fetch_nodes(model.tiles, context, ++call);
    block.forces(context, history, forces, moments, first, last, sums);
    add_corners(forces, row, corners, force_rows);
    if (has_moments) add_corners(moments, row, corners, moment_rows);
    row += corners;
    if (!taps.empty()) keep_taps(taps, block, first, last, forces, moments);
  }
}

void add(const BlockSums& part, BlockSums& sum) {
  sum.internal += part.internal;
  sum.hourglass += part.hourglass;
  sum.hourglass_dissipated += part.hourglass_dissipated;
  sum.viscous_dissipated += part.viscous_dissipated;
  sum.failed += part.failed;
  sum.limit(part.critical_element, part.least_step);
  if (part.inverted_element >= 0 && sum.inverted_element < 0) {
    sum.inverted_element = part.inverted_element;
    sum.inverted_jacobian = part.inverted_jacobian;
  }
}

/// What the elements allow, s, unscaled.
double nodal_stable_step(const Model& model, const State& state, const Scratch& scratch) {
  const int node_count = awake_node_count(model, state);
  const ForceTiles& tiles = model.tiles;
  double largest = 0;
#pragma omp parallel for schedule(static) num_threads(scratch.threads) reduction(max : largest)
  for (int n = 0; n < node_count; ++n) {
    const double k = stiffness_of_rows(tiles.force_rows, scratch.force_rows.data(), n);
    largest = std::max(largest, frequency_squared(k, model.resisting.mass[n]));
    if (!model.has_rotations()) continue;
    const double spin = stiffness_of_rows(tiles.moment_rows, scratch.moment_rows.data(), n);
    largest = std::max(largest, frequency_squared(spin, model.resisting.inertia[n]));
  }
  return step_at(largest);
}

/// Gives every thread as many tiles, by cost, in one piece: neighbours of the nodes it moves.
void share_out_tiles(const Model& model, bool asleep, Scratch& scratch) {
  const std::vector<ForceTile>& tiles = model.tiles.tiles;
  const auto cost = [&](const ForceTile& tile) {
    return asleep && model.sleeper->blocks[tile.block] ? 0 : tile.cost;
  };
  double total = 0, done = 0;
  for (const ForceTile& tile : tiles) total += cost(tile);
  int t = 0;
  for (int k = 0; k < scratch.threads; ++k) {
    scratch.queues[k].next = t;
    const double until = total * (k + 1) / scratch.threads;
    while (t < static_cast<int>(tiles.size()) && (done < until || k + 1 == scratch.threads))
      done += cost(tiles[t++]);
    scratch.queues[k].end = t;
  }
}

}  // namespace

void element_forces(const Model& model, State& state, Scratch& scratch) {
  const StepContext context{state.nodes,   state.spin,         state.time,
                            state.last_dt, wants_limit(state), scratch.threads};
  const bool asleep = is_asleep(model, state);
  for (std::size_t b = 0; b < model.blocks.size(); ++b)
    if (model.blocks[b]->has_neighbours() && !(asleep && model.sleeper->blocks[b]))
      model.blocks[b]->prepare(context, state.history[b]);
  share_out_tiles(model, asleep, scratch);
  const auto compute = [&](int t) {
    const ForceTile& tile = model.tiles.tiles[t];
    scratch.tile_sums[t] = BlockSums{};
    if (asleep && model.sleeper->blocks[tile.block]) return;
    tile_forces(model, context, tile, state.history[tile.block], scratch, scratch.tile_sums[t],
                scratch.taps[t]);
  };
  // Whoever has done its own tiles helps the next thread: every tile has rows of its own.
#pragma omp parallel num_threads(scratch.threads)
  for (int k = 0; k < scratch.threads; ++k) {
    Scratch::TileQueue& queue = scratch.queues[(omp_get_thread_num() + k) % scratch.threads];
    for (int t = queue.next++; t < queue.end; t = queue.next++) compute(t);
  }
}

void find_failed(const Model& model, const State& state, Scratch& scratch) {
  int count = 0;
  for (const BlockSums& sums : scratch.block_sums) count += sums.failed;
  if (count == scratch.failed.count) return;
  scratch.failed.count = count;
  for (std::vector<char>& dead : scratch.failed.is_dead) std::fill(dead.begin(), dead.end(), 0);
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (scratch.block_sums[b].failed == 0) continue;
    const ElementBlock& block = *model.blocks[b];
    std::vector<char>& dead = scratch.failed.is_dead[static_cast<std::size_t>(block.kind())];
    dead.resize(model.mesh.table(block.kind()).size(), 0);
    for (int e = 0; e < block.element_count(); ++e)
      if (!block.is_alive(state.history[b], e)) dead[block.mesh_element(e)] = 1;
  }
}

StepReport sum_blocks(const Model& model, State& state, Scratch& scratch) {
  std::fill(scratch.block_sums.begin(), scratch.block_sums.end(), BlockSums{});
  for (std::size_t t = 0; t < model.tiles.tiles.size(); ++t)
    add(scratch.tile_sums[t], scratch.block_sums[model.tiles.tiles[t].block]);

  StepReport limit;
  double least_step = std::numeric_limits<double>::infinity();
  Energies& e = state.energies;
  e.internal = e.hourglass_stored = 0;
  for (int b = 0; b < static_cast<int>(model.blocks.size()); ++b) {
    const BlockSums& sums = scratch.block_sums[b];
    if (sums.inverted_element >= 0)
      throw NumericalError(
          state.time,
          fmt::format("{} has Jacobian {:.3g}", describe_element(model, b, sums.inverted_element),
                      sums.inverted_jacobian));
    e.internal += sums.internal;
    e.hourglass_stored += sums.hourglass;
    e.hourglass_dissipated += sums.hourglass_dissipated;
    e.viscous += sums.viscous_dissipated;
    if (!(sums.least_step < least_step)) continue;
    least_step = sums.least_step;
    limit.critical_block = b;
    limit.critical_element = sums.critical_element;
  }
  if (wants_limit(state)) {
    limit.stable_step = nodal_stable_step(model, state, scratch);
    state.element_limit = limit;
  }
  return state.element_limit;
}

}  // namespace crosswalk::fe
