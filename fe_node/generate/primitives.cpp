#include "fe_node/generate/primitives.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/units.h"

namespace crosswalk::fe::generate {

namespace {

// Core shape: how strongly the cube is rounded, and its size relative to the inscribed one; chosen
// so that core and shell cells are about equally large.
constexpr double kCoreRounding = 0.45;
constexpr double kCoreFill = 1.5;

Vec3 lattice_cube(const std::array<int, 3>& p, int n) {
  return {2.0 * p[0] / n - 1.0, 2.0 * p[1] / n - 1.0, 2.0 * p[2] / n - 1.0};
}

Vec3 equiangular(const Vec3& cube) {
  const double s = cube.cwiseAbs().maxCoeff();
  if (s == 0.0) return Vec3::Zero();
  Vec3 t;
  for (int axis = 0; axis < 3; ++axis) t[axis] = std::tan(0.25 * kPi * cube[axis] / s);
  return t.normalized();
}

}  // namespace

CubedSphere::CubedSphere(int n) : n_(n) {
  CW_ASSERT(n >= 2 && n % 2 == 0);
  index_.assign(core_size(), -1);
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        if (i % n != 0 && j % n != 0 && k % n != 0) continue;
        index_[core_index(i, j, k)] = surface_size();
        surface_.push_back({i, j, k});
        direction_.push_back(equiangular(lattice_cube(surface_.back(), n)));
      }
  // The two lattice directions of each face turn towards the outside: e_a x e_b = outward normal.
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (int q = 0; q < n; ++q)
        for (int p = 0; p < n; ++p) {
          const auto corner = [&](int da, int db) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[a] = p + da;
            at[b] = q + db;
            return surface_index(at[0], at[1], at[2]);
          };
          std::array<int, 4> quad{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::swap(quad[1], quad[3]);
          quads_.push_back(quad);
        }
    }
}

Vec3 CubedSphere::core_position(int i, int j, int k) const {
  const Vec3 cube = lattice_cube({i, j, k}, n_);
  const double s = cube.cwiseAbs().maxCoeff();
  const double fill = kCoreFill / std::sqrt(3.0);
  return kCoreRadius *
         ((1.0 - kCoreRounding * s) * fill * cube + kCoreRounding * s * s * equiangular(cube));
}

int radial_layers(int n) { return std::max(2, static_cast<int>(std::lround(0.22 * n))); }

std::vector<int> add_ball(MeshDraft& draft, const CubedSphere& sphere,
                          const std::function<Vec3(const Vec3&)>& place,
                          const std::function<int(const BallCell&)>& part_of) {
  const int n = sphere.n();
  std::vector<Vec3> unit;  // unit-ball position of every node added here
  const int first = static_cast<int>(draft.nodes.size());
  const auto add = [&](const Vec3& position) {
    unit.push_back(position);
    return draft.add_node(place(position));
  };
  const auto add_hex = [&](const std::array<int, 8>& node, const Vec3& lattice) {
    BallCell cell{.lattice = lattice};
    for (const int id : node) cell.centroid += unit[id - first] / 8.0;
    draft.hexes.push_back({node, part_of(cell)});
  };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) add(sphere.core_position(i, j, k));
  const auto core = [&](int i, int j, int k) { return first + sphere.core_index(i, j, k); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        add_hex({core(i, j, k), core(i + 1, j, k), core(i + 1, j + 1, k), core(i, j + 1, k),
                 core(i, j, k + 1), core(i + 1, j, k + 1), core(i + 1, j + 1, k + 1),
                 core(i, j + 1, k + 1)},
                0.5 * (lattice_cube({i, j, k}, n) + lattice_cube({i + 1, j + 1, k + 1}, n)));
  std::vector<int> inner(sphere.surface_size());
  for (int s = 0; s < sphere.surface_size(); ++s) {
    const auto& p = sphere.lattice(s);
    inner[s] = core(p[0], p[1], p[2]);
  }
  const std::vector<int> core_surface = inner;
  const int layers = radial_layers(n);
  for (int layer = 1; layer <= layers; ++layer) {
    const double f = static_cast<double>(layer) / layers;
    std::vector<int> outer(inner.size());
    for (int s = 0; s < sphere.surface_size(); ++s)
      outer[s] = add((1.0 - f) * unit[core_surface[s] - first] + f * sphere.direction(s));
    for (const auto& quad : sphere.quads())
      add_hex({inner[quad[0]], inner[quad[1]], inner[quad[2]], inner[quad[3]], outer[quad[0]],
               outer[quad[1]], outer[quad[2]], outer[quad[3]]},
              0.5 * (lattice_cube(sphere.lattice(quad[0]), n) +
                     lattice_cube(sphere.lattice(quad[2]), n)));
    inner = outer;
  }
  return inner;
}

std::vector<int> add_layer(MeshDraft& draft, const CubedSphere& sphere,
                           const std::vector<int>& inner, const std::function<bool(int)>& is_meshed,
                           const std::function<Vec3(int)>& position, int part) {
  std::vector<int> outer(inner.size(), -1);
  const auto& quads = sphere.quads();
  for (int q = 0; q < static_cast<int>(quads.size()); ++q) {
    if (!is_meshed(q)) continue;
    Hex hex{{}, part};
    for (int c = 0; c < 4; ++c) {
      const int s = quads[q][c];
      CW_ASSERT(inner[s] >= 0);
      if (outer[s] < 0) outer[s] = draft.add_node(position(s));
      hex.node[c] = inner[s];
      hex.node[c + 4] = outer[s];
    }
    draft.hexes.push_back(hex);
  }
  return outer;
}

Grid::Grid(std::array<int, 3> cell_count)
    : cells(cell_count), node((cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1), -1) {}

Grid add_block(MeshDraft& draft, std::array<int, 3> cells,
               const std::function<Vec3(int, int, int)>& position, int part) {
  Grid grid(cells);
  for (int c = 0; c <= cells[2]; ++c)
    for (int b = 0; b <= cells[1]; ++b)
      for (int a = 0; a <= cells[0]; ++a) grid.at(a, b, c) = draft.add_node(position(a, b, c));
  add_cells(draft, grid, [part](int, int, int) { return part; });
  return grid;
}

void add_cells(MeshDraft& draft, const Grid& grid,
               const std::function<int(int, int, int)>& part_of) {
  for (int c = 0; c < grid.cells[2]; ++c)
    for (int b = 0; b < grid.cells[1]; ++b)
      for (int a = 0; a < grid.cells[0]; ++a) {
        const int part = part_of(a, b, c);
        if (part < 0) continue;
        Hex hex{{grid.at(a, b, c), grid.at(a + 1, b, c), grid.at(a + 1, b + 1, c),
                 grid.at(a, b + 1, c), grid.at(a, b, c + 1), grid.at(a + 1, b, c + 1),
                 grid.at(a + 1, b + 1, c + 1), grid.at(a, b + 1, c + 1)},
                part};
        for (const int id : hex.node) CW_ASSERT(id >= 0);
        draft.hexes.push_back(hex);
      }
}

// Elliptical grid mapping [fong2015]: x = s sqrt(1 - t^2/2), y = t sqrt(1 - s^2/2), blended with
// the square itself.
Vec3 square_to_disc(double s, double t, double roundness) {
  const double x = s * std::sqrt(1.0 - 0.5 * t * t), y = t * std::sqrt(1.0 - 0.5 * s * s);
  return {roundness * x + (1.0 - roundness) * s, roundness * y + (1.0 - roundness) * t, 0.0};
}

double smooth_step(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace crosswalk::fe::generate
