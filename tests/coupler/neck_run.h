// A coupled run of the lattice neck by direct calls, and what became of one.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "coupler/scheme.h"
#include "tests/coupler/neck_on_bodies.h"
#include "tests/coupler/toy_nodes.h"

namespace crosswalk::coupling {

struct NeckOutcome {
  Vec3 head = Vec3::Zero();
  double energy = 0, peak_energy = 0;  ///< J, of both sides
  double drift = 0;                    ///< J, sum of the interface works of both sides
  double gap = 0;                      ///< m, largest
  double passes = 0;                   ///< of fe per window, mean
  Vec3 momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();  ///< pending carry included
  bool is_stable = true;
};

/// On one body, pushed so that a light one does not fly away.
inline NeckCase pushed_neck(double body_mass, double damping_ratio = 0.05) {
  return {.body_mass = body_mass,
          .damping_ratio = damping_ratio,
          .push = std::min(1500.0, 300 * body_mass + 200)};
}

class CoupledNeck {
 public:
  CoupledNeck(const NeckCase& c, Scheme scheme)
      : mb_(c), fe_(c), mb_link_(mb_, sink_), fe_link_(fe_, sink_) {
    mb_.attach(fe_.place(mb_.interface_bodies()));
    state_ = start_state(mb_.interface_bodies());
    settings_ = {.scheme = scheme,
                 .n_attached = mb_.attached(),
                 .tolerance = 1e-6,
                 .accepted_residual = 1e-3};
  }

  WindowResult advance(std::int64_t window_ns) {
    return advance_window(settings_, state_, window_ns, mb_link_, fe_link_);
  }
  NeckOutcome run(std::int64_t window_ns, double end) {
    constexpr double kBlownUp = 1e4;  // J; the cases hold some ten
    NeckOutcome outcome;
    const auto windows = static_cast<int>(std::lround(1e9 * end / double(window_ns)));
    for (int i = 0; i < windows && outcome.is_stable; ++i) {
      try {
        const WindowResult result = advance(window_ns);
        outcome.energy = result.mb.energy.kinetic + fe_.energy();
        outcome.drift = result.mb.energy.interface_work + result.fe.interface_work;
        outcome.passes += double(result.iterations) / windows;
        for (const BodyLoad& load : result.fe.loads)
          outcome.gap = std::max(outcome.gap, load.gap_position.norm());
        outcome.peak_energy = std::max(outcome.peak_energy, outcome.energy);
        outcome.is_stable = outcome.energy < kBlownUp;
      } catch (const NumericalError&) {
        outcome.is_stable = false;
      }
    }
    note_now(outcome);
    return outcome;
  }
  /// Where the head is, and the momenta.
  void note_now(NeckOutcome& outcome) const {
    outcome.head = fe_.head();
    outcome.momentum = mb_.world().linear_momentum() + fe_.momentum();
    outcome.angular_momentum = mb_.world().angular_momentum(Vec3::Zero()) + fe_.angular_momentum();
    for (std::size_t k = 0; k < state_.carry.size(); ++k) {
      const Vec3 f = state_.carry[k].head<3>(), tau = state_.carry[k].tail<3>();
      outcome.momentum += f;
      outcome.angular_momentum += tau + state_.motion[k].X_WB.p.cross(f);
    }
  }

  NeckBodies& mb() { return mb_; }
  LatticeNeck& fe() { return fe_; }
  CouplingState& state() { return state_; }

 private:
  toy::NoRecords sink_;
  NeckBodies mb_;
  LatticeNeck fe_;
  DirectMbLink mb_link_;
  DirectFeLink fe_link_;
  CouplingState state_;
  SchemeSettings settings_;
};

}  // namespace crosswalk::coupling
