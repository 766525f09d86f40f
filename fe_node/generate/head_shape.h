// Outer surface, layer thicknesses and face outline of a head from three body measures.
//
// Frame F (Frankfurt): origin midway between the two tragions, x forward, y left, z up; metres.
// The cranium is an ellipsoid with different half-axes upwards, towards the posterior and the
// anterior fossa; an inner surface lies the local layer thickness below it, along the ray from the
// cranial centre. Proportions are estimates [E] set against head survey means (197 x 155 x 226 mm)
// [gordon1989], and an intracranial volume of 1469 +- 102 cm3 for men [matsumae1996]; thicknesses
// [E] follow the layer medians of [zwirner2021]. Layers do not grow with the head.
#pragma once

#include "common/spatial.h"

namespace crosswalk::fe::generate {

struct HeadMeasures {
  double length = 0.197;       ///< glabella to occiput, m
  double breadth = 0.155;      ///< m
  double chin_height = 0.226;  ///< vertex to menton, m
};

class HeadShape {
 public:
  explicit HeadShape(const HeadMeasures& measures);

  const HeadMeasures& measures() const { return measures_; }
  /// Factors on the reference head: along x, y and z (z without the chin).
  const Vec3& scale() const { return scale_; }
  Vec3 centre() const { return {0, 0, 0.040 * scale_.z()}; }
  double menton_z() const { return 0.130 * scale_.z() - measures_.chin_height; }

  /// Maps the unit ball onto the solid cranium, relative to the centre; the unit sphere becomes the
  /// skin.
  Vec3 spread(const Vec3& unit_ball_point) const;
  /// Height above the centre of the middle between roof and floor, and half their distance, over
  /// the lengthwise position in the unit ball, m.
  double middle_z(double ux) const {
    return 0.5 * (half_axis_z(ux, true) - half_axis_z(ux, false));
  }
  double half_height(double ux) const {
    return 0.5 * (half_axis_z(ux, true) + half_axis_z(ux, false));
  }
  /// The unit vector whose spread() points along d, from the centre.
  Vec3 on_ball(const Vec3& d) const;
  /// Distances from the centre to the layer surfaces on the ray through spread(u), u a unit vector.
  /// Thicknesses are normal to the skin, so an oblique ray runs longer in a layer.
  struct Ray {
    Vec3 direction = Vec3::UnitZ();
    double skin = 0, skull_outer = 0, skull_inner = 0, brain = 0;
  };
  Ray ray(const Vec3& u) const;

  static double scalp_thickness(const Vec3& direction);
  static double skull_thickness(const Vec3& direction);  ///< tables and diploe together
  static double outer_table_thickness(const Vec3& direction);
  static double inner_table_thickness(const Vec3& direction);
  static constexpr double kCsfThickness = 0.0022;  ///< of 11.4 % CSF by volume [matsumae1996] [E]

  /// Point of the face block's horizontal section; height 0 at the chin, 1 at the cranial centre,
  /// depth 0 at `back` (x) to 1 front, side -1 right to 1 left. z is not set.
  Vec3 face_outline(double height, double depth, double side, double back) const;
  /// Height fraction of face_outline at a level z.
  double face_height(double z) const;

 private:
  /// Half-axis z over the lengthwise position u.x in the unit ball, and its slope.
  double half_axis_z(double ux, bool upper) const;
  double half_axis_slope(double ux, bool upper) const;

  HeadMeasures measures_;
  Vec3 scale_;
};

}  // namespace crosswalk::fe::generate
