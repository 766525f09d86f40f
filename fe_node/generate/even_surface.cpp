#include "fe_node/generate/even_surface.h"

#include <array>
#include <limits>

namespace crosswalk::fe::generate {

namespace {

constexpr double kFirstMove = 0.2, kLeastMove = 0.01;  // of a cell's breadth

class EvenSurface {
 public:
  EvenSurface(const CubedSphere& sphere, const HeadShape& shape)
      : sphere_(sphere), shape_(shape), cells_(sphere.surface_size()) {
    for (int s = 0; s < sphere.surface_size(); ++s) {
      directions_.push_back(sphere.direction(s));
      positions_.push_back(on_skull(directions_[s]));
    }
    for (const std::array<int, 4>& quad : sphere.quads())
      for (int corner = 0; corner < 4; ++corner) cells_[quad[corner]].push_back({quad, corner});
  }

  void sweep(double move) {
    const int middle = sphere_.n() / 2;
    for (int s = 0; s < sphere_.surface_size(); ++s) {
      const auto& [i, j, k] = sphere_.lattice(s);
      if (j > middle) continue;
      try_moves(s, move, j == middle);
      const int mirrored = sphere_.surface_index(i, sphere_.n() - j, k);
      directions_[mirrored] = directions_[s].cwiseProduct(Vec3(1, -1, 1));
      positions_[mirrored] = positions_[s].cwiseProduct(Vec3(1, -1, 1));
    }
  }

  const std::vector<Vec3>& directions() const { return directions_; }

 private:
  struct Cell {
    std::array<int, 4> quad;
    int corner;  ///< at which the node is
  };

  /// From the centre of the cranium.
  Vec3 on_skull(const Vec3& direction) const {
    const HeadShape::Ray ray = shape_.ray(direction);
    return ray.skull_outer * ray.direction;
  }

  void try_moves(int s, double move, bool in_mid_plane) {
    const Vec3 start = directions_[s];
    const Vec3 along = start.cross(Vec3::UnitY()).normalized();
    const Vec3 across = in_mid_plane ? Vec3(Vec3::Zero()) : Vec3(start.cross(along));
    double least = unevenness(s, positions_[s]);
    for (const Vec3& by : {along, Vec3(-along), across, Vec3(-across)}) {
      const Vec3 direction = (start + move * by).normalized(), position = on_skull(direction);
      const double sum = unevenness(s, position);
      if (!(sum < least)) continue;
      least = sum;
      directions_[s] = direction;
      positions_[s] = position;
    }
  }

  /// Of a node's cells with the node at `position`, at the three corners of each that it reaches.
  double unevenness(int s, const Vec3& position) const {
    double sum = 0;
    for (const Cell& cell : cells_[s]) {
      const auto at = [&](int corner) -> const Vec3& {
        return corner % 4 == cell.corner ? position : positions_[cell.quad[corner % 4]];
      };
      for (const int corner : {cell.corner, cell.corner + 1, cell.corner + 3}) {
        const Vec3 a = at(corner + 1) - at(corner), b = at(corner + 3) - at(corner);
        const Vec3 area = a.cross(b);
        if (!(area.dot(position) > 0)) return std::numeric_limits<double>::infinity();
        const double measure = (a.squaredNorm() + b.squaredNorm()) / area.squaredNorm();
        sum += measure * measure * measure;
      }
    }
    return sum;
  }

  const CubedSphere& sphere_;
  const HeadShape& shape_;
  std::vector<std::vector<Cell>> cells_;  ///< of every surface node
  std::vector<Vec3> directions_, positions_;
};

}  // namespace

std::vector<Vec3> even_directions(const CubedSphere& sphere, const HeadShape& shape, int sweeps) {
  EvenSurface surface(sphere, shape);
  for (int i = 0; i < sweeps; ++i) {
    const double share = sweeps > 1 ? static_cast<double>(i) / (sweeps - 1) : 0;
    surface.sweep((kFirstMove + share * (kLeastMove - kFirstMove)) * 2 / sphere.n());
  }
  return surface.directions();
}

}  // namespace crosswalk::fe::generate
