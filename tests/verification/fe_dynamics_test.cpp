// Closed-form dynamics of the hexahedral solver, computed in double and in single precision.
#include <gtest/gtest.h>

#include "fe_node/solver.h"
#include "tests/fe_node/box_model.h"

namespace crosswalk::fe {
namespace {

/// Runs to `end` with steps of at most `scale` times the stable one; calls `watch` after each step.
template <class Watch>
void run_until(const Model& model, State& state, double end, double scale, Watch&& watch) {
  Scratch scratch(model, 1);
  const int steps = static_cast<int>(std::ceil(end / (scale * initial_stable_step(model))));
  for (int i = 0; i < steps; ++i) {
    advance_step(model, state, scratch, end / steps);
    watch();
  }
}

class FeDynamics : public testing::TestWithParam<Precision> {
 protected:
  bool is_double() const { return GetParam() == Precision::Double; }
  ElementControls controls() const { return {.precision = GetParam()}; }
};

// A bar flies against a wall (one end held): behind the front the bar rests under the stress rho c
// v, and the front runs at c = sqrt(E / rho) [achenbach1973, 1.2].
TEST_P(FeDynamics, ElasticWaveInABarHasTheRightSpeedAndStress) {
  constexpr double kYoung = 210e9, kDensity = 7850, kSpeed = 2.0, kLength = 1.0;
  const Box box{200, 1, 1, {kLength, 0.005, 0.005}};
  Model model = box_model(box, Elastic::from_young(kDensity, kYoung, 0.0), controls());
  std::vector<int> moving;
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (model.mesh.position[n].x() > 0) moving.push_back(n);
  for (int j = 0; j <= 1; ++j)
    for (int k = 0; k <= 1; ++k) model.fixed.push_back({box.node(0, j, k), {true, true, true}, {}});
  model.start_velocities.push_back({moving, {-kSpeed, 0, 0}});
  model.finish();
  State state = initial_state(model);
  const double c = std::sqrt(kYoung / kDensity);
  double arrival = 0;
  const int watched = box.node(120, 0, 0);
  run_until(model, state, 0.8 * kLength / c, 0.9, [&] {
    if (arrival == 0 && state.nodes[watched].v[0] > -0.5 * kSpeed) arrival = state.time;
  });
  EXPECT_NEAR(0.6 * kLength / arrival, c, 0.01 * c);
  const StepContext context{state.nodes, state.spin, 0, 0, true};
  double stress = 0;
  for (int e = 40; e < 100; ++e)
    stress += model.blocks[0]->sample(context, state.history[0], e).stress(0, 0) / 60;
  EXPECT_NEAR(stress, -kDensity * c * kSpeed, 0.01 * kDensity * c * kSpeed);
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// First bending frequency 0.5596 / L^2 sqrt(E I / rho A) [blevins1979, table 8-1], less 0.6 % for
// shear and rotary inertia at L / h = 10 (Timoshenko); one-point bricks with n = 4 layers carry 1 -
// 1/n^2 of the bending stiffness (-3.2 %), to which hourglass stiffness adds a little back: 5 %
// together.
TEST_P(FeDynamics, CantileverFrequency) {
  constexpr double kYoung = 1e9, kDensity = 1000, kLength = 1.0, kHeight = 0.1;
  const Box box{40, 2, 4, {kLength, 0.05, kHeight}};
  Model model = box_model(box, Elastic::from_young(kDensity, kYoung, 0.3), controls());
  for (int j = 0; j <= box.ny; ++j)
    for (int k = 0; k <= box.nz; ++k)
      model.fixed.push_back({box.node(0, j, k), {true, true, true}, {}});
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const double s = model.mesh.position[n].x() / kLength;
    model.start_velocities.push_back({{n}, {0, 0, 0.5 * s * s}});
  }
  model.finish();
  State state = initial_state(model);
  const double exact = 0.5596 * std::sqrt(kYoung * kHeight * kHeight / 12 / kDensity);
  const int tip = box.node(40, 1, 2);
  double last = 0, first_crossing = 0, second_crossing = 0;
  run_until(model, state, 1.2 / exact, 0.9, [&] {
    const double z = state.nodes[tip].x[2] - kHeight / 2;
    if (state.step > 2 && z * last < 0)
      (first_crossing == 0 ? first_crossing : second_crossing) = state.time;
    last = z;
  });
  EXPECT_NEAR(0.5 / (second_crossing - first_crossing), exact, 0.05 * exact);
  EXPECT_LT(state.energies.hourglass(), 0.05 * state.energies.total());
  EXPECT_LT(std::abs(state.energies.balance_error()), 0.01);
}

// No loads: sums of internal forces and of their moments vanish, so momenta are kept to round-off.
// Energy without any dissipation stays within 1 % over 100 thousand steps.
TEST_P(FeDynamics, FreeBodyKeepsMomentumAndEnergy) {
  const Box box{2, 2, 2, {0.1, 0.1, 0.1}};
  Model model = box_model(
      box, Elastic::from_young(1000, 1e6, 0.3), without_viscosity(controls()), [](const Vec3& p) {
        return Vec3(p + 0.1 * Vec3(p.y() * p.z(), 5 * p.x() * p.z(), p.x() * p.y()));
      });
  for (int n = 0; n < model.mesh.node_count(); ++n) {
    const Vec3 r = model.mesh.position[n] - Vec3(0.05, 0.05, 0.05);
    model.start_velocities.push_back(
        {{n}, Vec3(3, 1, 2) + Vec3(20, 10, -30).cross(r) + 10 * r.x() * r});
  }
  model.finish();
  State state = initial_state(model);
  const auto momenta = [&] {
    Vec3 p = Vec3::Zero(), L = Vec3::Zero();
    for (int n = 0; n < model.mesh.node_count(); ++n) {
      const Vec3 mv = model.mass[n] * state.nodes[n].velocity();
      p += mv;
      L += state.nodes[n].position().cross(mv);
    }
    return std::pair(p, L);
  };
  const auto [p0, L0] = momenta();
  double worst = 0;
  run_until(model, state, 1e5 * 0.9 * initial_stable_step(model), 0.9,
            [&] { worst = std::max(worst, std::abs(state.energies.balance_error())); });
  const auto [p1, L1] = momenta();
  EXPECT_GE(state.step, 100000);
  // 1e5 roundings of random sign of 1e-16, or of 1e-7 of an element's own forces; a force that is
  // left over acts at the arm of the body's place.
  const double round_off = is_double() ? 1e-12 : 1e-6, arm = state.nodes[0].position().norm();
  EXPECT_LT((p1 - p0).norm(), round_off * p0.norm());
  EXPECT_LT((L1 - L0).norm(), round_off * p0.norm() * arm);
  EXPECT_LT(worst, 0.01);
}

// A near-incompressible block (K / G = 3.6e5) sheared through one element: no locking, the shear
// stiffness is G A / h.
TEST_P(FeDynamics, NearIncompressibleBlockDoesNotLockInBending) {
  // A cantilever of soft tissue under its own weight, slowly: tip sag rho g L^4 / (8 E I / A) with
  // E = 3 G, plus the shear part rho g L^2 / (2 k G), k = 5/6.
  constexpr double kShear = 1e5, kBulk = 1e9, kDensity = 1000, kLength = 0.1, kHeight = 0.02;
  const Box box{20, 2, 4, {kLength, 0.01, kHeight}};
  Model model = box_model(box, Elastic::from_bulk(kDensity, kBulk, kShear), controls());
  for (int j = 0; j <= box.ny; ++j)
    for (int k = 0; k <= box.nz; ++k)
      model.fixed.push_back({box.node(0, j, k), {true, true, true}, {}});
  constexpr double kGravity = 1.0;
  model.settings.gravity = {0, 0, -kGravity};
  model.settings.mass_damping = 60;
  model.finish();
  State state = initial_state(model);
  run_until(model, state, 0.15, 0.9, [] {});
  const double bending =
      kDensity * kGravity * std::pow(kLength, 4) / (8 * 3 * kShear * kHeight * kHeight / 12);
  const double shear = kDensity * kGravity * kLength * kLength / (2 * 5.0 / 6 * kShear);
  const double sag = kHeight / 2 - state.nodes[box.node(20, 1, 2)].x[2];
  EXPECT_NEAR(sag, bending + shear,
              0.12 * (bending + shear));  // 1/n^2 as above, clamped Poisson effect
}

INSTANTIATE_TEST_SUITE_P(In, FeDynamics, testing::Values(Precision::Double, Precision::Single),
                         [](const auto& in) {
                           return in.param == Precision::Double ? "Double" : "Single";
                         });

}  // namespace
}  // namespace crosswalk::fe
