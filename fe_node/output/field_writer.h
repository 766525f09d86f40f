// Fields for ParaView: one .vtu (raw appended data) per instant and one .pvd that lists them.
// Points in W; cell data per element: part id, pressure, von Mises stress, first principal strain;
// point data: velocity. Rigid parts are drawn with zero stress.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

class FieldWriter {
 public:
  /// Makes the folder; throws UserError when it cannot.
  FieldWriter(const Model& model, std::filesystem::path folder);
  /// Returns the file written, relative to the folder. Throws UserError when the disk refuses.
  std::filesystem::path write(const State& state);
  /// After a restart: goes on behind the frames that are in the folder up to this time, s.
  void continue_after(double time);

 private:
  const Model& model_;
  std::filesystem::path folder_;
  struct Frame {
    double time;
    std::string file;
  };
  std::vector<Frame> frames_;
};

}  // namespace crosswalk::fe
