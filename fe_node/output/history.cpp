#include "fe_node/output/history.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "common/error.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {
namespace {

void open(std::ofstream& file, const std::filesystem::path& path, const char* head) {
  file.open(path);
  file << head << '\n';
  if (!file)
    throw UserError(Problem{{path.string()}, "history file", "a place to write to", "none", {}});
}

/// A title as a CSV field.
std::string field(std::string name) {
  std::replace(name.begin(), name.end(), ',', ';');
  return name;
}

/// Block and block-local element of each mesh element of a kind.
std::map<std::pair<ElementKind, int>, std::pair<int, int>> places_of(const Model& model) {
  std::map<std::pair<ElementKind, int>, std::pair<int, int>> places;
  for (int b = 0; b < static_cast<int>(model.blocks.size()); ++b)
    for (int e = 0; e < model.blocks[b]->element_count(); ++e)
      places[{model.blocks[b]->kind(), model.blocks[b]->mesh_element(e)}] = {b, e};
  return places;
}

}  // namespace

HistoryWriter::HistoryWriter(const Model& model, HistoryRequests requests,
                             const std::filesystem::path& folder, Scratch& scratch)
    : model_(model), requests_(std::move(requests)) {
  std::filesystem::create_directories(folder);
  const auto places = places_of(model);
  std::erase_if(requests_.elements, [&](const auto& e) { return !places.contains(e); });
  for (const auto& element : requests_.elements)
    places_.push_back({places.at(element).first, places.at(element).second});
  for (const SectionCut& section : requests_.sections)
    section_forces_.emplace_back(model, section, scratch);
  if (!requests_.nodes.empty())
    open(nodes_, folder / "nodes.csv",
         "time_s,node,x_m,y_m,z_m,ux_m,uy_m,uz_m,vx_m_s,vy_m_s,vz_m_s");
  if (!places_.empty())
    open(elements_, folder / "elements.csv",
         "time_s,element,sxx_Pa,syy_Pa,szz_Pa,sxy_Pa,syz_Pa,szx_Pa,plastic_strain,energy_J,alive");
  if (!requests_.sections.empty())
    open(sections_, folder / "sections.csv", "time_s,section,fx_N,fy_N,fz_N,mx_N_m,my_N_m,mz_N_m");
  if (!model.contacts.empty())
    open(contacts_, folder / "contacts.csv",
         "time_s,contact,fx_N,fy_N,fz_N,stored_J,friction_J,damping_J,largest_penetration_m,nodes");
}

Wrench HistoryWriter::section_force(const State& state, const Scratch& scratch, int section) const {
  Vec3 centre = Vec3::Zero();
  const std::vector<int>& nodes = requests_.sections[section].nodes;
  for (int n : nodes) centre += state.nodes[n].position() / static_cast<double>(nodes.size());
  return section_forces_[section].about(centre, state, scratch);
}

void HistoryWriter::write(const State& state, const Scratch& scratch) {
  for (int n : requests_.nodes) {
    const Vec3 x = state.nodes[n].position(), u = x - model_.mesh.position[n],
               v = state.nodes[n].velocity();
    fmt::print(nodes_, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
               state.time, model_.mesh.node_id[n].value, x.x(), x.y(), x.z(), u.x(), u.y(), u.z(),
               v.x(), v.y(), v.z());
  }
  write_elements(state);
  for (int s = 0; s < static_cast<int>(requests_.sections.size()); ++s) {
    const Wrench w = section_force(state, scratch, s);
    fmt::print(sections_, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", state.time,
               field(requests_.sections[s].name), w.f.x(), w.f.y(), w.f.z(), w.tau.x(), w.tau.y(),
               w.tau.z());
  }
  write_contacts(state, scratch);
}

void HistoryWriter::write_elements(const State& state) {
  const StepContext context{state.nodes, state.spin, state.time, 0, false};
  for (const Place& place : places_) {
    const ElementBlock& block = *model_.blocks[place.block];
    const ElementSample s = block.sample(context, state.history[place.block], place.element);
    const DeckId id = model_.mesh.table(block.kind()).id[block.mesh_element(place.element)];
    fmt::print(elements_, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{}\n",
               state.time, id.value, s.stress(0, 0), s.stress(1, 1), s.stress(2, 2), s.stress(0, 1),
               s.stress(1, 2), s.stress(2, 0), s.plastic_strain, s.energy, s.is_alive ? 1 : 0);
  }
}

void HistoryWriter::write_contacts(const State& state, const Scratch& scratch) {
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ContactReport& r = scratch.contact_reports[c];
    const ContactHistory& sum = state.contacts[c];
    fmt::print(contacts_, "{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{}\n",
               state.time, field(model_.contacts[c]->name()), r.force.x(), r.force.y(), r.force.z(),
               r.stored, sum.friction_dissipated, sum.damping_dissipated, r.max_penetration,
               r.active);
  }
}

}  // namespace crosswalk::fe
