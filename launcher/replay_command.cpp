#include "launcher/replay_command.h"

#include <chrono>
#include <fstream>
#include <iostream>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/run_directory.h"
#include "launcher/handover.h"
#include "launcher/network.h"
#include "launcher/process.h"
#include "launcher/spy_command.h"
#include "launcher/supervisor.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPlayer = "/usr/bin/lcm-logplayer";
// The player does not wait for listeners: lcm-spy starts a Java machine, LCM tests itself.
constexpr std::chrono::seconds kSpyStart{4}, kRecorderStart{2};

fs::path log_of(const fs::path& source) {
  const fs::path log = fs::is_directory(source) ? RunDirectory(source).signals() : source;
  if (!fs::is_regular_file(log))
    throw UserError(Problem{Place{source.string()},
                            "replay",
                            "a run folder with signals.lcmlog, or an LCM event log",
                            "none",
                            {}});
  return log;
}

/// Empty for a log without a run folder.
std::string run_id_of(const fs::path& source) {
  std::ifstream in(RunDirectory(source).provenance());
  const auto provenance = nlohmann::json::parse(in, nullptr, false);
  return provenance.is_object() ? provenance.value("run_id", "") : "";
}

ProcessSpec recorder_process(const ReplayRequest& request, const std::string& run_id,
                             const std::string& url, const fs::path& out) {
  if (run_id.empty())
    throw UserError(Problem{Place{request.source.string()}, "--to recorder", "a run folder",
                            "a log alone", "`crosswalk analyze LOG` reads it without a bus"});
  const RunDirectory directory(out);
  if (fs::exists(directory.signals()))
    throw UserError(Problem{Place{out.string()}, "--out", "a folder without a log", "one with",
                            "choose another folder"});
  directory.create();
  ProcessSpec spec;
  spec.name = "recorder";
  spec.program = sibling_program("recorder");
  spec.arguments = {"run",      "--scenario", RunDirectory(request.source).scenario().string(),
                    "--run-id", run_id,       "--url",
                    url,        "--out",      out.string()};
  spec.log = directory.log("recorder");
  return spec;
}

/// fe_node does the recorded grants again; what the comparison says comes to our output.
ExitCode replay_to_fe(const ReplayRequest& request, const std::string& run_id,
                      const std::string& url, const fs::path& out) {
  const RunDirectory source(request.source), directory(out);
  if (run_id.empty())
    throw UserError(
        Problem{Place{request.source.string()}, "--to fe", "a run folder", "a log alone", {}});
  directory.create();
  Process node({.name = "fe_node",
                .program = sibling_program("fe_node"),
                .arguments = {"run", "--scenario", source.scenario().string(), "--run-id", run_id,
                              "--url", url, "--out", out.string()},
                .log = directory.log("fe_node")});
  Process feed({.name = "recorder feed",
                .program = sibling_program("recorder"),
                .arguments = {"feed", request.source.string(), "--url", url, "--run-id", run_id},
                .log = directory.log("feed")});
  fmt::print("fe_node does the windows of {} again, in {}\n", request.source.string(),
             out.string());
  std::fflush(stdout);
  while (!feed.poll()) {
    if (node.poll() && !node.poll()->is_success()) {
      fmt::print("crosswalk: fe_node failed ({}):\n{}\n", node.poll()->text(),
                 last_words(directory.log("fe_node")));
      return ExitCode::NodeFailed;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::cout << std::ifstream(directory.log("feed")).rdbuf() << std::flush;
  const ExitStatus status = *feed.poll();
  if (status.is_success()) node.wait();
  return status.signal != 0 ? ExitCode::NodeFailed : static_cast<ExitCode>(status.code);
}

ProcessSpec player_process(const fs::path& log, double speed, const std::string& url) {
  if (!fs::exists(kPlayer))
    throw UserError(Problem{Place{kPlayer}, "replay", "the player of LCM", "none",
                            "install the packages of cmake/debian-packages.txt"});
  ProcessSpec spec;
  spec.name = "lcm-logplayer";
  spec.program = kPlayer;
  spec.arguments = {fmt::format("--lcm-url={}", url), fmt::format("--speed={:g}", speed),
                    log.string()};
  spec.log = "/dev/null";
  return spec;
}

}  // namespace

ExitCode replay_command(const ReplayRequest& request) {
  const fs::path log = log_of(request.source);
  const std::string run_id = run_id_of(request.source);
  const RunNetwork network = open_network(request.url, request.is_isolated,
                                          run_id.empty() ? log.filename().string() : run_id);
  const fs::path out = request.out.empty() ? request.source / "replay" : request.out;
  if (request.to == "fe") return replay_to_fe(request, run_id, network.url, out);
  std::optional<Process> listener;
  if (request.to == "spy") {
    listener.emplace(spy_process(network.url));
    std::this_thread::sleep_for(kSpyStart);
  } else if (request.to == "recorder") {
    listener.emplace(recorder_process(request, run_id, network.url, out));
    std::this_thread::sleep_for(kRecorderStart);
  }
  fmt::print("playing {} at {:g} times its pace on {}\n", log.string(), request.speed, network.url);
  std::fflush(stdout);
  Process player(player_process(log, request.speed, network.url));
  const ExitStatus played = player.wait();
  if (!played.is_success())
    throw ProtocolError(ExitCode::NoTransport, fmt::format("lcm-logplayer: {}", played.text()));
  if (!listener) return ExitCode::Done;
  if (request.to == "spy") fmt::print("played; close the window of lcm-spy to end\n");
  std::fflush(stdout);
  const ExitStatus status = listener->wait();
  if (request.to == "spy" || status.is_success()) {
    if (request.to == "recorder") fmt::print("results: {}\n", out.string());
    return ExitCode::Done;
  }
  fmt::print("crosswalk: the recorder ended with {}; its log: {}\n", status.text(),
             RunDirectory(out).log("recorder").string());
  return status.signal != 0 ? ExitCode::NodeFailed : static_cast<ExitCode>(status.code);
}

}  // namespace crosswalk
