// Sheets between bricks that get fluid on both sides, on blocks whose volumes follow by hand.
#include "fe_node/generate/sheet_fluid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "fe_node/generate/hex_faces.h"
#include "fe_node/generate/primitives.h"
#include "fe_node/generate/quality.h"

namespace crosswalk::fe::generate {
namespace {

constexpr int kTissue = 1, kFluid = 2, kLining = 3, kSheet = 4;
constexpr double kGap = 0.1;
constexpr int kCells = 6;  // of a cube of side 6, so that a cell has side 1

/// A cube of tissue; quads of a horizontal sheet at half its height from x = `from` to its back,
/// and of a vertical one on it in the mid-plane, likewise.
MeshDraft cube(int from, bool has_wall) {
  MeshDraft draft;
  const Grid grid = add_block(
      draft, {kCells, kCells, kCells}, [](int a, int b, int c) { return Vec3(a, b, c); }, kTissue);
  const int middle = kCells / 2;
  for (int a = from; a < kCells; ++a) {
    for (int b = 0; b < kCells; ++b)
      draft.quads.push_back({{grid.at(a, b, middle), grid.at(a + 1, b, middle),
                              grid.at(a + 1, b + 1, middle), grid.at(a, b + 1, middle)},
                             kSheet});
    for (int c = middle; has_wall && c < kCells; ++c)
      draft.quads.push_back({{grid.at(a, middle, c), grid.at(a + 1, middle, c),
                              grid.at(a + 1, middle, c + 1), grid.at(a, middle, c + 1)},
                             kSheet});
  }
  return draft;
}

/// The block keeps its outer faces across the moves, but for the sheets' edges there.
MeshDraft floated(MeshDraft draft, std::vector<int> anchored = {}) {
  std::set<int> on_sheet;
  for (const Quad& quad : draft.quads) on_sheet.insert(quad.node.begin(), quad.node.end());
  for (int n = 0; n < static_cast<int>(draft.nodes.size()); ++n) {
    const Vec3 from_centre = (draft.nodes[n] - Vec3(0, 3, 3)).cwiseAbs();
    if (std::max(from_centre.y(), from_centre.z()) > 2.5 && !on_sheet.contains(n))
      anchored.push_back(n);
  }
  float_sheets(draft, {.sheets = {kSheet},
                       .tissue = {kTissue},
                       .fluid = kFluid,
                       .lining = kLining,
                       .gap = kGap,
                       .anchored = anchored});
  return draft;
}

std::map<int, double> volumes(const MeshDraft& draft) {
  std::map<int, double> sum;
  for (const Hex& hex : draft.hexes) {
    const double v = volume(corners_of(draft, hex));
    EXPECT_GT(v, 0);
    sum[hex.part] += v;
  }
  return sum;
}

/// Every sheet's quad has fluid on both sides and no tissue.
void expect_fluid_on_both_sides(const MeshDraft& draft) {
  std::map<FaceKey, std::multiset<int>> parts_on;
  for (const Hex& hex : draft.hexes)
    for (const auto& face : kHexFaces) parts_on[face_key(face_nodes(hex, face))].insert(hex.part);
  for (const Quad& quad : draft.quads) {
    if (quad.part != kSheet) continue;
    EXPECT_EQ(parts_on[face_key(quad.node)], (std::multiset<int>{kFluid, kFluid}));
  }
}

TEST(SheetFluid, ASheetThroughTheWholeBlockGetsALayerOnEachSide) {
  const MeshDraft draft = floated(cube(0, false));
  const auto volume_of = volumes(draft);
  EXPECT_NEAR(volume_of.at(kFluid), 2 * kGap * 36, 1e-9);
  EXPECT_NEAR(volume_of.at(kTissue) + volume_of.at(kFluid), 216, 1e-9);
  expect_fluid_on_both_sides(draft);
  // No node of the tissue lies on the sheet.
  for (const Hex& hex : draft.hexes) {
    if (hex.part != kTissue) continue;
    for (const int id : hex.node) EXPECT_GE(std::abs(draft.nodes[id].z() - 3), kGap - 1e-9);
  }
}

TEST(SheetFluid, LiningCoversTheNewFacesAndLooksAtTheSheet) {
  const MeshDraft draft = floated(cube(0, false));
  double area = 0;
  for (const Quad& quad : draft.quads) {
    if (quad.part != kLining) continue;
    const auto at = [&](int c) { return draft.nodes[quad.node[c]]; };
    const Vec3 normal = 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
    area += normal.norm();
    EXPECT_GT(normal.z() * (3 - at(0).z()), 0);
  }
  EXPECT_NEAR(area, 2 * 36, 1e-9);
}

// At the free edge the layer runs out in wedges: half of it is missing in the edge's row of cells.
TEST(SheetFluid, TheFreeEdgeStaysWhole) {
  const MeshDraft draft = floated(cube(2, false));
  EXPECT_NEAR(volumes(draft).at(kFluid), 2 * kGap * 6 * (4 - 0.5), 1e-6);
  EXPECT_NEAR(volumes(draft).at(kTissue) + volumes(draft).at(kFluid), 216, 1e-9);
  std::map<int, std::set<int>> parts_at;
  for (const Hex& hex : draft.hexes)
    for (const int id : hex.node) parts_at[id].insert(hex.part);
  for (const Quad& quad : draft.quads) {
    if (quad.part != kSheet) continue;
    for (const int id : quad.node)
      EXPECT_EQ(parts_at[id].contains(kTissue), draft.nodes[id].x() < 2.001);
  }
  int wedges = 0;
  for (const Hex& hex : draft.hexes)
    wedges += std::set<int>(hex.node.begin(), hex.node.end()).size() == 6;
  EXPECT_EQ(wedges, 2 * 6);
}

TEST(SheetFluid, WhereOneSheetStandsOnAnotherThreeSidesPart) {
  const MeshDraft draft = floated(cube(0, true));
  expect_fluid_on_both_sides(draft);
  const auto volume_of = volumes(draft);
  // Beside the wall the layers of both sheets meet in a corner that counts once. The wall's upper
  // edge, an outer face, slides up by a hundredth of a cell.
  EXPECT_NEAR(volume_of.at(kFluid), 2 * kGap * (36 + 18) - 2 * kGap * kGap * 6, 0.05);
  EXPECT_NEAR(volume_of.at(kTissue) + volume_of.at(kFluid), 216, 0.4);
  for (const Hex& hex : draft.hexes) EXPECT_GT(scaled_jacobian(corners_of(draft, hex)), 0.7);
}

// Bone that holds the sheet's back edge: wedges there too.
TEST(SheetFluid, AnchoredNodesStayWhole) {
  MeshDraft draft = cube(0, false);
  std::vector<int> back;
  for (int n = 0; n < static_cast<int>(draft.nodes.size()); ++n)
    if (draft.nodes[n].x() > 5.5) back.push_back(n);
  draft = floated(draft, back);
  EXPECT_NEAR(volumes(draft).at(kFluid), 2 * kGap * 6 * (6 - 0.5), 1e-6);
}

// A sheet over a quarter of the plane has a corner of which one node is parted in its last quad,
// and one over three quarters a corner of which three are.
TEST(SheetFluid, CornersOfTheOutlineAreTetrahedraAndPyramids) {
  const MeshDraft whole = cube(0, false);
  for (const bool quarter : {true, false}) {
    MeshDraft draft = whole;
    std::erase_if(draft.quads, [&](const Quad& quad) {
      Vec3 centre = Vec3::Zero();
      for (const int id : quad.node) centre += draft.nodes[id] / 4;
      const bool is_in_quarter = centre.x() > 3 && centre.y() > 3;
      return is_in_quarter != quarter;
    });
    draft = floated(draft);
    // Faces of the tissue's bricks are bilinear there, those of what fills them flat.
    EXPECT_NEAR(volumes(draft).at(kTissue) + volumes(draft).at(kFluid), 216, 0.5 * kGap) << quarter;
    std::map<std::size_t, int> by_nodes;
    for (const Hex& hex : draft.hexes)
      ++by_nodes[std::set<int>(hex.node.begin(), hex.node.end()).size()];
    EXPECT_EQ(by_nodes[4], quarter ? 2 : 0);
    EXPECT_EQ(by_nodes[5], quarter ? 0 : 4);
  }
}

}  // namespace
}  // namespace crosswalk::fe::generate
