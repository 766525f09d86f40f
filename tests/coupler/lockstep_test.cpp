// The lockstep between real processes over real UDP: lost, doubled, late messages, stopped and
// killed nodes.
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "acking_recorder.h"
#include "common/participant.h"
#include "coupler/coupler.h"
#include "coupler/coupler_part.h"
#include "toy_nodes.h"

namespace crosswalk::coupling {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const NodeIdentity kSolver{
    .scenario_digest = 7, .version = "1", .bodies = {"block"}, .n_attached = 1};
const NodeIdentity kListener{.scenario_digest = 7, .version = "1", .bodies = {}, .n_attached = 0};

toy::Mb toy_mb() { return toy::Mb({.mass = 15, .push = 1000}); }
toy::Fe toy_fe() { return toy::Fe({.mass = 4.5, .stiffness = 3e5, .damping = 50}, 0.5); }
CouplerSettings settings_for(std::int64_t duration_ns) {
  return {.scheme = {.n_attached = 1}, .limits = {}, .duration_ns = duration_ns};
}

// What the coupler process reports through its pipe.
struct Outcome {
  int exit_code = -1;
  std::int64_t windows = 0;
  int resends = 0;
  std::uint64_t fe_hash = 0;
  char message[512] = {};
};

class Lockstep : public testing::Test {
 protected:
  void SetUp() override {
    run_id_ = fmt::format("lockstep-{}-{}", getpid(),
                          testing::UnitTest::GetInstance()->current_test_info()->name());
    try {
      open_transport(default_lcm_url(run_id_));
    } catch (const ProtocolError&) {
      GTEST_SKIP() << "no multicast route on this machine";
    }
  }
  void TearDown() override {
    for (const pid_t pid : children_) kill(pid, SIGKILL);
    while (waitpid(-1, nullptr, 0) > 0) {
    }
  }

  template <class Work>
  pid_t spawn(Work work) {
    const pid_t pid = fork();
    if (pid == 0) {
      int code = static_cast<int>(ExitCode::Bug);
      try {
        code = work();
      } catch (const ProtocolError& error) {
        code = static_cast<int>(error.code());
      } catch (const std::exception&) {
      }
      _exit(code);
    }
    children_.push_back(pid);
    return pid;
  }

  Bus* bus(Role role) {
    return new Bus(open_transport(default_lcm_url(run_id_)), run_id_, role, faults_);
  }

