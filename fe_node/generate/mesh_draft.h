// A mesh under construction: nodes by index, elements that name their part. SI units, any frame.
//
// The generators grow a draft piece by piece with shared nodes; deck_export writes it as a deck.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/spatial.h"

namespace crosswalk::fe::generate {

struct Hex {
  std::array<int, 8> node{};  ///< 0-3 one face, 4-7 the opposite one above it; positive volume
  int part = 0;
};

struct Quad {
  std::array<int, 4> node{};
  int part = 0;
  double thickness = 0;  ///< m; 0: the section's
};

/// A spring, ligament or muscle strand between two nodes.
struct Line {
  int from = 0;
  int to = 0;
  int part = 0;
};

struct PointMass {
  int node = 0;
  double mass = 0;  ///< kg
};

struct NodeSet {
  std::string name;
  std::vector<int> nodes;
};

/// Nodes that move with a rigid part although no element of it holds them.
struct RigidAttachment {
  int part = 0;
  std::vector<int> nodes;
};

struct MeshDraft {
  std::vector<Vec3> nodes;
  std::vector<Hex> hexes;
  std::vector<Quad> quads;
  std::vector<Line> lines;
  std::vector<PointMass> masses;
  std::vector<NodeSet> sets;
  std::vector<RigidAttachment> attachments;

  int add_node(const Vec3& position);
  /// Adds the nodes to the attachment of that part, which is created when new.
  void attach(int part, const std::vector<int>& node_list);
};

}  // namespace crosswalk::fe::generate
