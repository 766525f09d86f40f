// Histories of a run as CSV tables, W, SI: nodes.csv, elements.csv, sections.csv and contacts.csv,
// each only when something of its kind was asked for or is in the model.
//
// Rows are of the time of the positions and forces; velocities are of half a step before. A section
// force is what the named elements of one side exert on the section's nodes, its moment about the
// nodes' present centre. A contact's force is that on its first side (a joint's on its first body).
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "fe_node/history_requests.h"
#include "fe_node/model.h"
#include "fe_node/output/section_force.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

struct Scratch;

class HistoryWriter {
 public:
  /// Makes the folder; throws UserError when it cannot be written to. Sections need their corners
  /// kept in `scratch` from now on.
  HistoryWriter(const Model& model, HistoryRequests requests, const std::filesystem::path& folder,
                Scratch& scratch);
  /// Right after compute_forces().
  void write(const State& state, const Scratch& scratch);

  /// Force and moment of a section.
  Wrench section_force(const State& state, const Scratch& scratch, int section) const;

 private:
  struct Place {
    int block = 0, element = 0;
  };
  void write_elements(const State& state);
  void write_contacts(const State& state, const Scratch& scratch);

  const Model& model_;
  HistoryRequests requests_;
  std::vector<Place> places_;
  std::vector<SectionForce> section_forces_;
  std::ofstream nodes_, elements_, sections_, contacts_;
};

}  // namespace crosswalk::fe
