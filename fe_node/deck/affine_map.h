// *DEFINE_TRANSFORMATION as one map of points: x -> A x + b.
//
// Rows act in the order written. SCALE, TRANSL, ROTATE (about a point and a direction, or about two
// POINTs), TRANSL2ND and POS6P are known [lstc2014, *DEFINE_TRANSFORMATION]; POINTs are moved
// by the rows between their definition and their use. A map that mirrors or flattens is refused:
// it would turn elements inside out.
#pragma once

#include <string>

#include "fe_node/deck/deck.h"
#include "fe_node/deck/deck_problems.h"

namespace crosswalk::fe {

struct AffineMap {
  Mat3 linear = Mat3::Identity();
  Vec3 shift = Vec3::Zero();         ///< in length units of the deck that defines it
  Mat3 rotation = Mat3::Identity();  ///< the ROTATE and POS6P rows alone: turns directions
  Vec3 point(const Vec3& x) const { return linear * x + shift; }
  bool turns() const { return !rotation.isIdentity(1e-12); }
};

/// The map; rows that cannot be read are errors at the transformation's place and left out.
AffineMap affine_map(const Transformation& transformation, const Deck& deck, ProblemList& errors);

}  // namespace crosswalk::fe
