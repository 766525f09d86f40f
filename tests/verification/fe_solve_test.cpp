// Whole runs of a deck: going on from a restart file, and stops that say where.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "common/error.h"
#include "fe_node/contact/penalty.h"
#include "fe_node/explosion.h"
#include "fe_node/solve.h"
#include "tests/fe_node/box_model.h"
#include "tests/verification/deck_model.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

class SolveDeck : public testing::Test {
 protected:
  SolveDeck()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("crosswalk_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~SolveDeck() override { fs::remove_all(folder_); }

  SolveRequest request(const std::string& cards, const std::string& name) const {
    std::ofstream(folder_ / "deck.k") << si_deck(cards);
    SolveRequest out;
    out.deck = folder_ / "deck.k";
    out.folder = folder_ / name;
    return out;
  }
  static std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path folder_;
};

/// A plastic shell plate on its edge and a soft brick that falls on it with friction.
std::string brick_on_plate() {
  std::string text =
      "*SECTION_SOLID\n1,1\n*SECTION_SHELL\n2,2,,3\n2e-3,2e-3,2e-3,2e-3\n*PART\nplate\n2,2,2\n"
      "*PART\nbrick\n1,1,1\n*MAT_VISCOELASTIC\n1,1500,1e8,5e6,2e6,1000\n"
      "*MAT_PLASTIC_KINEMATIC\n2,2700,70e9,0.33,1e8,1e9,1\n\n*NODE\n";
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) text += node_card(5 * j + i + 1, {0.05 * i, 0.05 * j, 0});
  for (int k = 0; k < 8; ++k)
    text += node_card(101 + k, {k % 4 == 1 || k % 4 == 2 ? 0.13 : 0.07, k % 4 >= 2 ? 0.14 : 0.08,
                                k >= 4 ? 0.0615 : 0.0015});
  text += "*ELEMENT_SHELL\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      text += fmt::format("{},2,{},{},{},{}\n", 4 * j + i + 1, 5 * j + i + 1, 5 * j + i + 2,
                          5 * j + i + 7, 5 * j + i + 6);
  text +=
      "*ELEMENT_SOLID\n100,1,101,102,103,104,105,106,107,108\n"
      "*SET_NODE_LIST\n1\n1,2,3,4,5,6,10,11\n15,16,20,21,22,23,24,25\n"
      "*BOUNDARY_SPC_SET\n1,0,1,1,1,1,1,1\n*SET_NODE_LIST\n2\n101,102,103,104,105,106,107,108\n"
      "*INITIAL_VELOCITY\n2\n2,0,-8\n"
      "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0,5\n0.3,0.2,0.1\n\n"
      "*CONTROL_TERMINATION\n4e-3\n";
  return text;
}

// Stopped half-way and gone on from its file, a run ends with the same bytes as one that was not.
TEST_F(SolveDeck, ARestartGoesOnBitIdentically) {
  SolveRequest whole = request(brick_on_plate(), "whole");
  const SolveResult end = solve_deck(whole);
  EXPECT_GT(end.energies.contact_dissipated, 0);  // they have met
  EXPECT_LT(std::abs(end.energies.balance_error()), 0.02);
  SolveRequest first = request(brick_on_plate(), "first");
  first.end_time = 1.7e-3;
  solve_deck(first);
  SolveRequest second = request(brick_on_plate(), "second");
  second.restart = first.folder / "restart.bin";
  const SolveResult resumed = solve_deck(second);
  EXPECT_EQ(resumed.steps, end.steps);
  EXPECT_EQ(resumed.energies.internal, end.energies.internal);
  const std::string a = bytes_of(whole.folder / "restart.bin"),
                    b = bytes_of(second.folder / "restart.bin");
  EXPECT_GT(a.size(), 1000U);
  EXPECT_TRUE(a == b);
  EXPECT_TRUE(fs::exists(whole.folder / "contacts.csv"));
}

