#include "fe_node/generate/spine.h"

#include <cmath>

#include "common/error.h"
#include "common/units.h"
#include "fe_node/generate/discs.h"
#include "fe_node/generate/part_ids.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/generate/quality.h"
#include "fe_node/generate/spine_data.h"

namespace crosswalk::fe::generate {

namespace {

constexpr double kPillarHalf = 0.005;   // articular pillar 10 x 10 mm [E]
constexpr double kProcessHalf = 0.003;  // spinous and transverse processes [E]

/// Grid of an endplate: elliptical outline of the given axes at height z in the body's frame.
Vec3 endplate_point(const SpineBody& body, int i, int j, int n, double share) {
  const Vec3 disc = square_to_disc(2.0 * i / n - 1, 2.0 * j / n - 1, 0.9);
  const double depth = (1 - share) * body.lower_depth + share * body.upper_depth;
  const double width = (1 - share) * body.lower_width + share * body.upper_width;
  return body.at(0.5 * depth * disc.x(), 0.5 * width * disc.y(), (share - 0.5) * body.height);
}

void add_box(MeshDraft& draft, const SpineBody& body, const Vec3& low, const Vec3& high,
             std::array<int, 3> cells) {
  add_block(
      draft, cells,
      [&](int a, int b, int c) {
        const Vec3 share(static_cast<double>(a) / cells[0], static_cast<double>(b) / cells[1],
                         static_cast<double>(c) / cells[2]);
        const Vec3 p = low + share.cwiseProduct(high - low);
        return body.at(p.x(), p.y(), p.z());
      },
      body.part);
}

/// Pillars, transverse bars and the spinous process; drawing and mass only.
void add_posterior_elements(MeshDraft& draft, const Spine& spine, const SpineBody& body) {
  const double s = spine.scale, side = 1e-3 * kFacetSide * s, behind = 1e-3 * kFacetBehind * s;
  const double h = kPillarHalf * s, t = kProcessHalf * s, half_height = 0.4 * body.height;
  for (const int sign : {-1, 1}) {
    const double y = sign * side;
    add_box(draft, body, {-behind - h, y - h, -half_height}, {-behind + h, y + h, half_height},
            {1, 1, 2});
    const double tip = sign * 0.5 * body.transverse;
    const double inner = sign * (side + h);
    add_box(draft, body, {-0.5 * behind - t, std::min(inner, tip), -t},
            {-0.5 * behind + t, std::max(inner, tip), t}, {1, 2, 1});
  }
  const double root = -0.5 * body.depth() - body.canal_depth;
  const double tip = -0.5 * body.depth() - 0.5 * body.canal_depth - body.spinous;
  add_box(draft, body, {tip, -t, -half_height}, {root, t, 0.5 * half_height}, {3, 1, 1});
}

void add_atlas(MeshDraft& draft, const Spine& spine) {
  const SpineBody& body = spine[C1];
  const double s = 1e-3 * spine.scale;
  const double outer_x = 0.5 * kAtlas.ring_depth * s, outer_y = kAtlas.ring_half_width * s;
  const double bar = kAtlas.section * s;
  constexpr int kAround = 16;
  // A closed ring: the last column of cells uses the nodes of the first.
  Grid grid({1, kAround, 1});
  for (int c = 0; c <= 1; ++c)
    for (int b = 0; b < kAround; ++b)
      for (int a = 0; a <= 1; ++a) {
        const double angle = 2 * kPi * b / kAround, in = bar * (1 - a);
        grid.at(a, b, c) = draft.add_node(body.at(
            (outer_x - in) * std::cos(angle), (outer_y - in) * std::sin(angle), bar * (c - 0.5)));
      }
  for (int c = 0; c <= 1; ++c)
    for (int a = 0; a <= 1; ++a) grid.at(a, kAround, c) = grid.at(a, 0, c);
  add_cells(draft, grid, [&](int, int, int) { return body.part; });
  for (const int sign : {-1, 1}) {
    const double y = sign * outer_y, tip = sign * 0.5 * kAtlas.transverse * s;
    add_box(draft, body, {-0.5 * bar, std::min(y, tip), -0.4 * bar},
            {0.5 * bar, std::max(y, tip), 0.4 * bar}, {1, 2, 1});
  }
}

void add_dens(MeshDraft& draft, const Spine& spine) {
  const SpineBody& body = spine[C2];
  const double r = 0.004 * spine.scale, top = 0.5 * body.height;
  add_box(draft, body, {-r, -r, top}, {r, r, top + kDensHeight * body.size.z()}, {1, 1, 2});
}

PartSpec rigid_spec(int id, const std::string& name, double density, const std::string& source) {
  return {.id = id,
          .name = name,
          .density = density,
          .law = mat::Rigid{.youngs = 10e9, .poisson = 0.3},
          .section = SolidSection{},
          .source = source,
          .grade = Grade::Estimate};
}

double part_volume(const MeshDraft& mesh, int part) {
  double sum = 0;
  for (const Hex& hex : mesh.hexes)
    if (hex.part == part) sum += volume(corners_of(mesh, hex));
  return sum;
}

/// Reference mm in N to m: by stature up to the neck's base, stretched and sheared above it.
struct ChainMap {
  double scale = 1;  ///< of stature
  Vec3 base_mm = Vec3::Zero();
  double along_z = 1e-3, shear = 0;  ///< m of z and of x per mm of z, above the base
  double lean = 0;                   ///< rad, forward tilt that the shear adds

