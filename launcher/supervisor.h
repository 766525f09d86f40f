// Watches the processes of one run from their start to the verdict.
//
// The first process that fails decides. Then, as after Ctrl-C, the coupler is asked to end the run
// in good order (its abort lets the recorder close the log); who is still there after the grace is
// killed.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "launcher/process.h"
#include "launcher/progress.h"

namespace crosswalk {

struct Verdict {
  ExitCode code = ExitCode::Done;
  std::string text;  ///< empty when all went well
};

/// The last words of a log: its last error message, whole, else its last line; without the prefix.
std::string last_words(const std::filesystem::path& log);

class Supervisor {
 public:
  /// Starts all of them, coupler first.
  Supervisor(const std::vector<ProcessSpec>& specs, ProgressDisplay& display);
  /// Returns when every process has left.
  Verdict run();

 private:
  using Clock = std::chrono::steady_clock;
  struct Failure {
    std::string name;
    ExitStatus status;
    std::optional<double> t_ms;
  };

  void read_coupler(int timeout_ms);
  void take_line(const std::string& line);
  void look_at_processes();
  void press_for_the_end();
  bool is_anyone_running() const;
  Verdict verdict() const;

  std::vector<Process> processes_;
  ProgressDisplay& display_;
  std::string unfinished_line_;
  std::string coupler_error_;  ///< its last @event error
  std::optional<Failure> failure_;
  bool was_interrupted_ = false;
  std::optional<Clock::time_point> ending_since_;
  int pressure_ = 0;  ///< 0 none, 1 coupler asked, 2 all asked, 3 killed, 4 other machines given up
};

}  // namespace crosswalk
