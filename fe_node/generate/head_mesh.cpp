#include "fe_node/generate/head_mesh.h"

#include <algorithm>
#include <cmath>

#include "fe_node/generate/even_surface.h"
#include "fe_node/generate/part_ids.h"

namespace crosswalk::fe::generate {

namespace {

using Radius = double HeadShape::Ray::*;

/// Position on the ray of a surface node, `share` of the way from one layer surface to another.
auto between(const CubedSphere& sphere, const HeadShape& shape, double share, Radius from,
             Radius to) {
  return [&sphere, &shape, share, from, to](int s) -> Vec3 {
    const HeadShape::Ray ray = shape.ray(sphere.direction(s));
    return shape.centre() + ray.direction * ((1 - share) * ray.*from + share * ray.*to);
  };
}

/// Surface directions that follow the middle of the cranium half as far as the inside does.
std::vector<Vec3> lifted_directions(const CubedSphere& sphere, const HeadShape& shape,
                                    double lift) {
  std::vector<Vec3> directions;
  for (int s = 0; s < sphere.surface_size(); ++s) {
    Vec3 u = sphere.direction(s);
    const double height = shape.middle_z(u.x()) / shape.half_height(u.x());
    u.z() += 0.5 * lift * height * (1 - u.z() * u.z());
    directions.push_back(u.normalized());
  }
  return directions;
}

constexpr double kMeanInwards = 0.84;  ///< brain surface over skin, seen from the centre

// The cerebellum in the lattice of the ball, so that the tentorium above it is a smooth sheet.
// Shares wanted: cerebellum 11 %, brainstem 2 to 2.5 % of the brain [caviness1996]; the bounds are
// estimates [E] that give them within the cell size.
constexpr double kCerebellumTop = -0.25, kCerebellumFront = -0.25;

/// Region of a brain cell by its place in the ball's lattice and its centroid in F.
int brain_part(const Vec3& lattice, const Vec3& p, const Vec3& scale) {
  const Vec3 q = p.cwiseQuotient(scale);
  const bool left = q.y() > 0;
  if (std::abs(q.y()) < 0.0135 && q.x() > -0.026 && q.x() < 0.004 && q.z() < 0.025)
    return part::kBrainstem;
  if (lattice.z() < kCerebellumTop && lattice.x() < kCerebellumFront)
    return left ? part::kCerebellumLeft : part::kCerebellumRight;
  return left ? part::kCerebrumLeft : part::kCerebrumRight;
}

}  // namespace

HeadMesh add_cranium(MeshDraft& draft, const HeadShape& shape, const HeadResolution& resolution) {
  HeadMesh head{
      .sphere = CubedSphere(resolution.n), .skull_inner = {}, .skull_outer = {}, .skin = {}};
  CubedSphere& sphere = head.sphere;
  if (resolution.lift > 0) sphere.set_directions(lifted_directions(sphere, shape, resolution.lift));
  if (resolution.even_sweeps > 0)
    sphere.set_directions(even_directions(sphere, shape, resolution.even_sweeps));
  const auto place = [&](const Vec3& p) -> Vec3 {
    const double radius = p.norm();
    const HeadShape::Ray ray = shape.ray(radius > 0 ? Vec3(p / radius) : Vec3::UnitX());
    const double at_surface = ray.brain / ray.skin;
    // A factor that depends on direction alone would tear the cells at the centre.
    const double inwards = kMeanInwards + (at_surface - kMeanInwards) * radius * radius;
    const double lift = resolution.lift * shape.middle_z(p.x()) * (1 - radius * radius);
    return shape.centre() + inwards * shape.spread(p) + Vec3(0, 0, lift);
  };
  const std::vector<int> brain_surface = add_ball(draft, sphere, place, [&](const BallCell& cell) {
    return brain_part(cell.lattice, place(cell.centroid), shape.scale());
  });
  const auto everywhere = [](int) { return true; };
  const HeadStrip strip(sphere);
  const auto off_strip = [&strip](int quad) { return !strip.holds_quad(quad); };
  const auto grow = [&](std::vector<int> nodes, int layers, Radius from, Radius to,
                        const auto& where, int part) {
    for (int layer = 1; layer <= layers; ++layer)
      nodes =
          add_layer(draft, sphere, nodes, where,
                    between(sphere, shape, static_cast<double>(layer) / layers, from, to), part);
    return nodes;
  };
  using Ray = HeadShape::Ray;
  head.skull_inner = grow(brain_surface, resolution.csf_layers, &Ray::brain, &Ray::skull_inner,
                          everywhere, part::kCsf);
  head.skull_outer = grow(head.skull_inner, resolution.skull_layers, &Ray::skull_inner,
                          &Ray::skull_outer, everywhere, part::kDiploe);
  head.skin = grow(head.skull_outer, resolution.scalp_layers, &Ray::skull_outer, &Ray::skin,
                   off_strip, part::kScalp);
  return head;
}

HeadStrip::HeadStrip(const CubedSphere& sphere)
    : sphere_(&sphere), front_rows_((sphere.n() + 2) / 4) {
  const int n = sphere.n();
  rows = n + front_rows_;
  columns = n;
  face_row = n / 2;
  for (const auto& quad : sphere.quads()) {
    bool bottom = true, front = true;
    for (const int s : quad) {
      bottom = bottom && sphere.lattice(s)[2] == 0;
      front = front && sphere.lattice(s)[0] == n && sphere.lattice(s)[2] <= front_rows_;
    }
    in_strip.push_back(bottom || front);
  }
}

int HeadStrip::node(int row, int column) const {
  const int n = sphere_->n();
  return row <= n ? sphere_->surface_index(row, column, 0)
                  : sphere_->surface_index(n, column, row - n);
}

}  // namespace crosswalk::fe::generate
