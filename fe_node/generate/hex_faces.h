// Faces and edges of a brick of a draft, and keys that find what shares a face.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "fe_node/generate/mesh_draft.h"

namespace crosswalk::fe::generate {

/// Local nodes of each face, anticlockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> kHexFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
inline constexpr std::array<std::pair<int, int>, 12> kHexEdges = {{{0, 1},
                                                                   {1, 2},
                                                                   {2, 3},
                                                                   {3, 0},
                                                                   {4, 5},
                                                                   {5, 6},
                                                                   {6, 7},
                                                                   {7, 4},
                                                                   {0, 4},
                                                                   {1, 5},
                                                                   {2, 6},
                                                                   {3, 7}}};

inline std::array<int, 4> face_nodes(const Hex& hex, const std::array<int, 4>& face) {
  return {hex.node[face[0]], hex.node[face[1]], hex.node[face[2]], hex.node[face[3]]};
}

/// Of a brick in a layer: towards the inside and the outside of the head.
inline std::array<int, 4> inner_face(const Hex& hex) { return face_nodes(hex, {0, 1, 2, 3}); }
inline std::array<int, 4> outer_face(const Hex& hex) { return face_nodes(hex, {4, 5, 6, 7}); }

/// The same for both bricks at a face.
using FaceKey = std::array<int, 4>;
inline FaceKey face_key(std::array<int, 4> node) {
  std::sort(node.begin(), node.end());
  return node;
}

}  // namespace crosswalk::fe::generate