/// A column of three plastic bricks that fail at 10 % and a heavy brick that falls on it.
std::string eroding_column() {
  std::string text =
      "*SECTION_SOLID\n1,1\n*PART\ncolumn\n1,1,1\n*PART\nhammer\n2,1,2\n"
      "*MAT_PLASTIC_KINEMATIC\n1,2700,10e9,0.33,1e7,1e7,1\n0,0,0.1\n"
      "*MAT_ELASTIC\n2,20000,10e9,0.3\n*NODE\n";
  const auto layer = [&](int first, double low, double high, double z) {
    for (int c = 0; c < 4; ++c)
      text += node_card(first + c, {c == 1 || c == 2 ? high : low, c >= 2 ? high : low, z});
  };
  for (int k = 0; k <= 3; ++k) layer(1 + 4 * k, 0, 0.1, 0.1 * k);
  layer(21, -0.02, 0.12, 0.301);
  layer(25, -0.02, 0.12, 0.401);
  text += "*ELEMENT_SOLID\n";
  for (int k = 0; k < 3; ++k) {
    text += fmt::format("{},1", k + 1);
    for (int c = 1; c <= 8; ++c) text += fmt::format(",{}", 4 * k + c);
    text += "\n";
  }
  return text +
         "10,2,21,22,23,24,25,26,27,28\n*SET_NODE_LIST\n1\n1,2,3,4\n*BOUNDARY_SPC_SET\n1,0,1,1,1\n"
         "*SET_NODE_LIST\n2\n21,22,23,24,25,26,27,28\n*INITIAL_VELOCITY\n2\n0,0,-20\n"
         "*CONTACT_ERODING_SURFACE_TO_SURFACE\n2,1,3,3\n\n\n0,1,1\n"
         "*DATABASE_HISTORY_SOLID\n1,3\n*DATABASE_ELOUT\n5e-5\n*CONTROL_TERMINATION\n1.5e-2\n";
}

// The hammer crushes the top brick until it fails, goes on through the place where it was, and
// meets the brick below on the face that the failure uncovered.
TEST_F(SolveDeck, AFailedBrickUncoversTheNextOneInARun) {
  const SolveRequest erosion = request(eroding_column(), "erosion");
  const SolveResult end = solve_deck(erosion);
  EXPECT_LT(std::abs(end.energies.balance_error()), 0.05);
  std::ifstream elements(erosion.folder / "elements.csv"),
      contacts(erosion.folder / "contacts.csv");
  double failed_at = -1;
  for (std::string line; std::getline(elements, line);)
    if (line.find(",3,") != line.npos && line.ends_with(",0") && failed_at < 0)
      failed_at = std::stod(line);
  EXPECT_GT(failed_at, 1e-3 / 20);  // not before they met
  // the next contact begins a brick further down: at least 80 mm at 20 m/s later
  double gap_from = -1, met_again = -1;
  for (std::string line; std::getline(contacts, line);) {
    if (!std::isdigit(static_cast<unsigned char>(line[0]))) continue;
    const double time = std::stod(line);
    const bool touches = !line.ends_with(",0");
    if (time > failed_at && !touches && gap_from < 0) gap_from = time;
    if (gap_from > 0 && touches && met_again < 0) met_again = time;
  }
  EXPECT_GT(gap_from, 0);
  EXPECT_GT(met_again, failed_at + 0.08 / 20);
  EXPECT_LT(met_again, end.time);
}

/// One brick whose top is driven through its bottom.
std::string crushed_brick() {
  std::string text =
      "*SECTION_SOLID\n1,1\n*PART\ncube\n1,1,1\n*MAT_ELASTIC\n1,1000,1e6,0.3\n*NODE\n";
  for (int k = 0; k < 8; ++k)
    text += node_card(
        k + 1, {k % 4 == 1 || k % 4 == 2 ? 1.0 : 0.0, k % 4 >= 2 ? 1.0 : 0.0, k >= 4 ? 1.0 : 0.0});
  return text +
         "*ELEMENT_SOLID\n41,1,1,2,3,4,5,6,7,8\n*SET_NODE_LIST\n1\n1,2,3,4\n"
         "*BOUNDARY_SPC_SET\n1,0,1,1,1\n*SET_NODE_LIST\n2\n5,6,7,8\n"
         "*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,2,1,-1.2\n*DEFINE_CURVE\n1\n0,0\n0.1,1\n1,1\n"
         "*CONTROL_TERMINATION\n0.1\n";
}

