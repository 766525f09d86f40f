// Derivatives of a trilinear field at the 2x2x2 points of a brick, by sum factorisation: along each
// local axis xi_k a nodal field changes by a difference over four edges, spread over the four pairs
// of points between them. A third of the arithmetic of one gradient per node and point, and only
// dxi/dX (nine numbers a point) to remember of the undeformed shape.
#pragma once

#include <cmath>

#include "fe_node/material/tensor.h"

namespace crosswalk::fe {

/// Point q lies at xi = (q & 1 ? a : -a, q & 2 ? a : -a, q & 4 ? a : -a), a = 1 / sqrt(3).
inline constexpr int kHexPoints = 8;

namespace hex_points {

/// Nodes at both ends of the four edges along each axis, and points at both ends of the four pairs;
/// the two other axes count the edges in binary, the lower axis first.
inline constexpr int kEdge[3][4][2] = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}},
                                       {{0, 3}, {1, 2}, {4, 7}, {5, 6}},
                                       {{0, 4}, {1, 5}, {3, 7}, {2, 6}}};
inline constexpr int kPair[3][4][2] = {{{0, 1}, {2, 3}, {4, 5}, {6, 7}},
                                       {{0, 2}, {1, 3}, {4, 6}, {5, 7}},
                                       {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// From edges to point pairs, and by symmetry back.
template <class N>
void spread(N (&d)[4]) {
  constexpr double kA = 0.57735026918962576451, kNear = 0.5 * (1 + kA), kFar = 0.5 * (1 - kA);
  const N a = kNear * d[0] + kFar * d[1], b = kFar * d[0] + kNear * d[1],
          c = kNear * d[2] + kFar * d[3], e = kFar * d[2] + kNear * d[3];
  d[0] = kNear * a + kFar * c;
  d[1] = kNear * b + kFar * e;
  d[2] = kFar * a + kNear * c;
  d[3] = kFar * b + kNear * e;
}

}  // namespace hex_points

/// rate[q](i, k) = 2 du_i/dxi_k at each point.
template <class N>
void local_derivatives(const N (&u)[8][3], Tensor<N> (&rate)[kHexPoints]) {
  using hex_points::kEdge, hex_points::kPair;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      N d[4];
      for (int e = 0; e < 4; ++e) d[e] = u[kEdge[k][e][1]][i] - u[kEdge[k][e][0]][i];
      hex_points::spread(d);
      for (int e = 0; e < 4; ++e) rate[kPair[k][e][0]](i, k) = rate[kPair[k][e][1]](i, k) = d[e];
    }
}

/// The transpose of local_derivatives(): subtracts from each node's load what `stress`, conjugate
/// to the derivatives, asks of it.
template <class N>
void subtract_loads(const Tensor<N> (&stress)[kHexPoints], N (&load)[8][3]) {
  using hex_points::kEdge, hex_points::kPair;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      N d[4];
      for (int e = 0; e < 4; ++e)
        d[e] = stress[kPair[k][e][0]](i, k) + stress[kPair[k][e][1]](i, k);
      hex_points::spread(d);
      for (int e = 0; e < 4; ++e) {
        load[kEdge[k][e][1]][i] -= d[e];
        load[kEdge[k][e][0]][i] += d[e];
      }
    }
}

}  // namespace crosswalk::fe
