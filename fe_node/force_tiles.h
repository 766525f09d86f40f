// How element corner forces are added up on nodes: the same bits for any number of threads, and
// little memory traffic.
//
// The elements of a block are cut into tiles of neighbours in their order. One thread adds all
// corners of a tile into the tile's own rows, one per node it touches, which stay in the nearest
// cache meanwhile; afterwards every node adds its rows in the order of the tiles. Most nodes lie
// inside one tile, so about 1.6 rows a brick travel through memory instead of eight corners. Tiles
// of all blocks go in the order of their nodes, so that those at one place are near each other in
// time, and a thread that works on nodes works on their tiles.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fe_node/element/element_block.h"

namespace crosswalk::fe {

/// Corners of so many groups pass from a kernel to the rows at once.
inline constexpr int kGroupsPerCall = 32 / kLanes;

struct ForceTile {
  int block = 0, first = 0, last = 0;  ///< lane groups [first, last)
  int node_count = 0;                  ///< rows; one more behind them takes the padded lanes
  std::size_t corner = 0;              ///< of its first corner in ForceTiles::row_of_corner
  std::size_t force_row = 0;           ///< its first row among the force rows
  std::size_t moment_row = 0;          ///< likewise, of blocks with moments
  int call = 0;                        ///< number of its first call
  double cost = 0;                     ///< visits of the law
};

/// The rows of every node, in the order they are added.
struct NodeRows {
  std::vector<int> begin;          ///< node_count + 1 offsets into `row`
  std::vector<std::uint32_t> row;  ///< kCornerStride doubles each
};

struct ForceTiles {
  std::vector<ForceTile> tiles;
  /// Row within its tile of every corner, padded lanes included, in the order of corner_slot().
  std::vector<std::uint16_t> row_of_corner;
  NodeRows force_rows, moment_rows;
  /// Nodes in the order the kernels meet them, each once a tile, and where those of every call
  /// begin: they are fetched one call ahead, as the processor cannot foresee them.
  std::vector<int> arrivals, arrivals_begin;
  std::size_t force_row_count = 0, moment_row_count = 0;
};

ForceTiles make_force_tiles(std::span<const std::unique_ptr<const ElementBlock>> blocks,
                            int node_count);

/// Adds `count` corners to their rows, in their order.
void add_corners(const double* corners, const std::uint16_t* row_of_corner, int count,
                 double* rows);

using ForceRow = Eigen::Map<const Eigen::Vector4d, Eigen::Aligned32>;

/// Sum of a node's rows: what acts on it.
inline Vec3 sum_of_rows(const NodeRows& table, const double* rows, int node) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int k = table.begin[node]; k < table.begin[node + 1]; ++k)
    sum += ForceRow(rows + std::size_t{kCornerStride} * table.row[k]);
  return sum.head<3>();
}

/// Sum of the stiffnesses that came with them.
inline double stiffness_of_rows(const NodeRows& table, const double* rows, int node) {
  double sum = 0;
  for (int k = table.begin[node]; k < table.begin[node + 1]; ++k)
    sum += rows[std::size_t{kCornerStride} * table.row[k] + kCornerStiffness];
  return sum;
}

}  // namespace crosswalk::fe
