// The last frame of a run worth looking at, written when the run is stopped.
#pragma once

#include <filesystem>

#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

class LastSound {
 public:
  /// Copies the state when its energies balance to a few per cent.
  void keep(const State& state);
  /// Writes the state one step before `failed`, or where its energies were no longer sound the one
  /// kept last, as a field file below `folder`, and logs its time and place.
  void write(const Model& model, const State& failed, const std::filesystem::path& folder) const;

 private:
  State kept_;
};

}  // namespace crosswalk::fe
