#include "fe_node/generate/sheet_fluid.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <Eigen/SVD>

#include "common/error.h"
#include "fe_node/generate/hex_faces.h"
#include "fe_node/generate/layer_cell.h"

namespace crosswalk::fe::generate {

namespace {

/// Singular value over the largest below which the normals at a node are of one sheet.
constexpr double kParallel = 0.2;
constexpr int kSweeps = 60;  ///< over the cells that give way; enough for those of `fine`

bool holds(const std::vector<int>& parts, int part) {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

/// One side of a sheet's quad: the brick there and the way from the sheet into it.
struct SheetSide {
  int hex = -1;
  Vec3 inwards = Vec3::Zero();  ///< unit
};

/// A node of a sheet and those that took its place in the bricks of each side.
struct Parted {
  struct Copy {
    int node = -1;
    Vec3 off = Vec3::Zero();  ///< the way off the sheet, m
  };
  std::vector<Copy> copies;
  bool is_flat = true;  ///< on one sheet only
};

class Parting {
 public:
  Parting(MeshDraft& draft, const SheetFluid& spec) : draft_(draft), spec_(spec) {}

  void run() {
    find_sides();
    find_bricks();
    part_nodes();
    give_way();
    fill();
  }

 private:
  bool is_parted(int part) const { return part == spec_.fluid || holds(spec_.tissue, part); }

  void find_sides() {
    for (int q = 0; q < static_cast<int>(draft_.quads.size()); ++q)
      if (holds(spec_.sheets, draft_.quads[q].part)) quad_of_[face_key(draft_.quads[q].node)] = q;
    for (int h = 0; h < static_cast<int>(draft_.hexes.size()); ++h) {
      if (!is_parted(draft_.hexes[h].part)) continue;
      for (const auto& face : kHexFaces) {
        const auto found = quad_of_.find(face_key(face_nodes(draft_.hexes[h], face)));
        if (found == quad_of_.end()) continue;
        const std::array<int, 4>& node = draft_.quads[found->second].node;
        const Vec3 normal = (at(node[2]) - at(node[0])).cross(at(node[3]) - at(node[1]));
        Vec3 to_brick = -at(node[0]);
        for (const int id : draft_.hexes[h].node) to_brick += at(id) / 8;
        const bool is_above = normal.dot(to_brick) > 0;
        SheetSide& side = sides_[found->second][is_above ? 1 : 0];
        CW_ASSERT(side.hex < 0);
        side = {h, (is_above ? 1 : -1) * normal.normalized()};
      }
    }
    for (const auto& [quad, sides] : sides_) CW_ASSERT(sides[0].hex >= 0 && sides[1].hex >= 0);
  }

  void find_bricks() {
    const std::set<int> anchored(spec_.anchored.begin(), spec_.anchored.end());
    for (const auto& [quad, sides] : sides_)
      for (const int id : draft_.quads[quad].node)
        if (!anchored.contains(id)) quads_at_[id].push_back(quad);
    for (const auto& [node, quads] : quads_at_) bricks_at_[node];
    for (int h = 0; h < static_cast<int>(draft_.hexes.size()); ++h) {
      if (!is_parted(draft_.hexes[h].part)) continue;
      for (const int id : draft_.hexes[h].node) {
        const auto found = bricks_at_.find(id);
        if (found != bricks_at_.end()) found->second.push_back(h);
      }
    }
  }

  /// The bricks at a node in groups that share faces other than a sheet's, by group of each.
  std::vector<int> groups_of(int node, const std::vector<int>& bricks) const {
    std::vector<int> group(bricks.size());
    for (std::size_t b = 0; b < bricks.size(); ++b) group[b] = static_cast<int>(b);
    std::map<FaceKey, int> open;
    for (int b = 0; b < static_cast<int>(bricks.size()); ++b)
      for (const auto& face : kHexFaces) {
        const std::array<int, 4> nodes = face_nodes(whole_hexes_[bricks[b]], face);
        if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
        const FaceKey key = face_key(nodes);
        if (quad_of_.contains(key)) continue;
        const auto [found, is_new] = open.try_emplace(key, b);
        if (is_new) continue;
        const int joined = group[found->second], into = group[b];
        std::replace(group.begin(), group.end(), joined, into);
      }
    return group;
  }

  /// Whether the bricks lie on both sides of a quad at the node: it is on the free edge there.
  bool goes_round_a_sheet(int node, const std::set<int>& bricks) const {
    for (const int quad : quads_at_.at(node)) {
      const auto& sides = sides_.at(quad);
      if (bricks.contains(sides[0].hex) && bricks.contains(sides[1].hex)) return true;
    }
    return false;
  }

  void part_nodes() {
    whole_hexes_ = draft_.hexes;
    for (const auto& [node, bricks] : bricks_at_) {
      const std::vector<int> group = groups_of(node, bricks);
      std::map<int, std::set<int>> groups;
      for (std::size_t b = 0; b < bricks.size(); ++b) groups[group[b]].insert(bricks[b]);
      if (std::any_of(groups.begin(), groups.end(),
                      [&](const auto& g) { return goes_round_a_sheet(node, g.second); }))
        continue;
      Parted& parted = parted_[node];
      for (const auto& [_, members] : groups) {
        const int copy = draft_.add_node(at(node));
        const auto [off, is_flat] = off_the_sheets(node, members);
        parted.copies.push_back({copy, off});
        parted.is_flat = parted.is_flat && is_flat;
        for (const int h : members)
          std::replace(draft_.hexes[h].node.begin(), draft_.hexes[h].node.end(), node, copy);
      }
    }
  }

  /// The shortest way that leads the gap off every quad at the node that the bricks lie on, and
  /// whether these are of one sheet. Inside the fluid, halfway to the bone, half the gap.
  std::pair<Vec3, bool> off_the_sheets(int node, const std::set<int>& bricks) const {
    std::vector<Vec3> normals;
    for (const int quad : quads_at_.at(node))
      for (const SheetSide& side : sides_.at(quad))
        if (bricks.contains(side.hex)) normals.push_back(side.inwards);
    CW_ASSERT(!normals.empty());
    Eigen::MatrixX3d system(normals.size(), 3);
    for (std::size_t i = 0; i < normals.size(); ++i)
      system.row(static_cast<Eigen::Index>(i)) = normals[i];
    Eigen::JacobiSVD<Eigen::MatrixX3d> svd(system, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(kParallel);
    const bool is_in_fluid = std::all_of(
        bricks.begin(), bricks.end(), [&](int h) { return draft_.hexes[h].part == spec_.fluid; });
    const double gap = is_in_fluid ? 0.5 * spec_.gap : spec_.gap;
    return {svd.solve(Eigen::VectorXd::Constant(system.rows(), gap)), svd.rank() == 1};
  }

  /// Nodes that give way and those each follows: the tissue's in the tissue, the fluid's own in
  /// both. Bone and sheets stay.
  std::map<int, std::set<int>> followers() const {
    std::map<int, std::set<int>> neighbours;
    std::vector<bool> of_tissue(draft_.nodes.size(), false);
    for (const bool is_tissue : {true, false})
      for (const Hex& hex : draft_.hexes) {
        if (!is_parted(hex.part) || holds(spec_.tissue, hex.part) != is_tissue) continue;
        for (const auto& [a, b] : kHexEdges)
          for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
            if (is_tissue || !of_tissue[hex.node[from]])
              neighbours[hex.node[from]].insert(hex.node[to]);
        if (is_tissue)
          for (const int id : hex.node) of_tissue[id] = true;
      }
    for (const auto& [quad, sides] : sides_)
      for (const int id : draft_.quads[quad].node) neighbours.erase(id);
    for (const int id : spec_.anchored) neighbours.erase(id);
    return neighbours;
  }

  /// Moves the new faces off the sheets and spreads the move evenly into what lies behind. A
  /// sheet's own nodes slide in it, where another stands on it.
  void give_way() {
    const std::map<int, std::set<int>> neighbours = followers();
    std::vector<Vec3> move(draft_.nodes.size(), Vec3::Zero());
    std::set<int> copies;
    for (const auto& [node, parted] : parted_)
      for (const auto& [copy, off] : parted.copies) {
        move[copy] = off;
        copies.insert(copy);
      }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      std::vector<Vec3> next = move;
      for (const auto& [node, around] : neighbours) {
        if (copies.contains(node)) continue;
        Vec3 sum = Vec3::Zero();
        for (const int other : around) sum += move[other];
        next[node] = sum / static_cast<double>(around.size());
      }
      for (const auto& [node, parted] : parted_) {
        if (!parted.is_flat) continue;
        Vec3 slide = Vec3::Zero();
        double count = 0;
        for (const auto& [copy, off] : parted.copies)
          for (const int other : neighbours.at(copy)) {
            slide += move[other];
            ++count;
          }
        const Vec3 normal = parted.copies[0].off.normalized();
        slide = slide / count - normal * normal.dot(slide / count);
        next[node] = slide;
        for (const auto& [copy, off] : parted.copies) next[copy] = off + slide;
      }
      move = std::move(next);
    }
    for (std::size_t n = 0; n < move.size(); ++n) draft_.nodes[n] += move[n];
  }

  void fill() {
    for (const auto& [quad, sides] : sides_)
      for (const SheetSide& side : sides) {
        // Seen from the brick the sheet's nodes run anticlockwise.
        std::array<int, 4> sheet = draft_.quads[quad].node;
        if (&side == &sides[0]) std::reverse(sheet.begin(), sheet.end());
        std::array<int, 4> tissue = sheet;
        for (int& id : tissue) id = copy_in(side.hex, id);
        add_layer_cell(draft_, sheet, tissue, spec_.fluid);
        if (tissue != sheet && holds(spec_.tissue, draft_.hexes[side.hex].part))
          draft_.quads.push_back({{tissue[3], tissue[2], tissue[1], tissue[0]}, spec_.lining});
      }
  }

  int copy_in(int hex, int node) const {
    for (int c = 0; c < 8; ++c)
      if (whole_hexes_[hex].node[c] == node) return draft_.hexes[hex].node[c];
    CW_ASSERT(false && "the brick lies on the sheet");
    return -1;
  }

  const Vec3& at(int node) const { return draft_.nodes[node]; }

  MeshDraft& draft_;
  const SheetFluid& spec_;
  std::map<FaceKey, int> quad_of_;                 ///< of the sheets
  std::map<int, std::array<SheetSide, 2>> sides_;  ///< of each: against and along its normal
  std::map<int, std::vector<int>> quads_at_;       ///< a sheet's node that may be parted
  std::map<int, std::vector<int>> bricks_at_;      ///< a sheet's node
  std::vector<Hex> whole_hexes_;                   ///< before parting
  std::map<int, Parted> parted_;                   ///< by node of a sheet
};

}  // namespace

void float_sheets(MeshDraft& draft, const SheetFluid& spec) { Parting(draft, spec).run(); }

}  // namespace crosswalk::fe::generate
