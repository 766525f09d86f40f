// The coupling schemes: what is exchanged in one window, and what is carried to the next.
//
// Notation (docs/coupling.md): H window length; V twist of the interface bodies, 6 numbers each, at
// their reference points in W; J the impulse fe exerts on the bodies in a window; b the wrench mb
// assumed (bias); C = J - b H the impulse mb still owes (carry); M the mobility, the twist change
// of the attached bodies per unit impulse with all joints of the multibody system acting.
#pragma once

#include <string_view>
#include <vector>

#include "common/byte_archive.h"
#include "coupler/participant_link.h"

namespace crosswalk::coupling {

enum class Scheme : int { Mic = 0, Implicit = 1, Staggered = 2 };

struct SchemeSettings {
  Scheme scheme = Scheme::Mic;
  int n_attached = 0;
  int mobility_every = 50;  ///< windows between measurements of the mobility, at most
  // implicit only:
  double tolerance = 1e-4;          ///< relative change of the wrench at which a window is done
  double accepted_residual = 1e-3;  ///< still accepted after max_iterations, and counted
  int max_iterations = 20;
  int anderson_depth = 5;
  int most_parts = 8;  ///< of a window that does not converge as a whole
};

/// What one window leaves to the next. A value: a checkpoint is a copy.
struct CouplingState {
  std::int64_t window = 0;              ///< the next one
  std::vector<BodyMotion> motion;       ///< of the interface bodies, now
  std::vector<Vec6> bias, bias_before;  ///< N, N m: for the next window; of the last window
  std::vector<Vec6> carry;              ///< N s, N m s
  Eigen::MatrixXd mobility;             ///< 6 n x 6 n of the attached bodies; empty before measured
  bool mobility_is_due = true;
  std::int64_t mobility_window = 0;  ///< measured at the start of this window
};

/// Everything known about a finished window.
struct WindowResult {
  WindowId id;
  MbReply mb;
  FeReply fe;
  int iterations = 1;   ///< passes of fe
  double residual = 0;  ///< of the implicit iteration
  bool converged = true;
  int parts = 1;  ///< in which the window was done
};

/// Bodies at t = 0, no load, mobility to be measured.
CouplingState start_state(const std::vector<InterfaceBody>& bodies);

/// The state as bytes, for checkpoints.
void save(const CouplingState& state, ByteWriter& out);
CouplingState load_coupling_state(ByteReader& in);

/// Advances both sides by one window of window_ns and updates the state.
WindowResult advance_window(const SchemeSettings& settings, CouplingState& state,
                            std::int64_t window_ns, MbLink& mb, FeLink& fe);
/// A multibody pedestrian alone: one call, no interface loads.
WindowResult advance_multibody(CouplingState& state, std::int64_t window_ns, MbLink& mb);

std::string_view scheme_name(Scheme scheme);

}  // namespace crosswalk::coupling
