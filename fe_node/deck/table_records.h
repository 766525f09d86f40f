// Curves, tables, sets, coordinate systems and boxes as a keyword deck gives them.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "common/spatial.h"
#include "fe_node/deck/deck_id.h"

namespace crosswalk::fe {

/// *DEFINE_CURVE: x = x_scale (abscissa + x_offset), y likewise
struct DeckCurve {
  DeckId id;
  std::string title;
  int stress_initialisation = 0;  ///< SIDR
  double x_scale = 1, y_scale = 1, x_offset = 0, y_offset = 0;
  int data_type = 0;
  int internal_points = 0;                        ///< LCINT
  std::vector<std::pair<double, double>> points;  ///< raw, before scale and offset
  Source source;
  bool operator==(const DeckCurve&) const = default;
};
/// Points after offset and scale.
std::vector<std::pair<double, double>> scaled_points(const DeckCurve& curve);

/// *DEFINE_CURVE_FUNCTION: kept as text, not evaluated
struct CurveFunction {
  DeckId id;
  std::string title;
  int stress_initialisation = 0;
  std::vector<std::string> expression;
  Source source;
  bool operator==(const CurveFunction&) const = default;
};

/// *DEFINE_TABLE (its curves follow it in the deck) and *DEFINE_TABLE_2D (curve ids given)
struct DeckTable {
  DeckId id;
  std::string title;
  double scale = 1, offset = 0;
  std::vector<double> values;  ///< raw, before scale and offset
  std::vector<DeckId> curves;  ///< one per value
  Source source;
  bool operator==(const DeckTable&) const = default;
};

enum class SetKind { Node, Part, Shell, Solid, Beam, Discrete };

/// One line of a *SET_..._GENERAL card: what to take (ALL, PART, BOX, NODE, DPART ...) and ids
struct GeneralEntry {
  std::string option;
  std::vector<DeckId> ids;
  bool operator==(const GeneralEntry&) const = default;
};

/// *SET_NODE, _PART, _SHELL, _SOLID, _BEAM, _DISCRETE with the forms LIST, COLUMN, GENERATE,
/// GENERAL and ADD. deck_query.h expands them.
struct DeckSet {
  SetKind kind = SetKind::Node;
  DeckId id;
  std::string title;
  std::array<double, 4> attributes{};  ///< DA1..DA4
  std::string solver;                  ///< "MECH" or blank
  std::vector<DeckId> ids;
  std::vector<std::pair<DeckId, DeckId>> ranges;  ///< GENERATE, inclusive
  std::vector<GeneralEntry> general;
  std::vector<DeckId> added_sets;  ///< ADD
  Source source;
  bool operator==(const DeckSet&) const = default;
};

/// *SET_SEGMENT and _GENERAL
struct SegmentSet {
  DeckId id;
  std::string title;
  std::array<double, 4> attributes{};
  std::string solver;
  std::vector<std::array<DeckId, 4>> segments;  ///< triangles repeat the third node
  std::vector<GeneralEntry> general;
  Source source;
  bool operator==(const SegmentSet&) const = default;
};

/// *DEFINE_COORDINATE_NODES: origin, a node on an axis, a node in the plane
struct CoordinateNodes {
  DeckId id;
  std::string title;
  std::array<DeckId, 3> nodes;
  int is_updated = 0;      ///< FLAG 1: follows the nodes
  std::string axis = "X";  ///< DIR: the axis from the first to the second node
  Source source;
  bool operator==(const CoordinateNodes&) const = default;
};

/// *DEFINE_COORDINATE_SYSTEM: origin, point on x, point in the xy plane; _VECTOR: x axis, xy vector
struct CoordinateSystem {
  DeckId id;
  std::string title;
  bool is_vector_form = false;  ///< then `origin` is zero and the two are directions
  Vec3 origin = Vec3::Zero(), x_point = Vec3::Zero(), xy_point = Vec3::Zero();
  DeckId axes, node;
  Source source;
  bool operator==(const CoordinateSystem&) const = default;
};

/// *DEFINE_VECTOR
struct DefinedVector {
  DeckId id;
  std::string title;
  Vec3 tail = Vec3::Zero(), head = Vec3::Zero();
  DeckId axes;
  Source source;
  bool operator==(const DefinedVector&) const = default;
};

/// *DEFINE_SD_ORIENTATION: direction of discrete elements
struct SpringOrientation {
  DeckId id;
  std::string title;
  int option = 0;  ///< 0 along the vector, 1 in its normal plane, 2 nodes, 3 both
  Vec3 direction = Vec3::Zero();
  std::array<DeckId, 2> nodes;
  Source source;
  bool operator==(const SpringOrientation&) const = default;
};

/// *DEFINE_BOX
struct DefinedBox {
  DeckId id;
  std::string title;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  Source source;
  bool operator==(const DefinedBox&) const = default;
};

/// *DEFINE_TRANSFORMATION: rows of option and seven numbers
struct Transformation {
  DeckId id;
  std::string title;
  std::vector<std::pair<std::string, std::array<double, 7>>> rows;
  Source source;
  bool operator==(const Transformation&) const = default;
};

}  // namespace crosswalk::fe
