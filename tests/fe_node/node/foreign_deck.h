// A generated head and neck as somebody else's pre-processor might have left it: every record
// renumbered and in another order, parts and sets under other titles, other axes (the face looks
// along -y, the vertex is +x), no unit statement.
#pragma once

#include <algorithm>
#include <string>

#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

/// Rotation from the generator's axes N (forward, left, up) to the foreign ones.
inline Mat3 foreign_axes() {
  Mat3 R_DN;
  R_DN.col(0) = -Vec3::UnitY();  // forward
  R_DN.col(1) = -Vec3::UnitZ();  // left
  R_DN.col(2) = Vec3::UnitX();   // up
  return R_DN;
}

/// A number of one kind of record in the foreign deck; keeps "not given".
inline DeckId foreign_id(DeckId id) { return id.given() ? DeckId(40'000'007 - 3 * id.value) : id; }
inline DeckId foreign_part(DeckId id) { return id.given() ? DeckId(700'000 + id.value) : id; }

inline std::string foreign_title(const std::string& title) {
  if (title == "block_torso_up") return "RIGID T2-T3";
  if (title == "block_clavicle_l") return "SHOULDER L";
  if (title == "block_clavicle_r") return "SHOULDER R";
  std::string upper = "HUM_" + title;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return upper;
}

template <class Elements>
void renumber_elements(Elements& elements) {
  for (auto& element : elements) {
    element.id = foreign_id(element.id);
    element.part = foreign_part(element.part);
    for (DeckId& node : element.nodes) node = foreign_id(node);
  }
  std::reverse(elements.begin(), elements.end());
}

/// Part numbers of a part set of the generated deck, as the foreign deck has them: "701000, ...".
inline std::string foreign_parts(const Deck& generated, const std::string& set) {
  std::string names;
  for (const DeckSet& s : generated.sets)
    if (s.kind == SetKind::Part && s.title == set)
      for (const DeckId part : s.ids)
        names += (names.empty() ? "" : ", ") + std::to_string(foreign_part(part).value);
  return names;
}

inline Deck foreign_deck(Deck deck) {
  deck.title = "head and neck, exported";
  deck.units = UnitSystem::Unknown;
  for (DeckNode& node : deck.nodes) {
    node.id = foreign_id(node.id);
    node.position = foreign_axes() * node.position;
  }
  std::reverse(deck.nodes.begin(), deck.nodes.end());
  renumber_elements(deck.solids);
  renumber_elements(deck.shells);
  renumber_elements(deck.beams);
  renumber_elements(deck.discretes);
  for (MassElement& mass : deck.masses) {
    mass.id = foreign_id(mass.id);
    mass.target = foreign_id(mass.target);
  }
  for (Part& part : deck.parts) {
    part.id = foreign_part(part.id);
    part.title = foreign_title(part.title);
    part.section = foreign_id(part.section);
    part.material = foreign_id(part.material);
    part.hourglass = foreign_id(part.hourglass);
  }
  std::reverse(deck.parts.begin(), deck.parts.end());
  for (Section& section : deck.sections) section.id = foreign_id(section.id);
  for (Hourglass& hourglass : deck.hourglasses) hourglass.id = foreign_id(hourglass.id);
  for (Material& material : deck.materials) {
    material.id = foreign_id(material.id);
    material.title.clear();
    if (auto* spring = std::get_if<mat::SpringNonlinearElastic>(&material.law)) {
      spring->curve = foreign_id(spring->curve);
      spring->rate_curve = foreign_id(spring->rate_curve);
    }
    if (auto* cable = std::get_if<mat::CableDiscreteBeam>(&material.law))
      cable->curve = foreign_id(cable->curve);
  }
  for (DeckCurve& curve : deck.curves) curve.id = foreign_id(curve.id);
  std::erase_if(deck.sets, [](const DeckSet& set) { return set.kind == SetKind::Part; });
  for (DeckSet& set : deck.sets) {
    set.id = foreign_id(set.id);
    set.title = set.title == "skull_fit" ? "CRANIUM INSIDE" : "";
    for (DeckId& node : set.ids) node = foreign_id(node);
  }
  for (ExtraNodes& extra : deck.extra_nodes) {
    extra.part = foreign_part(extra.part);
    extra.target = foreign_id(extra.target);
  }
  return deck;
}

}  // namespace crosswalk::fe
