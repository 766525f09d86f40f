// The generated head without a neck in component tests: its mesh, its sensors, its energies.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "fe_node/generate/head_neck.h"
#include "fe_node/output/head_motion.h"
#include "fe_node/validate/deck_case.h"
#include "fe_node/validate/measure.h"

namespace crosswalk::fe::validate {

inline constexpr double kSampling = 1e-4;      ///< s; its mean acts like a filter of class 1000
inline constexpr double kAddedMass = 0.005;    ///< share that mass scaling may add
inline constexpr double kPatchRadius = 0.015;  ///< m, of pressure patches

struct FreeHead {
  explicit FreeHead(generate::Fidelity fidelity);

  Vec3 cranial_centre() const { return marks.tragion + Vec3(0, 0, 0.040); }
  /// The outermost skin node in a direction.
  Vec3 support(const Vec3& direction) const;
  /// The outermost node of the brain on the ray from the cranial centre.
  Vec3 brain_surface(const Vec3& direction) const;

  generate::ModelDraft draft;
  generate::Landmarks marks;
  std::vector<int> skin;  ///< nodes of scalp and face
};

/// Motion of the head's centre from the rigid fit of the skull, averaged over the sampling
/// interval.
class HeadSensor {
 public:
  explicit HeadSensor(const DeckRun& run);

  void sample(const State& state);
  double peak() const;  ///< m/s2
  double time_of_peak() const;
  double hic15() const;
  Series series(const std::string& label) const;  ///< g over ms

  std::vector<double> time, acceleration;
  std::vector<Vec3> velocity;

 private:
  HeadMotion motion_;
  double last_ = 0;
  Twist before_;
};

/// Mean pressure of the brain within a radius of a place of the undeformed head, Pa.
class PressurePatch {
 public:
  PressurePatch(const DeckRun& run, const Vec3& centre, double radius);
  double pressure(const DeckRun& run) const;

 private:
  std::vector<std::pair<int, int>> elements_;  ///< block and element
};

/// Blocks of the model that belong to a part set of the deck.
std::vector<int> blocks_of(const DeckRun& run, const std::string& part_set);

std::string energy_note(const DeckRun& run);

}  // namespace crosswalk::fe::validate
