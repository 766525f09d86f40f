// Positions and sizes of the cervical and upper thoracic vertebrae, mm and degrees.
//
// Frame N: origin at the centre of the T1 body, x forward, y left, z up, head upright. Positions
// are a standing chain: heights and discs of the seated 50th male, tilts of the standing 50th
// female of the VIVA+ landmarks [vivaplus2022], chained by us [E]. Sizes are male-dominated cadaver
// means [panjabi1991] [L]; facet angles of C3 to C7 [facets2008]; facets face medially at C3,
// outwards from C6 on [bogduk2000] [pal2001] [L, medium; degrees E]; masses with arch and canal
// contents [E].
#pragma once

#include <array>

namespace crosswalk::fe::generate {

inline constexpr double kReferenceStature = 1.753;  ///< m, of the landmarks [vivaplus2022]

struct VertebraData {
  const char* name;
  double x, z;                                                ///< body centre
  double tilt_deg;                                            ///< of the body axis, + forward
  double height;                                              ///< of the body
  double upper_width, lower_width, upper_depth, lower_depth;  ///< endplates
  double canal_depth;
  double spinous;           ///< canal centre to tip of the spinous process
  double transverse;        ///< tip to tip
  double facet_deg;         ///< upper facet to the transverse plane
  double facet_medial_deg;  ///< by which the upper facets face the mid-plane
  double mass_kg;
};

inline constexpr std::array<VertebraData, 9> kVertebrae{{
    {"C2", 21.4, 111.1, -6.1, 17.6, 17.0, 17.5, 15.6, 15.6, 21.0, 33, 56, 20, 0, 0.030},
    {"C3", 22.2, 90.4, 2.2, 15.3, 15.8, 17.2, 15.0, 15.6, 16.2, 30, 50, 50, 30, 0.018},
    {"C4", 20.6, 71.0, 7.5, 14.1, 17.2, 17.0, 15.3, 15.9, 17.7, 30, 49, 45, 15, 0.019},
    {"C5", 17.5, 53.4, 12.5, 13.5, 17.5, 19.4, 15.2, 17.9, 17.4, 29, 47, 40, 5, 0.020},
    {"C6", 13.2, 36.9, 16.7, 14.3, 18.5, 22.0, 16.4, 18.5, 18.1, 34, 50, 43, -5, 0.022},
    {"C7", 7.2, 19.0, 19.9, 14.7, 21.8, 23.4, 18.1, 16.8, 15.2, 46, 67, 45, -10, 0.028},
    {"T1", 0.0, 0.0, 21.7, 17.9, 24.5, 27.8, 18.5, 19.7, 16.0, 50, 75, 65, -10, 0.035},
    {"T2", -9.1, -20.0, 27.1, 17.8, 24.9, 27.4, 19.6, 21.6, 15.0, 51, 69, 75, 0, 0.035},
    {"T3", -18.0, -39.6, 21.5, 16.8, 24.6, 25.9, 22.7, 23.3, 15.0, 51, 61, 75, 0, 0.035},
}};

/// Atlas: ring centre and sizes [L, medium]
struct AtlasData {
  double x = 14, z = 131.5;
  double transverse = 78, ring_depth = 45, ring_half_width = 24;
  double section = 7;  ///< of the ring bar
  double mass_kg = 0.025;
};
inline constexpr AtlasData kAtlas{};

inline constexpr double kDensHeight = 15.5;  ///< above the body of C2, mm [L]

/// Occipital condyle axis in N, mm [L: NBDL anatomy, medium].
inline constexpr double kCondyleX = 14, kCondyleZ = 138.5;
/// The same axis in the Frankfurt frame of the reference head, mm.
inline constexpr double kCondyleFrankfurtX = -11, kCondyleFrankfurtZ = -26;

/// Facet joints: centre beside and behind the body centre at disc mid-height, mm [L, medium].
inline constexpr double kFacetSide = 21, kFacetBehind = 16;

}  // namespace crosswalk::fe::generate
