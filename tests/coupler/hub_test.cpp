// The whole life of a run inside one process: coupler, both solver sessions and a recorder on one
// in-memory bus.
#include "coupler/hub.h"

#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "acking_recorder.h"
#include "common/participant.h"
#include "coupler/coupler.h"
#include "coupler/lcm_link.h"
#include "crosswalk/msg/fe_done.hpp"
#include "crosswalk/msg/resend_request.hpp"
#include "crosswalk/msg/run_event.hpp"
#include "toy_nodes.h"

namespace crosswalk::coupling {
namespace {

using testing::HasSubstr;

const NodeIdentity kMbIdentity{
    .scenario_digest = 7, .version = "1", .bodies = {"block"}, .n_attached = 1};
const NodeIdentity kRecorderIdentity{
    .scenario_digest = 7, .version = "1", .bodies = {}, .n_attached = 0};

struct Fixture {
  std::shared_ptr<Transport> transport = memory_transport();
  std::atomic<bool> interrupted{false};
  std::vector<std::string> told;
  Bus coupler_bus{transport, "test", Role::Coupler};
  Bus mb_bus{transport, "test", Role::Mb};
  Bus fe_bus{transport, "test", Role::Fe};
  Bus recorder_bus{transport, "test", Role::Recorder};
  toy::Mb mb{{.mass = 15, .push = 1000}};
  toy::Fe fe{{.mass = 4.5, .stiffness = 3e5, .damping = 50}, 0.5};
  Patience patience{.claim_s = 0.001, .join_s = 0.3, .first_resend_s = 0.02};
  Hub hub{coupler_bus,
          {.scenario_name = "toy", .scenario_digest = 7, .version = "1"},
          patience,
          interrupted,
          [this](EventLevel, const std::string& text) { told.push_back(text); }};
  MbSession mb_session{mb_bus, mb, kMbIdentity, {}};
  FeSession fe_session{fe_bus, fe, kMbIdentity, {}};
  toy::AckingRecorder recorder{recorder_bus, kRecorderIdentity};

  void join() {
    const auto now = Bus::Clock::now();
    for (NodeSession* session :
         {static_cast<NodeSession*>(&mb_session), static_cast<NodeSession*>(&fe_session),
          static_cast<NodeSession*>(&recorder)}) {
      session->tick(now);
    }
  }
};

TEST(Hub, WholeRunOverTheBusEqualsDirectCalls) {
  Fixture run;
  run.hub.claim();
  run.join();
  const std::vector<InterfaceBody> bodies = run.hub.gather();
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(bodies[0].block.mass, 0.5);
  EXPECT_EQ(run.mb.now().mass, 15.5) << "the block's mass has moved into the body";
  LcmMbLink mb_link(run.hub);
  LcmFeLink fe_link(run.hub, mb_link);
  CouplerSettings settings{.scheme = {.n_attached = 1}, .limits = {}, .duration_ns = 10'000'000};
  Coupler coupler(settings, mb_link, &fe_link, &run.hub.records(),
                  {.before_window = [&](std::int64_t n) { run.hub.follow_recorder(n); }});
  run.hub.start();
  const std::int64_t windows = coupler.run(bodies);
  EXPECT_TRUE(run.hub.finish(windows - 1));
  run.coupler_bus.handle_pending();
  EXPECT_EQ(run.recorder.audits, windows);
  EXPECT_TRUE(run.mb_session.is_over());
  EXPECT_TRUE(run.fe_session.is_over());
  EXPECT_LT(std::abs(run.recorder.last_audit.drift), 0.01 * run.recorder.last_audit.exchanged);

  toy::Mb mb({.mass = 15, .push = 1000});
  toy::Fe fe({.mass = 4.5, .stiffness = 3e5, .damping = 50}, 0.5);
  mb.attach(fe.place(mb.interface_bodies()));
  toy::NoRecords sink;
  DirectMbLink direct_mb(mb, sink);
  DirectFeLink direct_fe(fe, sink);
  Coupler direct(settings, direct_mb, &direct_fe, nullptr, {});
  EXPECT_EQ(direct.run(bodies), windows);
  EXPECT_EQ(mb.now().x, run.mb.now().x);
  EXPECT_EQ(mb.now().v, run.mb.now().v);
  EXPECT_EQ(fe.now().x, run.fe.now().x);
}

TEST(Hub, OldCheckpointCommandsDoNotTouchTheCheckpoints) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("cw_old_checkpoint_{}", getpid());
  const auto transport = memory_transport();
  Bus coupler(transport, "test", Role::Coupler), node(transport, "test", Role::Mb);
  toy::Mb mb({.mass = 15, .push = 1000});
  MbSession session(node, mb, kMbIdentity, {}, folder);
  coupler.publish(msg::run_manifest{}, 0);
  const auto ask = [&](std::int64_t window) {
    msg::run_control control{};
    control.command = static_cast<int>(Command::Checkpoint);
    control.window = window;
    coupler.publish(control, 0);
    node.handle_pending();
  };
  const auto advance = [&] {
    toy::NoRecords sink;
    mb.advance({.id = {0, 20000}, .carry = {Vec6::Zero()}, .bias = {Vec6::Zero()}}, sink);
  };
  ask(100);
  const std::vector<std::byte> first = read_part(folder, Role::Mb, 100).state;
  advance();
  ask(100);
  ask(200);
  const std::vector<std::byte> second = read_part(folder, Role::Mb, 200).state;
  EXPECT_NE(first, second);
  advance();
  for (const std::int64_t window : {100, 200, 50}) ask(window);
  EXPECT_EQ(read_part(folder, Role::Mb, 100).state, first);
  EXPECT_EQ(read_part(folder, Role::Mb, 200).state, second);
  EXPECT_THROW(read_part(folder, Role::Mb, 50), std::exception);
  std::filesystem::remove_all(folder);
}

TEST(Hub, NamesTheRolesThatNeverJoin) {
  Fixture run;
  run.hub.claim();
  run.mb_session.tick(Bus::Clock::now());
  try {
    run.hub.gather();
    FAIL();
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.code(), ExitCode::TimeOut);
    EXPECT_THAT(error.what(), HasSubstr("fe_node, recorder"));
  }
}

