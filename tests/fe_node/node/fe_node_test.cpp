// The finite-element participant on a column of three cubes: a rigid block that follows a multibody
// body, a soft neck, a rigid skull.
#include "fe_node/fe_node.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/error.h"
#include "tests/fe_node/node/node_fixture.h"

namespace crosswalk::fe {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kWindow = 20000;  // ns

/// Three cubes of 20 mm on each other; mm, kg, ms.
std::string column() {
  std::string text = "*KEYWORD\n$ crosswalk: unit_system=mm-kg-ms\n*NODE\n";
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 4; ++i)
      text += std::to_string(4 * k + i + 1) + (i == 1 || i == 2 ? ",20," : ",0,") +
              (i >= 2 ? "20," : "0,") + std::to_string(20 * k) + "\n";
  text += "*ELEMENT_SOLID\n";
  for (int k = 0; k < 3; ++k) {
    text += std::to_string(k + 1) + "," + std::to_string(k + 1);
    for (int i = 1; i <= 8; ++i) text += "," + std::to_string(4 * k + i);
    text += "\n";
  }
  return text +
         "*PART\nblock\n1,1,1\n*PART\nneck\n2,1,2\n*PART\nskull\n3,1,1\n*SECTION_SOLID\n1,1\n"
         "*MAT_RIGID\n1,2e-6,10.0,0.3\n0\n0\n*MAT_ELASTIC\n2,1e-6,2e-3,0.3\n"
         "*END\n";
}

class FeNodeTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cw_fe_node_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    write(column());
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& deck) { std::ofstream(folder_ / "column.k") << deck; }

  FeConfig config() const {
    FeConfig config = node_config("");
    config.head_neck = {};
    config.head_neck.is_generated = false;
    config.head_neck.deck = folder_ / "column.k";
    config.head_neck.names = {.head = "skull", .brain = "neck", .surface = "skull", .skull = "3"};
    config.windshield.reset();
    config.partner_shapes.clear();
    config.interfaces = {{"trunk", "block", true, {}}};
    config.added_mass_limit = 0;
    config.tissue_interval = 1e-4;
    config.strain_interval = 2e-5;
    config.field_interval = 0;
    return config;
  }

  /// Window `w` of a body that moves along x at `speed`, whatever the model does.
  static FeGrant grant(std::int64_t w, double speed) {
    FeGrant grant;
    grant.id.window = w;
    grant.id.window_ns = kWindow;
    BodyDrive drive;
    drive.X_WB.p = {speed * grant.id.begin_s(), 0, 0};
    drive.V_WB.v = {speed, 0, 0};
    grant.drives = {drive};
    grant.mobility = Eigen::MatrixXd::Zero(6, 6);
    return grant;
  }

  static std::unique_ptr<FeNode> placed(const FeConfig& config, const fs::path& folder = {}) {
    auto node = std::make_unique<FeNode>(config, 1, folder);
    node->place(node->interface_bodies());
    return node;
  }

  fs::path folder_;
  HeadSink records_;
};

TEST_F(FeNodeTest, TellsItsInterfacesAndTheMassItHandsOver) {
  FeNode node(config(), 1, {});
  std::vector<InterfaceBody> bodies = node.interface_bodies();
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(bodies[0].name, "trunk");
  EXPECT_TRUE(bodies[0].is_attached);
  bodies = node.place(bodies);
  // 2000 kg/m3 of the block and half the neck's 1000 kg/m3, each 8e-6 m3
  EXPECT_NEAR(bodies[0].block.mass, 8e-6 * (2000 + 500), 1e-12);
  EXPECT_NEAR(bodies[0].block.com.x(), 0.01, 1e-9);
}

TEST_F(FeNodeTest, TheImpulseIsTheMomentumTheModelGains) {
  const auto node = placed(config());
  Vec3 impulse = Vec3::Zero();
  for (int w = 0; w < 50; ++w)
    impulse += node->advance(grant(w, 2.0), records_).loads[0].impulse.head<3>();
  const Model& model = node->built().model;
  Vec3 momentum = Vec3::Zero();
  for (int n = 0; n < model.mesh.node_count(); ++n)
    if (model.body_of_node[n] < 0) momentum += model.mass[n] * node->state().nodes[n].velocity();
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].role == BodyRole::Free)
      momentum += model.bodies[b].inertia.mass * node->state().bodies[b].V_WB.v;
  EXPECT_GT(momentum.x(), 1e-4);
  EXPECT_LT((impulse + momentum).norm(), 1e-9 * momentum.norm());
}

TEST_F(FeNodeTest, FollowsARigidMotionAndReportsTheHead) {
  FeConfig moving = config();
  FeNode node(moving, 1, {});
  std::vector<InterfaceBody> bodies = node.interface_bodies();
  node.place(bodies);
  FeReply reply;
  for (int w = 0; w < 10; ++w) reply = node.advance(grant(w, 0.0), records_);
  // nothing moves: no load, no energy, ten head samples in place
  EXPECT_LT(reply.loads[0].impulse.norm(), 1e-12);
  EXPECT_LT(reply.kinetic + reply.internal, 1e-15);
  ASSERT_EQ(records_.samples.size(), 10U);
  EXPECT_EQ(records_.samples.back().t_ns, 10 * kWindow);
  EXPECT_LT((records_.samples.back().X_WH.p - Vec3(0.01, 0.01, 0.05)).norm(), 1e-9);
  EXPECT_LT(records_.samples.back().acceleration.norm(), 1e-6);
  ASSERT_FALSE(records_.tissues.empty());
  EXPECT_EQ(records_.tissues.back().regions[0].csdm_15, 0);
}

