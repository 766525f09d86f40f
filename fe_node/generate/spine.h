// Rigid vertebrae C1 to T3 and the occiput, with discs on shared endplate nodes. Frame N
// (spine_data.h), metres.
//
// T2 and T3 belong to the torso block. The occiput is a rigid patch of the skull base that carries
// condyles, ligaments and muscle origins.
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
  double facet_angle = 0;  ///< rad
  double mass = 0;
  Vec3 at(double x, double y, double z) const { return X_NB * Vec3(x, y, z); }
  double depth() const { return 0.5 * (upper_depth + lower_depth); }
  double width() const { return 0.5 * (upper_width + lower_width); }
  /// Tips of the processes, N.
  Vec3 spinous_tip() const;
  Vec3 transverse_tip(int side) const;  ///< side: 1 left, -1 right
};

struct Spine {
  double scale = 1;               ///< stature over that of the landmarks
  std::vector<SpineBody> bodies;  ///< by Level
  const SpineBody& operator[](Level level) const { return bodies[level]; }
  /// Centre of the disc below a vertebra, N.
  Vec3 disc_centre(Level upper) const;
  /// Centre and outward normal (up and back) of the facet joint below a vertebra, N.
  Vec3 facet_centre(Level upper, int side) const;
  Vec3 facet_normal(Level upper) const;
};

/// Positions and sizes for a stature (m); the occiput's frame is the Frankfurt frame at `tragion`.
Spine spine_of(double stature, const Vec3& tragion);

struct SpineResolution {
  int plan = 4;         ///< cells across an endplate, even
  int body_layers = 2;  ///< along a vertebral body
  int disc_layers = 1;
};

/// Meshes vertebrae and discs; adds their parts with the densities that give the stated masses.
void add_spine(ModelDraft& draft, const Spine& spine, const SpineResolution& resolution);

}  // namespace crosswalk::fe::generate
