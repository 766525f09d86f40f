// The coupled pedestrian in free flight: the multibody body with the generated head and neck on it,
// thrown and spun, no gravity, no car near, the harness keeping off the ground. Nothing acts from
// outside, so the momenta of both sides together stay what they were, whatever passes the seam.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupler/scheme.h"
#include "fe_node/fe_node.h"
#include "mb_node/mb_node.h"
#include "tests/coupler/toy_nodes.h"
#include "tests/source_folder.h"

namespace crosswalk::coupling {
namespace {

constexpr std::int64_t kWindow = 20'000;  // ns

ConfigDocument flight(double mb_step, const std::string& precision) {
  ConfigDocument document(source_folder() / "scenarios/tests/v2370.toml");
  document.override_with(
      fmt::format("[run]\nfidelity = \"coarse\"\n"
                  "[posture]\nwalking_speed_m_s = 5.0\nspin_x_rad_s = 12.0\nspin_y_rad_s = 4.0\n"
                  "spin_z_rad_s = 15.0\n[vehicle]\nspeed_km_h = 0.0\ngap_mm = 900.0\n"
                  "[windshield]\nmodel = \"rigid\"\n[environment]\ngravity_m_s2 = 0.0\n"
                  "[output]\nfield_interval_ms = 0\n[multibody]\nsubstep_us = {}\n"
                  "[fe]\nprecision = \"{}\"\n",
                  1e6 * mb_step, precision),
      "flight");
  return document;
}

mb::MbConfig mb_config(double mb_step) {
  ConfigDocument document = flight(mb_step, "double");
  return mb::read_mb_config(document, read_scenario(document));
}
fe::FeConfig fe_config(const std::string& precision) {
  ConfigDocument document = flight(1e-5, precision);
  return fe::read_fe_config(document, read_scenario(document));
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  ///< about the pelvis's place at the start
};

/// Of what the finite-element side moves itself: nodes outside rigid bodies and free rigid bodies.
/// Velocities lie half a step before positions; paired with the positions of their own time.
Momenta momenta_of(const fe::Model& model, const fe::State& state, const Vec3& about) {
  Momenta m;
  const auto add = [&](double mass, const Vec3& position, const Vec3& v) {
    m.linear += mass * v;
    m.angular += mass * (position - about - 0.5 * state.last_dt * v).cross(v);
  };
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    if (model.body_of_node[n] >= 0) continue;
    add(model.mass[n], state.nodes[n].position(), state.nodes[n].velocity());
    if (model.has_rotations()) m.angular += model.inertia[n] * state.spin[n];
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].role != fe::BodyRole::Free) continue;
    add(model.bodies[b].inertia.mass, state.bodies[b].X_WB.p, state.bodies[b].V_WB.v);
    m.angular += state.bodies[b].angular_momentum;
  }
  return m;
}

class Flight {
 public:
  Flight(double mb_step, const std::string& precision)
      : mb_(mb_config(mb_step)),
        fe_(fe_config(precision), 1, {}),
        mb_link_(mb_, sink_),
        fe_link_(fe_, sink_) {
    const std::vector<InterfaceBody> bodies = fe_.place(mb_.interface_bodies());
    mb_.attach(bodies);
    state_ = start_state(bodies);
    for (const InterfaceBody& body : bodies) {
      settings_.n_attached += body.is_attached ? 1 : 0;
      blocks_ += body.block.mass;
    }
  }
  WindowResult advance() { return advance_window(settings_, state_, kWindow, mb_link_, fe_link_); }
  double mass() const {
    double mass = fe_.built().model.total_mass();
    for (int i = 0; i < mb_.world().body_count(); ++i) mass += mb_.world().mass(i);
    return mass - blocks_;
  }
  /// Of both sides and of the impulses fe has given and mb has not yet got.
  Momenta momenta() const {
    const Vec3& about = mb_.model().X_WB0[0].p;
    Momenta m = momenta_of(fe_.built().model, fe_.state(), about);
    m.linear += mb_.world().linear_momentum();
    m.angular += mb_.world().angular_momentum(about);
    for (std::size_t k = 0; k < state_.carry.size(); ++k) {
      const Vec3 f = state_.carry[k].head<3>(), tau = state_.carry[k].tail<3>();
      m.linear += f;
      m.angular += tau + (state_.motion[k].X_WB.p - about).cross(f);
    }
    return m;
  }

 private:
  toy::NoRecords sink_;
  mb::MbNode mb_;
  fe::FeNode fe_;
  DirectMbLink mb_link_;
  DirectFeLink fe_link_;
  CouplingState state_;
  SchemeSettings settings_;
  double blocks_ = 0;  ///< kg, on both sides' scales
};

/// Held and lost on both sides. Not what the books keep for the ground under held feet: the
/// harness lets them pass through it without a force.
double energy_of(const WindowResult& r) {
  return r.mb.energy.held() - r.mb.energy.contact_elastic + r.fe.kinetic + r.fe.internal +
         r.fe.hourglass + r.fe.contact + r.fe.damping;
}

struct Errors {
  double linear = 0, angular = 0;  ///< largest, relative
  double energy = 0;               ///< largest, of the turning's energy
  double drift = 0;                ///< sum of both sides' interface works, likewise
  double exchanged = 0;            ///< N s: of the impulses through the seam
};

Errors fly(double mb_step, const std::string& precision) {
  constexpr int kWindows = 120;
  Flight flight(mb_step, precision);
  const Momenta start = flight.momenta();
  Errors worst;
  double first = 0;
  for (int i = 0; i < kWindows; ++i) {
    const WindowResult r = flight.advance();
    if (i == 0) first = energy_of(r);
    const Momenta now = flight.momenta();
    const double turning = first - 0.5 * start.linear.squaredNorm() / flight.mass();
    const auto note = [](double& most, double error) { most = std::max(most, std::abs(error)); };
    note(worst.linear, (now.linear - start.linear).norm() / start.linear.norm());
    note(worst.angular, (now.angular - start.angular).norm() / start.angular.norm());
    note(worst.energy, (energy_of(r) - first) / turning);
    note(worst.drift, (r.mb.energy.interface_work + r.fe.interface_work) / turning);
    for (const BodyLoad& load : r.fe.loads) worst.exchanged += load.impulse.head<3>().norm();
  }
  fmt::print(
      "step {:g} us, {}: linear {:.1e}, angular {:.1e}, energy {:.1e}, drift {:.1e}; {:.3f} N s "
      "through the seam\n",
      1e6 * mb_step, precision, worst.linear, worst.angular, worst.energy, worst.drift,
      worst.exchanged);
  return worst;
}

TEST(FreePedestrian, KeepsItsMomentaAcrossTheSeam) {
  const Errors coarse = fly(10e-6, "double"), fine = fly(5e-6, "double");
  const Errors rounded = fly(10e-6, "single");
  for (const Errors& e : {coarse, fine, rounded}) {
    EXPECT_GT(e.exchanged, 0.1);
    EXPECT_LT(e.energy, 1e-5);
    EXPECT_LT(e.drift, 1e-5);
    // The carried impulse acts where the body has got to meanwhile, and the engine turns bodies by
    // steps of first order.
    EXPECT_LT(e.angular, 1e-6);
  }
  // What leaves fe enters mb or is carried: round-off.
  EXPECT_LT(std::max(coarse.linear, fine.linear), 1e-13);
  // As coupled runs compute, the forces of an element's corners cancel to single precision only.
  EXPECT_LT(rounded.linear, 1e-9);
  EXPECT_LT(fine.angular, 0.7 * coarse.angular);
}

}  // namespace
}  // namespace crosswalk::coupling
