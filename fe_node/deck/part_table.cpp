#include "fe_node/deck/part_table.h"

#include <array>
#include <numbers>
#include <unordered_map>

#include "fe_node/deck/element_measure.h"

namespace crosswalk::fe {

namespace {

class Builder {
 public:
  explicit Builder(const DeckIndex& index) : index_(index), deck_(index.deck()) {
    for (const Part& part : deck_.parts) {
      row_of_.emplace(part.id, table_.rows.size());
      table_.rows.emplace_back().part = &part;
    }
  }

  PartTable run() {
    for (const SolidElement& element : deck_.solids) solid(element);
    for (const ShellElement& element : deck_.shells) shell(element);
    for (const ThickShellElement& element : deck_.thick_shells) row(element.part, "thick shell");
    for (const BeamElement& element : deck_.beams) beam(element);
    for (const DiscreteElement& element : deck_.discretes) row(element.part, "discrete");
    for (const SeatbeltElement& element : deck_.seatbelts) seatbelt(element);
    for (const MassElement& element : deck_.masses) mass(element);
    for (const InertiaElement& element : deck_.inertias) table_.nodal_mass += element.mass;
    for (PartRow& row : table_.rows)
      if (row.part->inertia) row.mass = row.part->inertia->mass;
    return std::move(table_);
  }

 private:
  /// The row of a part, its count of `kind` raised; null when there is no such part.
  PartRow* row(DeckId part, const char* kind) {
    ++table_.elements[kind];
    const auto at = row_of_.find(part);
    if (at == row_of_.end()) return nullptr;
    PartRow& row = table_.rows[at->second];
    ++row.elements[kind];
    return &row;
  }

  double density(const Part& part) const {
    const Material* material = index_.material(part.material);
    return material == nullptr ? 0 : material->density;
  }

  bool positions(std::span<const DeckId> ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const DeckNode* node = index_.node(ids[i]);
      if (node == nullptr) return false;
      x_[i] = node->position;
    }
    return true;
  }

  void solid(const SolidElement& element) {
    const ShapedSolid shaped = solid_shape(element);
    const std::size_t count = static_cast<std::size_t>(shaped.count);
    PartRow* part = row(element.part, solid_shape_name(shaped.shape));
    if (part == nullptr || !positions({shaped.nodes.data(), count})) return;
    part->mass += density(*part->part) * solid_measure(shaped.shape, {x_.data(), count}).size;
  }

  /// Thickness of one element: its own, the layers', or the section's.
  double thickness(const ShellElement& element, const Part& part) const {
    double own = 0;
    for (const double corner : element.thickness) own += corner / 4;
    if (own > 0) return own;
    const Section* section = index_.section(part.section);
    const auto* shell = section == nullptr ? nullptr : std::get_if<SectionShell>(&section->law);
    if (shell == nullptr) return 0;
    double mean = 0;
    for (const double corner : shell->thickness) mean += corner / 4;
    return mean;
  }

  double area_density(const ShellElement& element, const Part& part) const {
    if (!part.composite) return density(part) * thickness(element, part);
    double sum = part.composite->area_mass;
    for (const CompositeLayer& layer : part.composite->layers)
      if (const Material* material = index_.material(layer.material))
        sum += material->density * layer.thickness;
    return sum;
  }

  void shell(const ShellElement& element) {
    const std::size_t count = is_triangle(element) ? 3 : 4;
    const std::span<const DeckId> nodes(element.nodes.data(), count);
    PartRow* part = row(element.part, count == 3 ? "tri3" : "quad4");
    if (part == nullptr || !positions(nodes)) return;
    part->mass += area_density(element, *part->part) * shell_measure({x_.data(), count}).size;
  }

  void beam(const BeamElement& element) {
    PartRow* part = row(element.part, "beam");
    if (part == nullptr || !positions(std::span(element.nodes).first(2))) return;
    const Section* section = index_.section(part->part->section);
    const auto* beam = section == nullptr ? nullptr : std::get_if<SectionBeam>(&section->law);
    if (beam == nullptr) return;
    const double length = (x_[1] - x_[0]).norm();
    const double volume = beam->formulation == 6
                              ? (beam->volume > 0 ? beam->volume : beam->cable_area * length)
                              : beam_area(*beam) * length;
    part->mass += density(*part->part) * volume + beam->length_mass * length;
  }

  void seatbelt(const SeatbeltElement& element) {
    PartRow* part = row(element.part, "seatbelt");
    if (part == nullptr || !positions(element.nodes)) return;
    const Material* material = index_.material(part->part->material);
    if (material == nullptr) return;
    if (const auto* belt = std::get_if<mat::Seatbelt>(&material->law))
      part->mass += belt->length_mass * (x_[1] - x_[0]).norm();
  }

  void mass(const MassElement& element) {
    ++table_.elements["mass"];
    if (element.kind != MassTarget::Part) {
      table_.nodal_mass += element.mass;
      return;
    }
    const auto at = row_of_.find(element.target);
    if (at == row_of_.end()) return;
    PartRow& row = table_.rows[at->second];
    row.added_mass += element.final_mass > 0 ? element.final_mass - row.mass : element.mass;
  }

  const DeckIndex& index_;
  const Deck& deck_;
  PartTable table_;
  std::unordered_map<DeckId, std::size_t> row_of_;
  std::array<Vec3, 10> x_;
};

}  // namespace

double PartTable::mass() const {
  double sum = nodal_mass;
  for (const PartRow& row : rows) sum += row.mass + row.added_mass;
  return sum;
}

double beam_area(const SectionBeam& beam) {
  if (beam.formulation == 2 || beam.formulation == 3) return beam.area;
  if (beam.formulation == 6) return 0;
  const double outer = beam.outer_s[0], inner = beam.outer_t[0];
  if (beam.cross_section == 1 || beam.formulation == 9)
    return std::numbers::pi / 4 * (outer * outer - inner * inner);
  return outer * inner;  // rectangle: TS is the height along s, TT the width along t
}

PartTable part_table(const DeckIndex& index) { return Builder(index).run(); }

}  // namespace crosswalk::fe
