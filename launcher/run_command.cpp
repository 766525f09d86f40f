#include "launcher/run_command.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "common/interrupt.h"
#include "common/protocol.h"
#include "launcher/check_command.h"
#include "launcher/handover.h"
#include "launcher/network.h"
#include "launcher/process.h"
#include "launcher/supervisor.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

/// Tells `crosswalk spy` where to look; there only while the run lives.
class RunningMark {
 public:
  RunningMark(const RunDirectory& directory, const RunNetwork& network)
      : file_(directory.root() / "running") {
    std::ofstream(file_) << getpid() << ' ' << (network.is_private ? "private" : "host") << ' '
                         << network.url << '\n';
  }
  ~RunningMark() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  RunningMark(const RunningMark&) = delete;
  RunningMark& operator=(const RunningMark&) = delete;

 private:
  fs::path file_;
};

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1000000) return fmt::format("{:.1f} kB", 1e-3 * static_cast<double>(bytes));
  return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

void print_file(const fs::path& file) {
  std::ifstream in(file);
  if (in) std::cout << in.rdbuf() << std::flush;
}

/// What a run that ended early leaves behind.
void tell_what_was_kept(const RunDirectory& directory) {
  std::string kept;
  for (const fs::path& file :
       {directory.report(), directory.signals(), directory.channels(), directory.summary()})
    if (std::error_code error; fs::exists(file, error))
      kept +=
          fmt::format("{} ({}), ", file.filename().string(), size_text(fs::file_size(file, error)));
  fmt::print("kept in {}: {}logs/\n", directory.root().string(), kept);
}

/// The live page's server, a reader of the growing log. Started before the run may move into a
/// private network, so that a browser reaches it; the run does not depend on it.
class LivePageProcess {
 public:
  explicit LivePageProcess(const RunDirectory& directory)
      : process_({.name = "watch",
                  .program = sibling_program("recorder"),
                  .arguments = {"watch", directory.root().string(), "--ends-with-run"},
                  .log = directory.log("watch"),
                  .is_output_piped = true}) {
    pollfd ready{process_.output(), POLLIN, 0};
    std::array<char, 256> address{};
    if (poll(&ready, 1, 5000) == 1 && read(process_.output(), address.data(), 255) > 0) {
      fmt::print("live page: {}", address.data());
    } else {
      fmt::print("no live page: {}\n", last_words(directory.log("watch")));
    }
  }
  /// Gives open browsers the time to fetch the report.
  void let_finish() {
    for (int i = 0; i < 60 && !process_.poll(); ++i) usleep(100'000);
  }

 private:
  Process process_;
};

}  // namespace

ExitCode run_command(const RunRequest& request, const std::vector<std::string>& command) {
  const fs::path file = find_scenario(request.scenario);
  Scenario scenario;
  const ConfigDocument document = load_scenario(file, request, scenario);
  check_with_programs(file, programs_of(scenario));

  const RunDirectory directory = make_run_directory(request.out, scenario.name);
  const std::string run_id = fmt::format("{}-{}", directory.root().filename().string(), getpid());
  std::ofstream(directory.scenario()) << document.resolved_text();
  write_provenance(directory, run_id, scenario.digest, command);

  std::optional<LivePageProcess> live_page;
  if (request.is_watched) live_page.emplace(directory);
  const RunNetwork network = open_network(request.url, request.is_isolated, run_id);
  fmt::print("{} ({}{}), {:g} ms from first contact, in {}\n", scenario.name,
             name_of(scenario.mode),
             scenario.has_fe() ? fmt::format(", {}", name_of(scenario.fidelity)) : "",
             1e3 * scenario.duration_s, directory.root().string());
  std::fflush(stdout);

  const RunningMark mark(directory, network);
  catch_interrupts();
  signal(SIGPIPE, SIG_IGN);
  setenv("CROSSWALK_LAUNCHER", std::to_string(getpid()).c_str(), 1);
  ProgressDisplay display(stdout, isatty(STDOUT_FILENO) != 0 ? ProgressDisplay::Style::Live
                                                             : ProgressDisplay::Style::Plain);
  Supervisor supervisor(process_specs(scenario, request, directory, run_id, network.url), display);
  const Verdict verdict = supervisor.run();
  if (verdict.code == ExitCode::Done) {
    print_file(directory.summary_text());
    fmt::print("results: {}\n", directory.root().string());
  } else {
    fmt::print("crosswalk: {}\n", verdict.text);
    tell_what_was_kept(directory);
  }
  std::fflush(stdout);
  if (live_page) live_page->let_finish();
  return verdict.code;
}

}  // namespace crosswalk