TEST(Hub, RefusesAnotherScenarioNamingBothDigests) {
  Fixture run;
  Bus bus(run.transport, "test", Role::Mb);
  toy::Mb mb({});
  MbSession other(bus, mb,
                  {.scenario_digest = 8, .version = "1", .bodies = {"block"}, .n_attached = 1}, {});
  run.hub.claim();
  other.tick(Bus::Clock::now());
  try {
    run.hub.gather();
    FAIL();
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.code(), ExitCode::VersionMismatch);
    EXPECT_THAT(error.what(), HasSubstr("0000000000000008"));
    EXPECT_THAT(error.what(), HasSubstr("0000000000000007"));
  }
  run.coupler_bus.handle_pending();
  EXPECT_TRUE(other.is_over());
}

TEST(Hub, RefusesOtherInterfaceBodies) {
  Fixture run;
  Bus bus(run.transport, "test", Role::Fe);
  toy::Fe fe({});
  FeSession other(bus, fe,
                  {.scenario_digest = 7, .version = "1", .bodies = {"torso"}, .n_attached = 1}, {});
  run.hub.claim();
  run.mb_session.tick(Bus::Clock::now());
  other.tick(Bus::Clock::now());
  try {
    run.hub.gather();
    FAIL();
  } catch (const ProtocolError& error) {
    EXPECT_THAT(error.what(), HasSubstr("[torso]"));
    EXPECT_THAT(error.what(), HasSubstr("[block]"));
  }
}

TEST(Hub, RefusesASecondNodeOfARoleAndKeepsTheFirst) {
  Fixture run;
  Bus bus(run.transport, "test", Role::Mb);
  toy::Mb mb({});
  MbSession second(bus, mb, kMbIdentity, {});
  run.hub.claim();
  run.join();
  second.tick(Bus::Clock::now());
  run.hub.gather();
  run.coupler_bus.handle_pending();
  EXPECT_TRUE(second.is_over());
  EXPECT_FALSE(run.mb_session.is_over());
  std::atomic<bool> interrupted{false};
  EXPECT_THROW(second.run(interrupted), ProtocolError);
}

