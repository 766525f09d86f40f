// Hexahedral building blocks: the cubed sphere with its radial layers, and structured blocks.
//
// Equiangular cubed sphere: lattice (i, j, k) in [0, n]^3 with u = 2 i / n - 1 and so on. A surface
// point has the direction normalise(tan(pi/4 (u, v, w))); the planes u = 0, v = 0, w = 0 stay plane
// for even n, which lets mid-sagittal membranes lie on mesh planes. The core is a blend of cube and
// ball so that no corner degenerates (worst corner scaled Jacobian about 0.55 in the unit ball).
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "common/spatial.h"
#include "fe_node/generate/mesh_draft.h"

namespace crosswalk::fe::generate {

class CubedSphere {
 public:
  /// n cells along a cube edge; even and at least 2.
  explicit CubedSphere(int n);

  int n() const { return n_; }
  int surface_size() const { return static_cast<int>(surface_.size()); }
  int core_size() const { return (n_ + 1) * (n_ + 1) * (n_ + 1); }
  /// Lattice point of a surface node.
  const std::array<int, 3>& lattice(int surface_node) const { return surface_[surface_node]; }
  /// Surface node at a lattice point that lies on the cube's surface.
  int surface_index(int i, int j, int k) const { return index_[core_index(i, j, k)]; }
  int core_index(int i, int j, int k) const { return (k * (n_ + 1) + j) * (n_ + 1) + i; }
  /// 6 n^2 quads of surface nodes, counter-clockwise seen from outside.
  const std::vector<std::array<int, 4>>& quads() const { return quads_; }
  /// Unit vector of a surface node.
  const Vec3& direction(int surface_node) const { return direction_[surface_node]; }
  /// Other ones than the equiangular.
  void set_directions(std::vector<Vec3> directions) { direction_ = std::move(directions); }
  /// Node of the core inside the unit ball; the outermost ones lie at radius kCoreRadius.
  Vec3 core_position(int i, int j, int k) const;

  static constexpr double kCoreRadius = 0.65;

 private:
  int n_;
  std::vector<std::array<int, 3>> surface_;
  std::vector<int> index_;
  std::vector<Vec3> direction_;
  std::vector<std::array<int, 4>> quads_;
};

/// Number of radial layers between core and ball surface that keeps cells about cubic.
int radial_layers(int n);

/// Where a cell of a ball is.
struct BallCell {
  Vec3 centroid = Vec3::Zero();  ///< in the unit ball, before mapping
  /// Centre in the lattice of the core, -1 .. 1 along each axis; of a shell cell the one under it
  /// on the core's surface. Planes of it are smooth sheets through core and shell.
  Vec3 lattice = Vec3::Zero();
};

/// Fills the unit ball, mapped by `place`, with n^3 core and 6 n^2 radial_layers(n) shell hexes.
/// Returns the nodes of the outer surface in surface order.
std::vector<int> add_ball(MeshDraft& draft, const CubedSphere& sphere,
                          const std::function<Vec3(const Vec3&)>& place,
                          const std::function<int(const BallCell&)>& part_of);

/// One layer of hexes on top of the selected surface quads. `inner` and the result hold one node
/// per surface node (-1: not meshed); `position` gives the outer node.
std::vector<int> add_layer(MeshDraft& draft, const CubedSphere& sphere,
                           const std::vector<int>& inner,
                           const std::function<bool(int quad)>& is_meshed,
                           const std::function<Vec3(int surface_node)>& position, int part);

/// A structured block of cells (nodes are cells + 1 in each direction). Entries of `node` are mesh
/// nodes or -1 where nothing is meshed.
struct Grid {
  std::array<int, 3> cells{};
  std::vector<int> node;
  Grid() = default;
  explicit Grid(std::array<int, 3> cell_count);
  int& at(int a, int b, int c) { return node[offset(a, b, c)]; }
  int at(int a, int b, int c) const { return node[offset(a, b, c)]; }

 private:
  int offset(int a, int b, int c) const { return (c * (cells[1] + 1) + b) * (cells[0] + 1) + a; }
};

/// A full block whose nodes lie at position(a, b, c); (a, b, c) must be right-handed in space.
Grid add_block(MeshDraft& draft, std::array<int, 3> cells,
               const std::function<Vec3(int, int, int)>& position, int part);

/// Hexes of the cells for which part_of(a, b, c) >= 0, on nodes already in the grid.
void add_cells(MeshDraft& draft, const Grid& grid,
               const std::function<int(int, int, int)>& part_of);

/// The square [-1, 1]^2 onto the unit disc, edges onto the circle, without folding; the corners
/// become points of the circle where cells are flattest (scaled Jacobian falls with refinement
/// there), hence `roundness` < 1 blends back towards a rounded square.
Vec3 square_to_disc(double s, double t, double roundness = 1.0);

/// 0 below a, 1 above b, cubic in between.
double smooth_step(double a, double b, double x);

}  // namespace crosswalk::fe::generate