  pid_t start_mb() {
    return spawn([this] {
      toy::Mb mb = toy_mb();
      MbSession session(*bus(Role::Mb), mb, kSolver, {}, checkpoints_);
      return static_cast<int>(session.run(never_));
    });
  }
  pid_t start_fe() {
    return spawn([this] {
      toy::Fe fe = toy_fe();
      FeSession session(*bus(Role::Fe), fe, kSolver, {}, checkpoints_);
      return static_cast<int>(session.run(never_));
    });
  }
  pid_t start_recorder() {
    return spawn([this] {
      toy::AckingRecorder recorder(*bus(Role::Recorder), kListener, checkpoints_);
      return static_cast<int>(recorder.run(never_));
    });
  }
  pid_t start_coupler(std::int64_t duration_ns, Patience patience = {}) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    result_ = ends[0];
    const pid_t pid = spawn([&] {
      const Outcome outcome = lead(duration_ns, patience);
      return write(ends[1], &outcome, sizeof outcome) == sizeof outcome ? outcome.exit_code : 70;
    });
    close(ends[1]);
    return pid;
  }
  Outcome lead(std::int64_t duration_ns, Patience patience) {
    Outcome outcome;
    Bus& own = *bus(Role::Coupler);
    const std::int64_t first_window = latest_checkpoint(checkpoints_).value_or(0);
    Hub hub(own,
            {.scenario_name = "toy",
             .scenario_digest = 7,
             .version = "1",
             .first_window = first_window},
            patience, never_, [](EventLevel, const std::string&) {});
    std::int64_t window = 0;
    try {
      hub.claim();
      const auto bodies = hub.gather();
      const Heartbeat heartbeat(own, [&] { return hub.status(); });
      LcmMbLink mb(hub);
      LcmFeLink fe(hub, mb);
      struct Watch : FeLink {  // remembers the last state hash
        FeLink& next;
        std::uint64_t hash = 0;
        explicit Watch(FeLink& link) : next(link) {}
        FeReply advance(const FeGrant& grant) override {
          FeReply reply = next.advance(grant);
          hash = reply.state_hash;
          return reply;
        }
      } watch(fe);
      Coupler coupler(settings_for(duration_ns), mb, &watch, &hub.records(),
                      {.before_window =
                           [&](std::int64_t n) {
                             window = n;
                             hub.set_window(n);
                             hub.follow_recorder(n);
                           },
                       .after_window =
                           [&](std::int64_t next) {
                             if (next % 50 != 0 || checkpoints_.empty()) return;
                             hub.checkpoint(next);
                             save_part(checkpoints_, next, coupler, mb, fe, hub);
                           }});
      hub.start();
      if (first_window > 0) {
        load_part(read_part(checkpoints_, Role::Coupler, first_window), coupler, mb, fe, hub);
      }
      outcome.windows = coupler.run(bodies);
      outcome.exit_code = hub.finish(outcome.windows - 1) ? 0 : 5;
      outcome.resends = hub.resends();
      outcome.fe_hash = watch.hash;
    } catch (const ProtocolError& error) {
      hub.abort(window, error.what());
      outcome.exit_code = static_cast<int>(error.code());
      wire_text(error.what()).copy(outcome.message, sizeof outcome.message - 1);
    }
    return outcome;
  }
  Outcome outcome() {
    Outcome out;
    EXPECT_EQ(read(result_, &out, sizeof out), static_cast<ssize_t>(sizeof out));
    return out;
  }
  Outcome start_all_and_wait(std::int64_t duration_ns) {
    start_recorder();
    start_fe();
    start_coupler(duration_ns);
    start_mb();
    return outcome();
  }

  static std::uint64_t undisturbed_hash(std::int64_t duration_ns) {
    toy::Mb mb = toy_mb();
    toy::Fe fe = toy_fe();
    auto bodies = fe.place(mb.interface_bodies());
    mb.attach(bodies);
    toy::NoRecords sink;
    DirectMbLink mb_link(mb, sink);
    DirectFeLink fe_link(fe, sink);
    Coupler coupler(settings_for(duration_ns), mb_link, &fe_link, nullptr, {});
    coupler.run(bodies);
    return fnv1a({reinterpret_cast<const char*>(&fe.now()), sizeof fe.now()});
  }

  std::string run_id_;
  BusFaults faults_;
  std::atomic<bool> never_{false};
  std::vector<pid_t> children_;
  std::filesystem::path checkpoints_;  ///< empty: none are written
  int result_ = -1;
};

TEST_F(Lockstep, FourProcessesGiveTheBitsOfDirectCalls) {
  const Outcome out = start_all_and_wait(20'000'000);
  EXPECT_EQ(out.exit_code, 0) << out.message;
  EXPECT_EQ(out.windows, 1001);
  EXPECT_EQ(out.fe_hash, undisturbed_hash(20'000'000));
}

TEST_F(Lockstep, LossDuplicationReorderingAndDelayChangeNothing) {
  faults_ = {.loss = 0.05, .duplicate = 0.02, .reorder = 0.02, .delay_ms = 20, .seed = 11};
  const Outcome out = start_all_and_wait(4'000'000);
  EXPECT_EQ(out.exit_code, 0) << out.message;
  EXPECT_GT(out.resends, 0);
  EXPECT_EQ(out.fe_hash, undisturbed_hash(4'000'000));
}