TEST(Hub, ASecondCouplerLeavesTheRunAlone) {
  Fixture run;
  run.hub.claim();
  Bus bus(run.transport, "test", Role::Coupler);
  Hub second(bus, {.scenario_name = "toy", .scenario_digest = 7, .version = "1"}, run.patience,
             run.interrupted, [](EventLevel, const std::string&) {});
  try {
    second.claim();
    FAIL();
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.code(), ExitCode::CouplerPresent);
  }
}

TEST(Hub, ANumberThatCannotBeTrueStopsTheRunNamingPeerWindowAndField) {
  Fixture run;
  run.mb.fail_at_window = 20;
  run.hub.claim();
  run.join();
  const auto bodies = run.hub.gather();
  LcmMbLink mb_link(run.hub);
  LcmFeLink fe_link(run.hub, mb_link);
  Coupler coupler({.scheme = {.n_attached = 1}, .limits = {}}, mb_link, &fe_link, nullptr, {});
  try {
    coupler.run(bodies);
    FAIL();
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.code(), ExitCode::NumericalLimit);
    EXPECT_THAT(error.what(), HasSubstr("mb_node"));
    EXPECT_THAT(error.what(), HasSubstr("window 20"));
    EXPECT_THAT(error.what(), HasSubstr("velocity[1] = nan"));
  }
}

TEST(Hub, ImplicitSchemeRecordsEveryWindowOnce) {
  Fixture run;
  run.hub.claim();
  run.join();
  const auto bodies = run.hub.gather();
  std::vector<std::int64_t> times;
  run.recorder_bus.subscribe<msg::head_kinematics>(Role::Fe, [&](const msg::head_kinematics& m) {
    for (int i = 0; i < m.n; ++i) times.push_back(m.sample[i].t_ns);
  });
  LcmMbLink mb_link(run.hub);
  LcmFeLink fe_link(run.hub, mb_link);
  Coupler coupler({.scheme = {.scheme = Scheme::Implicit, .n_attached = 1},
                   .limits = {},
                   .duration_ns = 1'000'000},
                  mb_link, &fe_link, nullptr, {});
  run.hub.start();
  const std::int64_t windows = coupler.run(bodies);
  run.hub.finish(windows - 1);
  run.coupler_bus.handle_pending();
  ASSERT_EQ(static_cast<std::int64_t>(times.size()), windows);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(times[i], static_cast<std::int64_t>(i + 1) * 20000);
}

TEST(GrantLedger, ExecutesOnceRepeatsTheLastIgnoresOlderRefusesSkips) {
  GrantLedger ledger;
  EXPECT_EQ(ledger.judge(0), GrantLedger::Verdict::Execute);
  ledger.executed(0, {});
  ledger.executed(1, {std::byte{9}});
  EXPECT_EQ(ledger.judge(1), GrantLedger::Verdict::Repeat);
  EXPECT_EQ(ledger.judge(0), GrantLedger::Verdict::Ignore);
  EXPECT_THROW(static_cast<void>(ledger.judge(3)), ProtocolError);
  EXPECT_EQ(ledger.answer(1)->at(0), std::byte{9});
  EXPECT_EQ(ledger.answer(2), nullptr);
}

TEST(Hub, SendsItsRecordsAgainToTheRecorderOfTheRun) {
  Fixture run;
  run.hub.claim();
  run.join();
  run.hub.gather();
  int heard = 0;
  run.recorder_bus.subscribe<msg::run_event>(Role::Coupler,
                                             [&](const msg::run_event&) { ++heard; });
  run.hub.records().event(0, EventLevel::Info, "news");
  run.recorder_bus.handle_pending();
  ASSERT_EQ(heard, 1);
  msg::resend_request request{};
  request.role = static_cast<std::int16_t>(Role::Coupler);
  request.first = 0;
  request.last = 5;
  run.recorder_bus.publish(request, 0);
  run.recorder_bus.handle_pending();
  EXPECT_EQ(heard, 2);
  Bus stranger{run.transport, "test", Role::Recorder};
  stranger.publish(request, 0);
  run.recorder_bus.handle_pending();
  EXPECT_EQ(heard, 2);
}

}  // namespace
}  // namespace crosswalk::coupling
