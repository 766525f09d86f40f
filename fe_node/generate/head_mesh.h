// The head's hexahedra: cubed-sphere brain, CSF, skull, scalp, and the face block that continues
// downwards as neck flesh. All layers share nodes. Frame F (head_shape.h), metres.
//
// The bottom of the cubed sphere and the lower rows of its front form one structured strip of
// surface quads. Swept downwards, its front half is the face, its back half the neck; below the
// chin the neck goes on under the face. A channel round the spine stays empty.
#pragma once

#include <functional>
#include <vector>

#include "fe_node/generate/head_shape.h"
#include "fe_node/generate/mesh_draft.h"
#include "fe_node/generate/primitives.h"

namespace crosswalk::fe::generate {

struct HeadResolution {
  int n = 10;  ///< cells along a cube edge, even
  int csf_layers = 1;
  int skull_layers = 2;
  int scalp_layers = 1;
  /// Cells follow the middle between the cranium's roof and floor by so much: the anterior floor is
  /// high, and cells that start from one centre would be flat above it. 1: the middle itself.
  double lift = 0;
  int even_sweeps = 0;  ///< see even_directions()
};

struct HeadMesh {
  CubedSphere sphere;
  std::vector<int> skull_inner;  ///< nodes in surface order
  std::vector<int> skull_outer;
  std::vector<int> skin;  ///< of the scalp; -1 on the strip
};

/// Strip of surface quads under the head: rows from the occiput (0) forwards, sides right to left.
struct HeadStrip {
  explicit HeadStrip(const CubedSphere& sphere);
  int rows = 0;      ///< cells
  int columns = 0;   ///< cells
  int face_row = 0;  ///< face from here on, neck before
  /// Surface node at a strip corner.
  int node(int row, int column) const;
  bool holds_quad(int quad) const { return in_strip[quad]; }
  std::vector<bool> in_strip;

 private:
  const CubedSphere* sphere_;
  int front_rows_ = 0;
};

/// Brain, CSF, skull and scalp.
HeadMesh add_cranium(MeshDraft& draft, const HeadShape& shape, const HeadResolution& resolution);

/// Horizontal sections of the neck in F: centre and half-axes at a level.
struct NeckSection {
  Vec3 centre = Vec3::Zero();
  double half_depth = 0, half_breadth = 0;
};

struct NeckFleshPlan {
  double bottom_z = 0;  ///< level of the lowest nodes, F
  int levels_above_chin = 6;
  int levels_below_chin = 6;
  double channel_half_width = 0.025;
  double channel_back = 0.030;  ///< behind the section's centre
  std::function<NeckSection(double z)> section;
};

struct FaceAndFlesh {
  std::vector<int> channel_wall;  ///< flesh nodes round the spine, not of face or skull
  std::vector<int> bottom;        ///< lowest flesh nodes
};

FaceAndFlesh add_face_and_flesh(MeshDraft& draft, const HeadMesh& head, const HeadShape& shape,
                                const NeckFleshPlan& plan);

}  // namespace crosswalk::fe::generate
