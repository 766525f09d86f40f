// Rigid vertebrae C1 to T3 and the occiput, with discs on shared endplate nodes. Frame N
// (spine_data.h), metres.
//
// T2 and T3 belong to the torso block. The occiput is a rigid patch of the skull base that carries
// condyles, ligaments and muscle origins.
//
// Widths, depths and everything below the C7-T1 disc grow with stature. The chain above it is
// stretched along z and sheared along x until its condyles lie where the subject has them; the
// vertebrae take their heights and tilts from the same map.
#pragma once

#include <string>
#include <vector>

#include "fe_node/generate/part_spec.h"

namespace crosswalk::fe::generate {

enum Level { C0, C1, C2, C3, C4, C5, C6, C7, T1, T2, T3 };
inline constexpr int kLevels = 11;

/// One rigid body of the spine with its own axes: x forward, z along the body axis.
struct SpineBody {
  int part = 0;
  std::string name;
  Pose X_NB;
  double height = 0;
  double upper_width = 0, lower_width = 0, upper_depth = 0, lower_depth = 0;
  double canal_depth = 0, spinous = 0, transverse = 0;
  double facet_angle = 0;   ///< of the upper facets to the transverse plane, rad
  double facet_medial = 0;  ///< by which they face the mid-plane, rad
  double mass = 0;
  Vec3 size = Vec3::Constant(1e-3);  ///< own axes: m per reference mm
  Vec3 at(double x, double y, double z) const { return X_NB * Vec3(x, y, z); }
  /// The same for a point of the reference vertebra, mm.
  Vec3 at_reference(double x, double y, double z) const {
    return X_NB * Vec3(size.cwiseProduct(Vec3(x, y, z)));
  }
  double depth() const { return 0.5 * (upper_depth + lower_depth); }
  double width() const { return 0.5 * (upper_width + lower_width); }
  /// Tips of the processes, N.
  Vec3 spinous_tip() const;
  Vec3 transverse_tip(int side) const;  ///< side: 1 left, -1 right
};

struct Spine {
  double scale = 1;               ///< stature over that of the landmarks
  Vec3 tragion = Vec3::Zero();    ///< origin of the Frankfurt frame, N
  std::vector<SpineBody> bodies;  ///< by Level
  const SpineBody& operator[](Level level) const { return bodies[level]; }
  /// Centre of the disc below a vertebra, N.
  Vec3 disc_centre(Level upper) const;
  /// Centre and outward normal (up and back) of the facet joint below a vertebra, N; side: 1 left.
  Vec3 facet_centre(Level upper, int side) const;
  Vec3 facet_normal(Level upper, int side) const;
};

/// Centre of the C7-T1 disc, N: the multibody C7/T1 joint.
Vec3 neck_base(double stature);
/// Condyles from the neck's base by stature alone.
Vec3 reference_neck(double stature);
/// Positions and sizes for a stature (m) and the way from the neck's base to the condyles. The
/// occiput's frame is that Frankfurt frame of the reference head whose condyles lie there, so that
/// what hangs on the skull base stays with them; `head_scale` is that of the head.
Spine spine_of(double stature, const Vec3& base_to_condyles, const Vec3& tragion,
               const Vec3& head_scale);

struct SpineResolution {
  int plan = 4;         ///< cells across an endplate, even
  int body_layers = 2;  ///< along a vertebral body
  int disc_layers = 1;
};

/// Meshes vertebrae and discs; adds their parts with the densities that give the stated masses.
void add_spine(ModelDraft& draft, const Spine& spine, const SpineResolution& resolution);

}  // namespace crosswalk::fe::generate
