#include "fe_node/deck/deck.h"

#include <algorithm>

namespace crosswalk::fe {

namespace {

struct NamedSystem {
  UnitSystem system;
  std::string_view name;
  UnitFactors factors;
};

constexpr double kInch = 0.0254;                 // m, exact
constexpr double kPoundForce = 4.4482216152605;  // N, exact
constexpr NamedSystem kSystems[] = {
    {UnitSystem::MKgS, "m-kg-s", {1, 1, 1}},
    {UnitSystem::MmTonneS, "mm-t-s", {1e-3, 1e3, 1}},
    {UnitSystem::MmKgMs, "mm-kg-ms", {1e-3, 1, 1e-3}},
    {UnitSystem::MmGramMs, "mm-g-ms", {1e-3, 1e-3, 1e-3}},
    {UnitSystem::CmGramUs, "cm-g-us", {1e-2, 1e-3, 1e-6}},
    {UnitSystem::InchSlinchS, "in-slinch-s", {kInch, kPoundForce / kInch, 1}},
};

bool are_distinct(std::span<const DeckId> nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = i + 1; j < nodes.size(); ++j)
      if (nodes[i] == nodes[j]) return false;
  return true;
}

ShapedSolid shaped(SolidShape shape, std::initializer_list<DeckId> nodes) {
  ShapedSolid solid{.shape = shape, .nodes = {}, .count = static_cast<int>(nodes.size())};
  std::copy(nodes.begin(), nodes.end(), solid.nodes.begin());
  if (!are_distinct({solid.nodes.data(), nodes.size()})) solid.shape = SolidShape::Other;
  return solid;
}

}  // namespace

UnitFactors unit_factors(UnitSystem system) {
  for (const NamedSystem& named : kSystems)
    if (named.system == system) return named.factors;
  return {};
}

std::string_view unit_system_name(UnitSystem system) {
  for (const NamedSystem& named : kSystems)
    if (named.system == system) return named.name;
  return "unknown";
}

UnitSystem unit_system_from(std::string_view name) {
  for (const NamedSystem& named : kSystems)
    if (named.name == name) return named.system;
  return UnitSystem::Unknown;
}

const char* solid_shape_name(SolidShape shape) {
  constexpr const char* kNames[] = {"hex8", "penta6", "pyramid5", "tet4", "tet10", "degenerate"};
  return kNames[static_cast<int>(shape)];
}

ShapedSolid solid_shape(const SolidElement& element) {
  const auto& n = element.nodes;
  if (n[8].given() || n[9].given())
    return shaped(SolidShape::Tet10, {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9]});
  const bool apex_at_5 = n[4] == n[5] && n[5] == n[6] && n[6] == n[7];
  const bool none_after_4 = !n[4].given() && !n[5].given() && !n[6].given() && !n[7].given();
  if (none_after_4 || (apex_at_5 && n[3] == n[4]))
    return shaped(SolidShape::Tet4, {n[0], n[1], n[2], n[3]});
  if (apex_at_5 && n[2] == n[3]) return shaped(SolidShape::Tet4, {n[0], n[1], n[2], n[4]});
  if (apex_at_5) return shaped(SolidShape::Pyramid5, {n[0], n[1], n[2], n[3], n[4]});
  if (!n[6].given() && !n[7].given())
    return shaped(SolidShape::Penta6, {n[0], n[4], n[1], n[3], n[5], n[2]});
  if (n[4] == n[5] && n[6] == n[7])
    return shaped(SolidShape::Penta6, {n[0], n[4], n[1], n[3], n[6], n[2]});
  if (n[2] == n[3] && n[6] == n[7])
    return shaped(SolidShape::Penta6, {n[0], n[1], n[2], n[4], n[5], n[6]});
  return shaped(SolidShape::Hex8, {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]});
}

bool is_triangle(const ShellElement& element) {
  return !element.nodes[3].given() || element.nodes[3] == element.nodes[2];
}

std::vector<std::pair<double, double>> scaled_points(const DeckCurve& curve) {
  std::vector<std::pair<double, double>> points = curve.points;
  for (auto& [x, y] : points) {
    x = curve.x_scale * (x + curve.x_offset);
    y = curve.y_scale * (y + curve.y_offset);
  }
  return points;
}

Place Deck::place(Source source) const {
  if (source.file < 0 || source.file >= static_cast<std::int32_t>(files.names.size()))
    return {.file = "generated deck", .line = 0, .column = 0};
  return {
      .file = files.names[static_cast<std::size_t>(source.file)], .line = source.line, .column = 0};
}

}  // namespace crosswalk::fe