  Vec3 operator()(double x, double z) const {
    const double s = 1e-3 * scale, above = z - base_mm.z();
    if (above <= 0) return {s * x, 0, s * z};
    return {s * x + shear * above, 0, s * base_mm.z() + along_z * above};
  }
  Vec3 size(double z) const {
    const double s = 1e-3 * scale;
    return {s, s, z > base_mm.z() ? along_z : s};
  }
};

SpineBody body_of(const VertebraData& data, int part, const ChainMap& map) {
  const double s = 1e-3 * map.scale, scale = map.scale;
  const bool is_neck = data.z > map.base_mm.z();
  const double tilt = data.tilt_deg * kDegree + (is_neck ? map.lean : 0);
  SpineBody body{.part = part, .name = data.name};
  body.X_NB = {exp_rotation(Vec3(0, tilt, 0)), map(data.x, data.z)};
  body.size = map.size(data.z);
  body.height = body.size.z() * data.height;
  body.upper_width = s * data.upper_width;
  body.lower_width = s * data.lower_width;
  body.upper_depth = s * data.upper_depth;
  body.lower_depth = s * data.lower_depth;
  body.canal_depth = s * data.canal_depth;
  body.spinous = s * data.spinous;
  body.transverse = s * data.transverse;
  body.facet_angle = data.facet_deg * kDegree;
  body.facet_medial = data.facet_medial_deg * kDegree;
  body.mass = data.mass_kg * scale * scale * scale;
  return body;
}

/// Middle between the endplates of C7 and T1 of the reference chain, mm.
Vec3 reference_base() {
  const auto endplate = [](const VertebraData& v, double end) -> Vec3 {
    const double tilt = v.tilt_deg * kDegree;
    return Vec3(v.x, 0, v.z) + end * v.height * Vec3(std::sin(tilt), 0, std::cos(tilt));
  };
  return 0.5 * (endplate(kVertebrae[C7 - C2], -0.5) + endplate(kVertebrae[T1 - C2], 0.5));
}

ChainMap chain_map(double stature, const Vec3& base_to_condyles) {
  ChainMap map{.scale = stature / kReferenceStature, .base_mm = reference_base()};
  const double height = kCondyleZ - map.base_mm.z(), forward = kCondyleX - map.base_mm.x();
  map.along_z = base_to_condyles.z() / height;
  map.shear = (base_to_condyles.x() - 1e-3 * map.scale * forward) / height;
  map.lean = std::atan2(map.shear, map.along_z);
  return map;
}

}  // namespace

Vec3 SpineBody::spinous_tip() const {
  return at(-0.5 * depth() - 0.5 * canal_depth - spinous, 0, -0.2 * height);
}

Vec3 SpineBody::transverse_tip(int side) const {
  return at(-0.5 * depth(), side * 0.5 * transverse, 0);
}

Vec3 Spine::disc_centre(Level upper) const {
  const SpineBody &u = bodies[upper], &l = bodies[upper + 1];
  return 0.5 * (u.at(0, 0, -0.5 * u.height) + l.at(0, 0, 0.5 * l.height));
}

Vec3 Spine::facet_centre(Level upper, int side) const {
  const Mat3 R = bodies[upper + 1].X_NB.R();
  return disc_centre(upper) +
         R * Vec3(-1e-3 * kFacetBehind * scale, side * 1e-3 * kFacetSide * scale, 0);
}

Vec3 Spine::facet_normal(Level upper, int side) const {
  const SpineBody& l = bodies[upper + 1];
  const double steep = std::sin(l.facet_angle);
  return l.X_NB.R() * Vec3(-steep * std::cos(l.facet_medial),
                           -side * steep * std::sin(l.facet_medial), std::cos(l.facet_angle));
}

Vec3 neck_base(double stature) { return 1e-3 * stature / kReferenceStature * reference_base(); }

Vec3 reference_neck(double stature) {
  return 1e-3 * stature / kReferenceStature * (Vec3(kCondyleX, 0, kCondyleZ) - reference_base());
}

Spine spine_of(double stature, const Vec3& base_to_condyles, const Vec3& tragion,
               const Vec3& head_scale) {
  const ChainMap map = chain_map(stature, base_to_condyles);
  Spine spine{.scale = map.scale, .tragion = tragion, .bodies = {}};
  const double s = 1e-3 * spine.scale;
  SpineBody occiput{.part = part::kFirstVertebra - 10, .name = "C0"};
  occiput.size = 1e-3 * head_scale;
  occiput.X_NB.p = map(kCondyleX, kCondyleZ) -
                   occiput.size.cwiseProduct(Vec3(kCondyleFrankfurtX, 0, kCondyleFrankfurtZ));
  spine.bodies.push_back(occiput);
  SpineBody atlas{.part = part::kFirstVertebra, .name = "C1"};
  atlas.X_NB = {exp_rotation(Vec3(0, map.lean, 0)), map(kAtlas.x, kAtlas.z)};
  atlas.size = map.size(kAtlas.z);
  atlas.height = 10 * atlas.size.z();
  atlas.upper_depth = atlas.lower_depth = s * kAtlas.ring_depth;
  atlas.upper_width = atlas.lower_width = 2 * s * kAtlas.ring_half_width;
  atlas.transverse = s * kAtlas.transverse;
  atlas.mass = kAtlas.mass_kg * std::pow(spine.scale, 3);
  spine.bodies.push_back(atlas);
  int part = part::kFirstVertebra + 10;
  for (const VertebraData& data : kVertebrae) {
    const bool in_block = data.z < -1;  // T2 and T3
    spine.bodies.push_back(body_of(data, in_block ? part::kBlockTorsoUp : part, map));
    part += 10;
  }
  return spine;
}

void add_spine(ModelDraft& draft, const Spine& spine, const SpineResolution& resolution) {
  MeshDraft& mesh = draft.mesh;
  const int n = resolution.plan;
  add_atlas(mesh, spine);
  add_dens(mesh, spine);
  Grid above;
  for (int level = C2; level <= T3; ++level) {
    const SpineBody& body = spine.bodies[level];
    const Grid grid = add_block(
        mesh, {n, n, resolution.body_layers},
        [&](int a, int b, int c) {
          return endplate_point(body, a, b, n, static_cast<double>(c) / resolution.body_layers);
        },
        body.part);
    add_posterior_elements(mesh, spine, body);
    if (level > C2) {
      const SpineBody& upper = spine.bodies[level - 1];
      const bool in_one_block = upper.part == body.part;
      const int part = in_one_block ? body.part : part::kFirstDisc + 10 * (level - C3);
      Grid disc({n, n, resolution.disc_layers});
      for (int c = 0; c <= resolution.disc_layers; ++c)
        for (int b = 0; b <= n; ++b)
          for (int a = 0; a <= n; ++a) {
            const int low = grid.at(a, b, resolution.body_layers), high = above.at(a, b, 0);
            const double share = static_cast<double>(c) / resolution.disc_layers;
            disc.at(a, b, c) =
                c == 0 ? low
                : c == resolution.disc_layers
                    ? high
                    : mesh.add_node((1 - share) * mesh.nodes[low] + share * mesh.nodes[high]);
          }
      add_cells(mesh, disc, [part](int, int, int) { return part; });
      if (!in_one_block) draft.parts.push_back(disc_ground(part, "disc_" + upper.name + body.name));
    }
    above = grid;
  }
  for (int level = C1; level <= T1; ++level) {
    const SpineBody& body = spine.bodies[level];
    draft.parts.push_back(rigid_spec(body.part, body.name, body.mass / part_volume(mesh, body.part),
                                     "mass with arch and canal contents"));
  }
  const double block_mass = spine[T2].mass + spine[T3].mass;
  draft.parts.push_back(rigid_spec(part::kBlockTorsoUp, "block_torso_up",
                                   block_mass / part_volume(mesh, part::kBlockTorsoUp),
                                   "T2 and T3"));
}

}  // namespace crosswalk::fe::generate