TEST_F(SolveDeck, AnInvertedElementStopsTheRunAndLeavesItsLastSoundFrame) {
  const SolveRequest crushed = request(crushed_brick(), "crushed");
  try {
    solve_deck(crushed);
    FAIL() << "nothing stopped the run";
  } catch (const NumericalError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("element 41 (part 1 'cube', hex8)"), std::string::npos) << what;
    EXPECT_GT(error.time_s(), 0.05);
  }
  EXPECT_TRUE(fs::exists(crushed.folder / "last_sound"));
  EXPECT_FALSE(fs::is_empty(crushed.folder / "last_sound"));
}

// Three times the stable step: everything that moves makes energy, and the run says so.
TEST_F(SolveDeck, AnUnstableRunStopsWithItsLastSoundFrame) {
  const SolveRequest wild = request(brick_on_plate() + "*CONTROL_TIMESTEP\n0,3\n", "wild");
  EXPECT_THROW(solve_deck(wild), NumericalError);
  EXPECT_TRUE(fs::exists(wild.folder / "last_sound"));
}

// A contact made for less than a quarter of the step that is taken throws a brick about until
// energy appears from nowhere; the message names the contact, and the element and part of the
// fastest node.
TEST(Explosion, AContactTooStiffForTheStepIsNamed) {
  Mesh mesh = box_mesh({1, 1, 2, {0.1, 0.1, 0.2}});
  mesh.table(ElementKind::Hex8).part = {0, 1};
  mesh.parts.push_back({DeckId{2}, "upper", false});
  mesh.parts[0].name = "lower";
  // the upper brick gets nodes of its own, just above the lower one
  for (int n = 4; n < 8; ++n) {
    mesh.position.push_back(mesh.position[n] + Vec3(0.001, 0.002, 1e-5));
    mesh.node_id.push_back(DeckId{mesh.node_count()});
  }
  std::vector<int>& nodes = mesh.table(ElementKind::Hex8).nodes;
  for (int c = 8; c < 12; ++c) nodes[c] += 8;
  Model model;
  model.mesh = mesh;
  const Elastic soft = Elastic::from_young(1000, 1e6, 0.3);
  for (int part : {0, 1})
    model.blocks.push_back(make_hex8_block(model.mesh, part, {part}, soft, {}));
  model.start_velocities.push_back({{8, 9, 10, 11, 12, 13, 14, 15}, {0, 0, -2}});
  const double dt = 0.5 * initial_stable_step(model);
  PenaltySettings settings;
  settings.stiffness_scale = 1e6;
  settings.nominal_step = dt / 4.5;
  const ContactPart lower{0, 1e6, 0, {}}, upper{1, 1e6, 0, {}};
  model.contacts.push_back(make_surface_contact("stiff pair", surface_of(model.mesh, {&upper, 1}),
                                                surface_of(model.mesh, {&lower, 1}), settings));
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  ExplosionWatch watch;
  try {
    for (int i = 0; i < 2000; ++i) {
      advance_step(model, state, scratch, dt);
      watch.look(model, state, scratch);
    }
    FAIL() << "nothing noticed the energy, balance " << state.energies.balance_error();
  } catch (const NumericalError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("part"), std::string::npos) << what;
    EXPECT_NE(what.find("element"), std::string::npos) << what;
    EXPECT_NE(what.find("contact"), std::string::npos) << what;
    EXPECT_GT(error.time_s(), 0);
  }
}

// What a coupled run may book late in its first windows, and what it may not make.
TEST(Explosion, EnergyBelowTheFloorIsLetPass) {
  Model model;
  model.mesh = box_mesh({1, 1, 1, {0.1, 0.1, 0.1}});
  model.blocks.push_back(
      make_hex8_block(model.mesh, 0, {0}, Elastic::from_young(1000, 1e6, 0.3), {}));
  model.finish();
  State state = initial_state(model);
  Scratch scratch(model, 1);
  state.energies.kinetic = 0.99 * kExplosionFloor;
  ExplosionWatch lenient(kExplosionFloor), strict;
  const auto look_long = [&](ExplosionWatch& watch) {
    for (int i = 0; i < kExplosionSteps; ++i) watch.look(model, state, scratch);
  };
  EXPECT_NO_THROW(look_long(lenient));
  EXPECT_THROW(look_long(strict), NumericalError);
  state.energies.kinetic = 1.01 * kExplosionFloor;
  EXPECT_THROW(look_long(lenient), NumericalError);
}

}  // namespace
}  // namespace crosswalk::fe
