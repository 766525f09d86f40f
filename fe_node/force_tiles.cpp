#include "fe_node/force_tiles.h"

#include <algorithm>
#include <utility>

#include "common/error.h"

namespace crosswalk::fe {
namespace {

/// Larger tiles share fewer nodes; the rows of 256 bricks, 14 kB, still fit the nearest cache. Of
/// elements with many points a tile takes fewer, so that the last one keeps no thread waiting long.
constexpr int kPointsPerTile = 256;

using Row = Eigen::Map<Eigen::Vector4d, Eigen::Aligned32>;

/// The tiles of all blocks in the order of the mean of their nodes' indices.
std::vector<ForceTile> cut_into_tiles(std::span<const std::unique_ptr<const ElementBlock>> blocks) {
  std::vector<std::pair<double, ForceTile>> found;
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
    const ElementBlock& block = *blocks[b];
    const int groups = std::max(1, kPointsPerTile / kLanes / block.points());
    for (int first = 0; first < block.group_count(); first += groups) {
      ForceTile tile{b, first, std::min(first + groups, block.group_count())};
      tile.cost = (tile.last - first) * block.points();
      double sum = 0;
      for (int group = first; group < tile.last; ++group)
        for (int c = 0; c < block.corners(); ++c)
          for (int lane = 0; lane < kLanes; ++lane) sum += block.node(group, c, lane);
      found.emplace_back(sum / ((tile.last - first) * block.corners()), tile);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ForceTile> tiles;
  for (const auto& [place, tile] : found) tiles.push_back(tile);
  return tiles;
}

/// Sorted nodes of the corners of a tile. Appends them to the arrivals, `seen` holds the last tile
/// that met each node.
std::vector<int> nodes_of(const ElementBlock& block, const ForceTile& tile, int number,
                          std::vector<int>& seen, ForceTiles& out) {
  std::vector<int> nodes;
  for (int first = tile.first; first < tile.last; first += kGroupsPerCall) {
    out.arrivals_begin.push_back(static_cast<int>(out.arrivals.size()));
    for (int group = first; group < std::min(first + kGroupsPerCall, tile.last); ++group)
      for (int c = 0; c < block.corners(); ++c)
        for (int lane = 0; lane < kLanes; ++lane) {
          const int node = block.node(group, c, lane);
          if (std::exchange(seen[node], number) == number) continue;
          nodes.push_back(node);
          out.arrivals.push_back(node);
        }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Turns (node, row) pairs, rows rising, into a table.
NodeRows table_of(const std::vector<std::pair<int, std::uint32_t>>& pairs, int node_count) {
  NodeRows table;
  table.begin.assign(node_count + 1, 0);
  for (const auto& [node, row] : pairs) ++table.begin[node + 1];
  for (int n = 0; n < node_count; ++n) table.begin[n + 1] += table.begin[n];
  table.row.resize(pairs.size());
  std::vector<int> next(table.begin.begin(), table.begin.end() - 1);
  for (const auto& [node, row] : pairs) table.row[next[node]++] = row;
  return table;
}

}  // namespace

ForceTiles make_force_tiles(std::span<const std::unique_ptr<const ElementBlock>> blocks,
                            int node_count) {
  ForceTiles out;
  std::vector<std::pair<int, std::uint32_t>> force_rows, moment_rows;
  std::vector<int> seen(node_count, -1);
  for (ForceTile tile : cut_into_tiles(blocks)) {
    const ElementBlock& block = *blocks[tile.block];
    tile.call = static_cast<int>(out.arrivals_begin.size());
    const std::vector<int> nodes =
        nodes_of(block, tile, static_cast<int>(out.tiles.size()), seen, out);
    tile.node_count = static_cast<int>(nodes.size());
    CW_ASSERT(tile.node_count < 1 << 16);
    tile.corner = out.row_of_corner.size();
    tile.force_row = out.force_row_count;
    tile.moment_row = out.moment_row_count;
    for (int group = tile.first; group < tile.last; ++group)
      for (int c = 0; c < block.corners(); ++c)
        for (int lane = 0; lane < kLanes; ++lane) {
          const auto at = std::lower_bound(nodes.begin(), nodes.end(), block.node(group, c, lane));
          const bool is_real = group * kLanes + lane < block.element_count();
          out.row_of_corner.push_back(
              static_cast<std::uint16_t>(is_real ? at - nodes.begin() : tile.node_count));
        }
    for (int i = 0; i < tile.node_count; ++i) {
      force_rows.emplace_back(nodes[i], static_cast<std::uint32_t>(tile.force_row + i));
      if (block.has_moments())
        moment_rows.emplace_back(nodes[i], static_cast<std::uint32_t>(tile.moment_row + i));
    }
    out.force_row_count += tile.node_count + 1;
    if (block.has_moments()) out.moment_row_count += tile.node_count + 1;
    out.tiles.push_back(tile);
  }
  for (int end = 0; end < 2; ++end)  // there is a call behind the last one: it meets nothing
    out.arrivals_begin.push_back(static_cast<int>(out.arrivals.size()));
  CW_ASSERT(out.force_row_count < std::size_t{1} << 32);
  out.force_rows = table_of(force_rows, node_count);
  out.moment_rows = table_of(moment_rows, node_count);
  return out;
}

void add_corners(const double* corners, const std::uint16_t* row_of_corner, int count,
                 double* rows) {
  for (int k = 0; k < count; ++k)
    Row(rows + std::size_t{kCornerStride} * row_of_corner[k]) +=
        ForceRow(corners + std::size_t{kCornerStride} * k);
}

}  // namespace crosswalk::fe