TEST_F(FeNodeTest, ARepeatedEvaluationStartsFromTheSameState) {
  const auto node = placed(config());
  node->advance(grant(0, 1.0), records_);
  FeGrant trial = grant(1, 1.0);
  trial.id.phase = Phase::Evaluate;
  const std::size_t heads = records_.samples.size();
  const FeReply first = node->advance(trial, records_);
  trial.id.iteration = 1;
  trial.drives[0].V_WB.v.x() = 1.5;
  const FeReply other = node->advance(trial, records_);
  EXPECT_NE(other.state_hash, first.state_hash);
  trial.id.iteration = 2;
  trial.drives[0].V_WB.v.x() = 1.0;
  const FeReply again = node->advance(trial, records_);
  EXPECT_EQ(again.state_hash, first.state_hash);
  EXPECT_EQ(again.loads[0].impulse, first.loads[0].impulse);
  EXPECT_EQ(records_.samples.size(), heads);  // nothing is told of trials
  trial.id.phase = Phase::Accept;
  EXPECT_EQ(node->advance(trial, records_).state_hash, first.state_hash);
  EXPECT_EQ(records_.samples.size(), heads + 1);
}

TEST_F(FeNodeTest, ASavedStateGoesOnBitByBit) {
  const auto node = placed(config());
  for (int w = 0; w < 5; ++w) node->advance(grant(w, 1.0), records_);
  const std::vector<std::byte> saved = node->save_state();
  const auto other = placed(config());
  other->load_state(saved);
  for (int w = 5; w < 10; ++w)
    EXPECT_EQ(node->advance(grant(w, 1.0), records_).state_hash,
              other->advance(grant(w, 1.0), records_).state_hash);
  EXPECT_EQ(node->save_state(), other->save_state());
  std::vector<std::byte> cut(saved.begin(), saved.end() - 5);
  EXPECT_THROW(other->load_state(cut), ProtocolError);
}

TEST_F(FeNodeTest, WritesItsDeckAndItsFields) {
  FeConfig writing = config();
  writing.field_interval = 4e-5;
  const auto node = placed(writing, folder_ / "run");
  for (int w = 0; w < 6; ++w) node->advance(grant(w, 1.0), records_);
  EXPECT_TRUE(fs::exists(folder_ / "run/model/head_neck.k"));
  EXPECT_TRUE(fs::exists(folder_ / "run/fields/fields.pvd"));
  EXPECT_TRUE(fs::exists(folder_ / "run/fields/frame_0002.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "run/fields/frame_0003.vtu"));
}

TEST_F(FeNodeTest, AnInvertedElementLeavesTheLastSoundFrame) {
  const auto node = placed(config(), folder_ / "run");
  EXPECT_THROW(
      {
        // the block is driven through the neck at 2 km/s
        for (int w = 0; w < 50; ++w) {
          FeGrant crash = grant(w, 0);
          crash.drives[0].X_WB.p.z() = 2000 * crash.id.begin_s();
          crash.drives[0].V_WB.v.z() = 2000;
          node->advance(crash, records_);
        }
      },
      NumericalError);
  EXPECT_TRUE(fs::exists(folder_ / "run/fields/last_sound/frame_0000.vtu"));
}

TEST_F(FeNodeTest, NamesWhatADeckLacks) {
  const auto message = [&](const FeConfig& lacking) -> std::string {
    try {
      FeNode node(lacking, 1, {});
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  };
  FeConfig lacking = config();
  lacking.interfaces[0].part = "pedestal";
  EXPECT_THAT(message(lacking), testing::HasSubstr("pedestal"));
  lacking = config();
  lacking.head_neck.names.skull = "cranium";
  EXPECT_THAT(message(lacking), testing::HasSubstr("cranium"));
  lacking = config();
  lacking.head_neck.names.brain = "cerebrum";
  EXPECT_THAT(message(lacking), testing::HasSubstr("cerebrum"));
  write(column() + "*MAT_ELASTIC\n");
  EXPECT_EQ(message(config()), "none");  // what stands behind *END is not read
  write("*KEYWORD\n*INCLUDE\ngone.k\n" + column().substr(9));
  EXPECT_THAT(message(config()), testing::HasSubstr("no 'gone.k'"));
}

TEST_F(FeNodeTest, DescribesRegionsPartsAndSurface) {
  const std::string text = placed(config())->description();
  EXPECT_THAT(text, testing::HasSubstr("\"regions\":[\"brain\",\"neck\"]"));
  EXPECT_THAT(text, testing::HasSubstr("\"name\":\"skull\",\"rigid\":true"));
  EXPECT_THAT(text, testing::HasSubstr("\"triangles\""));
}

}  // namespace
}  // namespace crosswalk::fe
