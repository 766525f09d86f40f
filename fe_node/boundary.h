// The coupling boundary: chosen rigid bodies of the model follow bodies of the multibody side
// inside a window and give back the impulse they exert.
//
// Attached bodies obey V_{j+1} = V_j + d (A + W (F_j - bias)) at every substep, where A is the mean
// acceleration without the wrench beyond the bias and W the mobility of the multibody system, so
// the velocity of both sides agrees at the fine scale without iterations (mobility-based
// staggering; the operator of [gravouil2001] with a rigid interface). The pose gap at the window's
// start is removed with a time constant of kGapTime, slow against every stiff mode. Without a
// mobility (schemes `implicit` and `staggered`) they follow the drive and its change alone.
// Followers only lend contact surfaces: they follow the drive exactly. Wrenches are "fe on mb"
// about the moving reference point, world axes.
#pragma once

#include <vector>

#include "common/exchange.h"
#include "fe_node/explosion.h"
#include "fe_node/solver.h"

namespace crosswalk::fe {

/// Gaps decay as exp(-t / kGapTime). Shorter ones (1 to 20 windows of 10 us) excite the stiffest
/// modes and grow; 5 ms leaves gaps of micrometres.
inline constexpr double kGapTime = 5e-3;

struct Boundary {
  std::vector<int> bodies;  ///< index into Model::bodies per interface body, attached ones first
  int attached = 0;
};

/// Makes the frame of each interface body that of its multibody partner: nodes keep their places,
/// the origin becomes the reference point. Returns the masses handed over, about that point in W
/// axes.
std::vector<Inertia> rebase_bodies(const Boundary& boundary,
                                   const std::vector<InterfaceBody>& partners, Model& model,
                                   State& state);

/// Twists of a block about its own mass centre over the first and the last substep of a window:
/// the way of that point by the step's length, and the turning.
struct BlockTwists {
  Twist first, last;
};

struct WindowLoads {
  std::vector<BodyLoad> loads;
  int substeps = 0;
  double step = 0;                  ///< s, of each
  std::vector<BlockTwists> blocks;  ///< of the attached bodies
};

/// Advances the model by one window in equal substeps of at most settings.step_scale times the
/// stable step. Throws NumericalError, also when `watch`, if there is one, sees the run explode.
WindowLoads advance_window(const Model& model, const Boundary& boundary, const FeGrant& grant,
                           State& state, Scratch& scratch, ExplosionWatch* watch = nullptr);

}  // namespace crosswalk::fe