TEST_F(Lockstep, AKilledNodeIsNamedAtOnce) {
  for (const Role victim : {Role::Mb, Role::Fe, Role::Recorder}) {
    start_coupler(10'000'000'000);
    const pid_t recorder = start_recorder(), fe = start_fe(), mb = start_mb();
    const pid_t pid = victim == Role::Mb ? mb : victim == Role::Fe ? fe : recorder;
    std::this_thread::sleep_for(700ms);
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    const auto begin = Bus::Clock::now();
    const Outcome out = outcome();
    EXPECT_LT(Bus::Clock::now() - begin, 5s);
    EXPECT_EQ(out.exit_code, static_cast<int>(ExitCode::NodeFailed));
    EXPECT_THAT(out.message, HasSubstr(std::string(role_name(victim))));
    EXPECT_THAT(out.message, HasSubstr("window"));
    for (const pid_t other : {recorder, fe, mb}) {
      int status = 0;
      if (other == pid) continue;
      EXPECT_EQ(waitpid(other, &status, 0), other);
      EXPECT_EQ(WEXITSTATUS(status), static_cast<int>(ExitCode::NodeFailed));
    }
  }
}

TEST_F(Lockstep, AStoppedNodeThatComesBackDoesNoHarm) {
  start_coupler(40'000'000);
  start_recorder();
  const pid_t fe = start_fe();
  start_mb();
  std::this_thread::sleep_for(500ms);
  kill(fe, SIGSTOP);
  std::this_thread::sleep_for(1s);
  kill(fe, SIGCONT);
  const Outcome out = outcome();
  EXPECT_EQ(out.exit_code, 0) << out.message;
  EXPECT_EQ(out.fe_hash, undisturbed_hash(40'000'000));
}

TEST_F(Lockstep, ANodeThatStaysSilentIsReportedAsSuch) {
  start_coupler(10'000'000'000, {.silent_s = 1.5});
  start_recorder();
  const pid_t fe = start_fe();
  start_mb();
  std::this_thread::sleep_for(500ms);
  kill(fe, SIGSTOP);
  const Outcome out = outcome();
  EXPECT_EQ(out.exit_code, static_cast<int>(ExitCode::TimeOut));
  EXPECT_THAT(out.message, HasSubstr("fe_node has been silent"));
}

TEST_F(Lockstep, ResumesBitIdenticallyAfterTheDeathOfAnyProcess) {
  constexpr std::int64_t kDuration = 60'000'000;
  const std::uint64_t expected = undisturbed_hash(kDuration);
  for (const Role victim : {Role::Coupler, Role::Mb, Role::Fe, Role::Recorder}) {
    checkpoints_ =
        std::filesystem::path(testing::TempDir()) / run_id_ / std::string(role_name(victim));
    std::filesystem::remove_all(checkpoints_);
    const std::map<Role, pid_t> pids = {{Role::Coupler, start_coupler(kDuration)},
                                        {Role::Recorder, start_recorder()},
                                        {Role::Fe, start_fe()},
                                        {Role::Mb, start_mb()}};
    while (!std::filesystem::exists(checkpoints_ / "latest.json")) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(100ms);
    kill(pids.at(victim), SIGKILL);
    if (victim == Role::Coupler) {
      for (const auto& [role, pid] : pids) kill(pid, SIGKILL);  // as the launcher would
    }
    for (const auto& [role, pid] : pids) waitpid(pid, nullptr, 0);
    const std::optional<std::int64_t> window = latest_checkpoint(checkpoints_);
    ASSERT_TRUE(window);
    EXPECT_LT(*window, 3000) << "killed before the end";
    const Outcome out = start_all_and_wait(kDuration);
    EXPECT_EQ(out.exit_code, 0) << out.message;
    EXPECT_EQ(out.windows, 3001);
    EXPECT_EQ(out.fe_hash, expected) << role_name(victim);
  }
}

}  // namespace
}  // namespace crosswalk::coupling
