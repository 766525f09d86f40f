#include "launcher/start.h"

#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "common/interrupt.h"
#include "common/protocol.h"
#include "launcher/handover.h"
#include "launcher/network.h"
#include "launcher/process.h"
#include "launcher/remote.h"
#include "launcher/supervisor.h"
#include "launcher/tunnel.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

/// The URL when nothing else is asked for: multicast, beyond this machine only when needed.
std::string planned_url(const PreparedRun& run, const RunRequest& request) {
  if (!request.url.empty()) return request.url;
  if (request.is_tunnelled) return fmt::format("tcpq://127.0.0.1:{}", default_port(run.run_id));
  if (hosts_of(run.scenario).empty()) return {};
  std::string url = default_lcm_url(run.run_id);
  const std::size_t ttl = url.find("ttl=0");
  if (ttl != std::string::npos) url.replace(ttl, 5, fmt::format("ttl={}", request.ttl));
  return url;
}

/// Other machines must be reachable from the network the run takes.
void require_way_to_hosts(const PreparedRun& run, const RunRequest& request) {
  const auto hosts = hosts_of(run.scenario);
  if (hosts.empty()) return;
  if (request.is_isolated)
    throw UserError(Problem{{},
                            "--isolate",
                            "all processes on this machine",
                            fmt::format("some on {}", fmt::join(hosts, ", ")),
                            {}});
  const bool is_multicast = planned_url(run, request).starts_with("udpm://");
  if (const std::string defect = is_multicast ? probe_multicast().defect : ""; !defect.empty())
    throw ProtocolError(
        ExitCode::NoTransport,
        fmt::format("no UDP multicast on this machine ({}): give 224.0.0.0/4 a route through the "
                    "interface that leads to {}, or use --tunnel (docs/distributed.md)",
                    defect, fmt::join(hosts, ", ")));
}

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

constexpr int kPageWaitMs = 30'000;  // on a busy machine; a page that fails is known at once

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
    if (poll(&ready, 1, kPageWaitMs) == 1 && read(process_.output(), address.data(), 255) > 0) {
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

/// Starts the processes and watches them to the end.
Verdict start_and_watch(const std::vector<ProcessSpec>& specs) {
  catch_interrupts();
  signal(SIGPIPE, SIG_IGN);
  setenv("CROSSWALK_LAUNCHER", std::to_string(getpid()).c_str(), 1);
  ProgressDisplay display(stdout, isatty(STDOUT_FILENO) != 0 ? ProgressDisplay::Style::Live
                                                             : ProgressDisplay::Style::Plain);
  return Supervisor(specs, display).run();
}

}  // namespace

ExitCode print_commands(const PreparedRun& run, const RunRequest& request) {
  const std::string planned = planned_url(run, request);
  const std::string url = planned.empty() ? default_lcm_url(run.run_id) : planned;
  fmt::print("{}",
             commands_text(process_specs(run.scenario, request, run.directory, run.run_id, url),
                           run.directory, run.run_id));
  return ExitCode::Done;
}

void gather_from_hosts(const PreparedRun& run) {
  const Remote remote{run.run_id};
  for (const std::string& host : hosts_of(run.scenario)) {
    const std::string obstacle = remote.gather(host, run.directory);
    if (!obstacle.empty())
      fmt::print("crosswalk: could not gather the files of {} in {}\n", obstacle,
                 remote_folder(run.run_id).string());
  }
}

void tell_results(const RunDirectory& directory) {
  print_file(directory.summary_text());
  fmt::print("results: {}\n", directory.root().string());
}

ExitCode start_run(const PreparedRun& run, const RunRequest& request) {
  const Scenario& scenario = run.scenario;
  std::optional<LivePageProcess> live_page;
  if (request.is_watched) live_page.emplace(run.directory);
  require_way_to_hosts(run, request);
  const RunNetwork network =
      open_network(planned_url(run, request), request.is_isolated, run.run_id);
  std::optional<Tunnel> tunnel;
  if (request.is_tunnelled)
    tunnel.emplace(default_port(run.run_id), hosts_of(scenario), run.directory);
  fmt::print("{} ({}{}), {:g} ms from first contact, in {}\n", scenario.name,
             name_of(scenario.mode),
             scenario.has_fe() ? fmt::format(", {}", name_of(scenario.fidelity)) : "",
             1e3 * scenario.duration_s, run.directory.root().string());
  std::fflush(stdout);

  std::vector<ProcessSpec> specs =
      process_specs(scenario, request, run.directory, run.run_id, network.url);
  const Remote remote{run.run_id};
  for (const std::string& host : hosts_of(scenario))
    remote.send(host, run.directory, request.is_resumed);
  for (ProcessSpec& spec : specs)
    if (!spec.host.empty()) spec = remote.over_ssh(spec, run.directory);

  const RunningMark mark(run.directory, network);
  const Verdict verdict = start_and_watch(specs);
  gather_from_hosts(run);
  if (verdict.code == ExitCode::Done) {
    tell_results(run.directory);
  } else {
    fmt::print("crosswalk: {}\n", verdict.text);
    tell_what_was_kept(run.directory);
  }
  std::fflush(stdout);
  if (live_page) live_page->let_finish();
  return verdict.code;
}

}  // namespace crosswalk
