#include "fe_node/element/hex8.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "fe_node/element/hex8_full.h"
#include "fe_node/solver.h"
#include "tests/fe_node/box_model.h"
#include "tests/fe_node/energy_slope.h"

namespace crosswalk::fe {
namespace {

const Elastic kSteel = Elastic::from_young(7850, 210e9, 0.3);

/// Nodal forces with the nodes moved to the positions given.
std::vector<Vec3> forces_at(const Model& model, State& state) {
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  return nodal_forces(model, scratch);
}

TEST(Hex8, VolumeOfAWarpedBrickIsExact) {
  // A brick whose top face is twisted: volume by the divergence theorem over trilinear faces is the
  // box's own, since opposite changes cancel.
  const Mesh mesh = box_mesh({1, 1, 1, {2, 3, 4}});
  Vec3 x[8];
  for (int c = 0; c < 8; ++c) x[c] = mesh.position[mesh.corners(ElementKind::Hex8, 0)[c]];
  EXPECT_NEAR(hex8_volume(x), 24.0, 1e-13);
  const Vec3 twist(0.1, 0.2, 0);
  x[4] += twist, x[6] += twist, x[5] -= twist, x[7] -= twist;
  EXPECT_NEAR(hex8_volume(x), 24.0, 1e-13);
}

TEST(Hex8, VolumeGradientIsTheSlopeOfTheVolume) {
  const Mesh mesh = box_mesh({1, 1, 1, {1, 1, 1}}, wavy);
  Vec3 x[8], gradient[8];
  for (int c = 0; c < 8; ++c) x[c] = mesh.position[mesh.corners(ElementKind::Hex8, 0)[c]];
  hex8_volume_gradient(x, gradient);
  const double h = 1e-6;
  for (int c = 0; c < 8; ++c)
    for (int i = 0; i < 3; ++i) {
      const double kept = x[c][i];
      x[c][i] = kept + h;
      const double up = hex8_volume(x);
      x[c][i] = kept - h;
      const double down = hex8_volume(x);
      x[c][i] = kept;
      EXPECT_NEAR(gradient[c][i], (up - down) / (2 * h), 1e-9);
    }
}

TEST(Hex8, RigidRotationGivesNoForce) {
  for (HourglassForm form : {HourglassForm::None, HourglassForm::Stiffness}) {
    ElementControls controls = without_viscosity({form, 0.1});
    Model model = box_model({3, 2, 2, {0.3, 0.2, 0.2}}, kSteel, controls, wavy);
    model.finish();
    const Pose X{exp_rotation({1.1, -0.7, 2.0}), {3, 4, 5}};
    State state = initial_state(model, X);
    for (const Vec3& f : forces_at(model, state))
      EXPECT_LT(f.norm(), 1e-12 * 210e9);  // round-off of E A
  }
}

// Constant strain on a mesh of warped elements: interior nodes stay in balance, stress is uniform.
TEST(Hex8, PatchOfWarpedElementsCarriesConstantStress) {
  const Box box{3, 3, 3, {1, 1, 1}};
  Model model = box_model(box, kSteel, without_viscosity({HourglassForm::Stiffness, 0.1}), wavy);
  model.finish();
  State state = initial_state(model);
  Mat3 F;
  F << 1.001, 0.0004, -0.0003, 0.0002, 0.9995, 0.0005, 0.0001, -0.0002, 1.0008;
  for (std::size_t n = 0; n < state.nodes.size(); ++n)
    state.nodes[n].set_position(F * model.mesh.position[n]);
  const std::vector<Vec3> force = forces_at(model, state);
  double largest = 0;
  for (const Vec3& f : force) largest = std::max(largest, f.norm());
  for (int i = 1; i < 3; ++i)
    for (int j = 1; j < 3; ++j)
      for (int k = 1; k < 3; ++k) EXPECT_LT(force[box.node(i, j, k)].norm(), 1e-9 * largest);

  const StepContext context{state.nodes, state.spin, 0, 0, true};
  const Mat3 first = model.blocks[0]->sample(context, state.history[0], 0).stress;
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  const Mat3 hooke = kSteel.lambda * strain.trace() * Mat3::Identity() + 2 * kSteel.mu * strain;
  EXPECT_LT((first - hooke).norm(), 5e-3 * hooke.norm());  // second order in a strain of 1e-3
  for (int e = 1; e < model.blocks[0]->element_count(); ++e) {
    const Mat3 stress = model.blocks[0]->sample(context, state.history[0], e).stress;
    EXPECT_LT((stress - first).norm(), 1e-9 * first.norm());
  }
}

TEST(Hex8, ForcesAreTheSlopeOfTheEnergy) {
  Model model = box_model({1, 1, 1, {1, 1, 1}}, Elastic::from_young(1000, 1e6, 0.4),
                          without_viscosity({HourglassForm::Stiffness, 0.1}), wavy);
  model.finish();
  State state = initial_state(model);
  for (int n = 0; n < 8; ++n)
    state.nodes[n].set_position(state.nodes[n].position() + 0.1 * Vec3(std::sin(5.0 * n),
                                                                       std::cos(3.0 * n),
                                                                       std::sin(7.0 * n)));
  Scratch scratch(model, 1);
  compute_forces(model, state, scratch);
  const std::vector<Vec3> force = nodal_forces(model, scratch);
  const auto energy = [&] {
    compute_forces(model, state, scratch);
    return state.energies.internal + state.energies.hourglass_stored;
  };
  expect_slope(state, force, energy, 1e-6, 1e-3);  // forces are of order 1e5 N
}

// Corner 0 of a cube of tissue is pushed in along the diagonal and corner 6 drawn out as far, which
// keeps the mean volume and dilates the points unevenly.
class UnevenBrick : public testing::Test {
 protected:
  static constexpr double kSide = 0.01, kShear = 30e3;
  UnevenBrick() {
    model_.mesh = box_mesh({1, 1, 1, Vec3::Constant(kSide)});
    model_.blocks.push_back(make_full_hex8_block(
        model_.mesh, 0, {0}, Viscoelastic::from_single_term(1000, 20e6, kShear, kShear, 0),
        without_viscosity()));
    model_.finish();
    state_ = initial_state(model_);
  }
  /// `share` of the side.
  void push_in(double share) {
    state_ = initial_state(model_);
    const std::span<const int> corner = model_.mesh.corners(ElementKind::Hex8, 0);
    for (int c : {0, 6}) {
      NodeRecord& node = state_.nodes[corner[c]];
      node.set_position(node.position() + Vec3::Constant(share * kSide));
    }
  }
  double energy() {
    Scratch scratch(model_, 1);
    compute_forces(model_, state_, scratch);
    return state_.energies.internal;
  }
  Model model_;
  State state_;
};

TEST_F(UnevenBrick, ForcesAreTheSlopeOfTheEnergy) {
  push_in(0.3);
  const std::vector<Vec3> force = forces_at(model_, state_);
  double largest = 0;
  for (const Vec3& f : force) largest = std::max(largest, f.norm());
  expect_slope(
      state_, force, [this] { return energy(); }, 1e-7, 1e-5 * largest);
}

// u_x = a eta zeta strains a cube at its points but not on average, and changes no volume. Eight
// points find mu |grad u|^2 / 2 = (8 / 3) mu side a^2 / 2.
TEST(Hex8, OwnHourglassIsTheEnergyOfABilinearMode) {
  constexpr double kSide = 0.01, kAmplitude = 1e-6, kShear = 6e3;
  const Elastic soft = Elastic::from_young(1040, 3 * kShear, 0.49999);
  const auto energy = [&](Model model) {
    model.finish();
    State state = initial_state(model);
    for (NodeRecord& node : state.nodes) {
      const Vec3 natural = node.position() * (2 / kSide) - Vec3::Ones();
      node.x[0] += kAmplitude * natural.y() * natural.z();
    }
    Scratch scratch(model, 1);
    compute_forces(model, state, scratch);
    return state.energies.internal + state.energies.hourglass_stored;
  };
  const Box box{1, 1, 1, Vec3::Constant(kSide)};
  Model full;
  full.mesh = box_mesh(box);
  full.blocks.push_back(make_full_hex8_block(full.mesh, 0, {0}, soft, {}));
  const double exact = 4.0 / 3 * kShear * kSide * kAmplitude * kAmplitude;
  EXPECT_NEAR(energy(std::move(full)) / exact, 1, 1e-3);
  EXPECT_NEAR(energy(box_model(box, soft, {HourglassForm::Stiffness, kOwnHourglass})) / exact, 1,
              1e-3);
}

TEST(Hex8, StableStepOfACubeIsTheElementBound) {
  // omega^2 = 8 / rho (lambda tr g + 2 mu g_max), g = I / (2 h^2) for a cube of side h.
  const double h = 0.01;
  Model model = box_model({1, 1, 1, {h, h, h}}, kSteel);
  model.finish();
  const double omega_squared = 8 / 7850.0 * (1.5 * kSteel.lambda + kSteel.mu) / (h * h);
  EXPECT_NEAR(initial_stable_step(model), 2 / std::sqrt(omega_squared), 1e-12);
  State state = initial_state(model, {exp_rotation({0.3, 2, -1}), Vec3::Zero()});
  Scratch scratch(model, 1);
  const StepReport report = compute_forces(model, state, scratch);
  EXPECT_NEAR(report.stable_step, 2 / std::sqrt(omega_squared), 1e-12);
  EXPECT_EQ(report.critical_element, 0);
}

TEST(Hex8, MassScalingReachesTheStepAndIsReported) {
  const double h = 0.01;
  Model plain = box_model({2, 1, 1, {2 * h, h, h}}, kSteel);
  plain.finish();
  const double step = initial_stable_step(plain);
  Model scaled = box_model({2, 1, 1, {2 * h, h, h}}, kSteel);
  scaled.settings.mass_scaling_step = 1.5 * step;
  scaled.finish();
  EXPECT_NEAR(initial_stable_step(scaled), 1.5 * step, 1e-9 * step);
  EXPECT_NEAR(scaled.added_mass[0], 1.25 * plain.total_mass(), 1e-12);
  EXPECT_NEAR(scaled.total_mass(), 2.25 * plain.total_mass(), 1e-12);
}

TEST(Hex8, InvertedElementStopsWithItsName) {
  Model model = box_model({1, 1, 1, {1, 1, 1}}, kSteel);
  model.finish();
  State state = initial_state(model);
  for (int n = 4; n < 8; ++n) state.nodes[n].x[2] = -1;
  state.time = 0.5;
  Scratch scratch(model, 1);
  try {
    compute_forces(model, state, scratch);
    FAIL() << "an inverted element went unnoticed";
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "t = 500.000 ms: element 1 (part 1 'box', hex8) has Jacobian -1");
    EXPECT_EQ(error.time_s(), 0.5);
  }
}

}  // namespace
}  // namespace crosswalk::fe
