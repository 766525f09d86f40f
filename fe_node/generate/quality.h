// Shape measures of hexahedra and their summary per part.
//
// scaled Jacobian: least over the corners of det of the three unit edge vectors, 1 for a brick, <=
// 0 inverted. aspect: longest over shortest edge. warpage: largest angle between the two triangles
// of a face, over both diagonals. characteristic length: volume over largest face area, the length
// in the stable step of a one-point brick. Of a wedge, pyramid or tetrahedron, a brick with
// repeated nodes, corners and edges that do not exist are left out.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fe_node/generate/mesh_draft.h"

namespace crosswalk::fe::generate {

/// Limits every generated element keeps, rigid ones too [E]; of the few tetrahedra in the corners
/// of the fluid beside a sheet only the volume is held to be positive.
inline constexpr double kMinScaledJacobian = 0.2, kMaxAspect = 12.5;

using HexCorners = std::array<Vec3, 8>;

HexCorners corners_of(const MeshDraft& draft, const Hex& hex);
/// Point of the trilinear map at natural coordinates in -1..1.
Vec3 trilinear(const HexCorners& x, double r, double s, double t);
/// Exact volume of the trilinear hexahedron, m3.
double volume(const HexCorners& x);
double scaled_jacobian(const HexCorners& x);
double aspect_ratio(const HexCorners& x);
double warpage(const HexCorners& x);                ///< rad
double characteristic_length(const HexCorners& x);  ///< m

struct PartQuality {
  int part = 0;
  int elements = 0;
  double volume = 0;               ///< m3
  double min_scaled_jacobian = 1;  ///< tetrahedra aside
  double max_aspect = 1;
  double max_warpage = 0;                ///< rad
  double min_characteristic_length = 1;  ///< m
};

/// Of all parts with hexahedra, in the order of their first element.
std::vector<PartQuality> hex_quality(const MeshDraft& draft);

}  // namespace crosswalk::fe::generate
