// kill -9 of each process at random moments: the run ends within 5 s and says why, its log is whole
// up to the last window that was acknowledged, and `crosswalk resume` gives the channels of an
// uninterrupted run. CROSSWALK_KILL_TRIALS changes the number of moments per process (25).
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "common/bus.h"
#include "crosswalk/msg/recorder_ack.hpp"
#include "recorder/run_record.h"
#include "tests/system/real_run.h"

namespace crosswalk::system_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// Hears what the recorder of a run acknowledges.
class AckListener {
 public:
  explicit AckListener(const fs::path& run) {
    const std::string mark = text_of(run / "running");
    const std::size_t url = mark.find("udpm://");
    if (url == std::string::npos) return;
    bus_ = std::make_unique<Bus>(open_transport(mark.substr(url, mark.find('\n') - url)),
                                 provenance_of(run, "run_id"), Role::Tool);
    bus_->subscribe<msg::recorder_ack>(Role::Recorder, [this](const msg::recorder_ack& ack) {
      acknowledged_ = std::max(acknowledged_, ack.window);
    });
  }
  std::int64_t acknowledged() {
    if (bus_) bus_->handle_pending();
    return acknowledged_;
  }

 private:
  std::unique_ptr<Bus> bus_;
  std::int64_t acknowledged_ = -1;
};

class KillTrials : public RealRun {
 protected:
  struct Kind {
    std::string name;
    std::vector<std::string> options;
    double duration_s = 0;  ///< of the undisturbed run
  };

  void measure(Kind& kind) {
    const auto begin = Clock::now();
    complete(kind.name, kind.options);
    kind.duration_s = seconds_since(begin);
  }

  /// Every window up to the one acknowledged, with both answers and its audit.
  void expect_log_holds(std::int64_t acknowledged, bool has_fe) {
    if (acknowledged < 0) return;
    const recording::RunRecord record = recording::read_run_record(out("a") / "signals.lcmlog");
    for (std::int64_t window = 0; window <= acknowledged; ++window) {
      const bool is_whole = record.mb.contains(window) && record.audit.contains(window) &&
                            (!has_fe || record.fe.contains(window));
      ASSERT_TRUE(is_whole) << "window " << window << " of " << acknowledged << " acknowledged";
    }
  }

  void expect_verdict(const std::string& victim, const ExitStatus& status,
                      const std::string& said) {
    EXPECT_EQ(status.code, 3) << said;
    EXPECT_THAT(said, HasSubstr(fmt::format("crosswalk: {} failed ", victim)));
    EXPECT_THAT(said, HasSubstr("killed by signal 9"));
    EXPECT_THAT(said, HasSubstr("kept in "));
  }

  /// One death; false when the run was over before it came.
  bool dies(const Kind& kind, const std::string& victim, double after_s) {
    fs::remove_all(out("a"));
    Launched launched = run("a", kind.options);
    const auto begin = Clock::now();
    std::optional<AckListener> listener;
    pid_t pid = 0;
    while (seconds_since(begin) < after_s || pid == 0) {
      if (launched.wait(0)) return false;
      if (pid == 0) pid = launched.child(victim);
      if (!listener && text_of(out("a") / "running").ends_with('\n')) listener.emplace(out("a"));
      if (listener) listener->acknowledged();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (launched.wait(0) || kill(pid, SIGKILL) != 0) return false;
    const std::int64_t acknowledged = listener ? listener->acknowledged() : -1;
    const auto killed = Clock::now();
    const auto status = launched.wait(20);
    const double ended_s = seconds_since(killed);
    longest_end_s_ = std::max(longest_end_s_, ended_s);
    if (!status) ADD_FAILURE() << "still running:\n" << launched.output();
    if (!status) return true;
    if (status->is_success()) return false;  // its work was done
    EXPECT_LT(ended_s, 5) << launched.output();
    expect_verdict(victim, *status, launched.output());
    expect_log_holds(acknowledged, kind.name == "coupled");
    Launched resumed = call("crosswalk", {"resume", out("a").string()}, "resumed");
    const auto end = resumed.wait(kLong);
    EXPECT_TRUE(end && end->is_success()) << resumed.output();
    EXPECT_TRUE(channels_of(out("a")) == channels_of(out(kind.name)));
    ++acknowledged_windows_[acknowledged >= 0 ? "some" : "none"];
    return true;
  }

  /// `count` deaths of `victim` at moments spread over the whole run, its start included.
  void die_often(const Kind& kind, const std::string& victim, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> moment(0, kind.duration_s);
    int done = 0, late = 0;
    while (done < count && !HasFailure() && late < 10 * count) {
      const double after_s = moment(random);
      if (!dies(kind, victim, after_s)) {
        ++late;
        continue;
      }
      ++done;
      fmt::print("{} {} killed after {:.3f} s: {}\n", kind.name, victim, after_s,
                 HasFailure() ? "FAILED" : "ended, resumed, same channels");
      std::fflush(stdout);
    }
    EXPECT_EQ(done, count);
    total_ += done;
  }

  double longest_end_s_ = 0;
  int total_ = 0;
  std::map<std::string, int> acknowledged_windows_;
};

int trials() {
  const char* asked = std::getenv("CROSSWALK_KILL_TRIALS");
  return asked != nullptr ? std::atoi(asked) : 25;
}

TEST_F(KillTrials, EachProcessAtRandomMoments) {
  lay_over("[coupling]\ncheckpoint_every_ms = 1\n");
  Kind multibody{"multibody", {"--mode", "multibody", "--until-ms", "20"}};
  Kind coupled{"coupled", {"--until-ms", "1.5"}};
  measure(multibody);
  measure(coupled);
  const int n = trials(), of_them_coupled = std::max(1, n / 5);
  unsigned seed = 1;
  for (const char* victim : {"coupler", "mb_node", "recorder"}) {
    die_often(multibody, victim, n - of_them_coupled, seed++);
    die_often(coupled, victim, of_them_coupled, seed++);
  }
  die_often(coupled, "fe_node", n, seed);
  fmt::print("{} deaths, {} of them before the first acknowledged window; longest end {:.2f} s\n",
             total_, acknowledged_windows_["none"], longest_end_s_);
}

}  // namespace
}  // namespace crosswalk::system_test
