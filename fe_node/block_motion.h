// The motion of the coupling blocks of a run as a keyword deck: `crosswalk solve` of
// model/driven.k moves the head as the coupled run did, as long as nothing touches it.
//
// driven.k includes head_neck.k and prescribes all six velocities of each block, in the deck's
// axes, by one curve each (model/driven/<body>_<direction>.k). A curve has the block's velocity in
// the middle of the first and the last step of every window; between these it is straight within
// round-off of the forces. The step of every window is a curve as well (*CONTROL_TIMESTEP, LCTM).
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "fe_node/boundary.h"
#include "fe_node/deck/deck.h"

namespace crosswalk::fe {

struct DrivenBlock {
  std::string body;  ///< of the interface
  int part = 0;      ///< rigid part of the deck
};

struct BlockMotionSetup {
  std::vector<DrivenBlock> blocks;
  UnitSystem units = UnitSystem::MmTonneS;
  Pose X_WD;  ///< of the deck at the start
  Twist V_WD;
  Vec3 gravity = Vec3::Zero();       ///< m/s2, W
  double least_step = 0;             ///< s, unscaled: nodes that needed less got mass
  double step_scale = 0.9;           ///< of the run
  std::string deck = "head_neck.k";  ///< beside driven.k
};

class BlockMotionLog {
 public:
  /// Writes folder/driven.k; the curves start with the first window, or go on where they were.
  BlockMotionLog(BlockMotionSetup setup, const std::filesystem::path& folder);

  /// A window that is kept, from `begin` on.
  void add(double begin, const WindowLoads& window);
  /// Drops what lies after `time`: a run resumed from a checkpoint.
  void continue_after(double time);

 private:
  struct Curve {
    std::filesystem::path path;
    std::ofstream file;
  };
  void start_curves();
  void open_curves(std::ios::openmode mode);
  void write_deck(const std::filesystem::path& folder) const;

  BlockMotionSetup setup_;
  std::vector<Curve> curves_;  ///< six of each block, then the step
};

}  // namespace crosswalk::fe
