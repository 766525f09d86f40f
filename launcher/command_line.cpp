#include "launcher/command_line.h"

#include <algorithm>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/version.h"
#include "launcher/check_command.h"
#include "launcher/handover.h"
#include "launcher/plan.h"
#include "launcher/replay_command.h"
#include "launcher/resume_command.h"
#include "launcher/run_command.h"
#include "launcher/spy_command.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

std::string handover_help() {
  std::string text = "Further commands (--help after each tells more):\n";
  for (const Handover& h : handovers()) text += fmt::format("  {:<10} {}\n", h.command, h.purpose);
  return text;
}

/// Runs the tests of the build this program belongs to.
[[noreturn]] void run_tests(const std::vector<std::string>& further) {
  const fs::path build = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  std::vector<std::string> arguments = {"--test-dir",         build.string(),
                                        "--label-regex",      "^(unit|verification|system)$",
                                        "--parallel",         "2",
                                        "--output-on-failure"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  hand_over("ctest", arguments);
}

/// Options of `run` and `resume` alike: how the processes are started, not what they compute.
void add_start_options(CLI::App& command, RunRequest& request) {
  command.add_option("--threads", request.threads, "Threads of the finite-element solver")
      ->check(CLI::Range(1, 256));
  command.add_option("--lcm-url", request.url, "LCM URL; by default one UDP port per run");
  command.add_option("--wait-s", request.wait_s, "Patience until every process has joined, s")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--on", request.on,
                     "Processes on other machines, by ssh: fe=hostA,mb=hostB,coupler=...,"
                     "recorder=... (docs/distributed.md)");
  command.add_option("--remote-programs", request.remote_programs,
                     "Folder of the programs on the other machines; as here by default");
  command.add_option("--ttl", request.ttl, "Networks that multicast to other machines may cross")
      ->capture_default_str()
      ->check(CLI::Range(1, 255));
  command.add_flag("--tunnel", request.is_tunnelled,
                   "Messages to other machines through ssh, by a broker on this one");
  command.add_flag("--isolate", request.is_isolated, "Keep the messages in a private network");
  command.add_flag("--watch", request.is_watched, "Serve a live page on localhost while it runs");
  command.add_flag("--print-commands", request.is_printed_only,
                   "Show the command of each process instead of starting them");
}

CLI::App* define_run(CLI::App& app, RunRequest& request) {
  CLI::App* run =
      app.add_subcommand("run", "Run a scenario: all processes, to the table of results.");
  run->add_option("scenario", request.scenario, "Name under scenarios/tests/, or a file")
      ->required();
  run->add_option("--mode", request.mode,
                  "As the scenario says by default; a head alone (--from): prescribed follows the "
                  "head of a run, impact_only meets the car as it did")
      ->check(CLI::IsMember({"coupled", "multibody", "prescribed", "impact_only"}));
  run->add_option("--from", request.from, "Run whose head a head alone follows");
  run->add_option("--fidelity", request.fidelity, "Mesh of the generated model")
      ->check(CLI::IsMember({"coarse", "medium", "fine"}));
  run->add_option("--until-ms", request.until_ms, "End, simulated ms after first contact")
      ->check(CLI::PositiveNumber);
  run->add_option("--out", request.out, "Run folder; runs/<name>-<time> by default");
  add_start_options(*run, request);
  return run;
}

CLI::App* define_resume(CLI::App& app, RunRequest& request) {
  CLI::App* resume = app.add_subcommand(
      "resume", "Continue a run that ended early, from its latest checkpoint to the end.");
  resume->add_option("run", request.scenario, "Run folder")->required();
  add_start_options(*resume, request);
  return resume;
}

CLI::App* define_replay(CLI::App& app, ReplayRequest& request) {
  CLI::App* replay = app.add_subcommand("replay", "Play a log back to the bus.");
  replay->add_option("log", request.source, "Run folder, or any LCM event log")->required();
  replay->add_option("--speed", request.speed, "Times the pace of the recording")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  replay
      ->add_option(
          "--to", request.to,
          "bus: whoever listens; spy: lcm-spy; recorder: a fresh recorder and its results; fe: "
          "a fresh fe_node does the windows again, its states are compared")
      ->capture_default_str()
      ->check(CLI::IsMember({"bus", "spy", "recorder", "fe"}));
  replay->add_option("--out", request.out, "Folder of the fresh process; <run>/replay by default");
  replay->add_option("--lcm-url", request.url, "LCM URL; by default one UDP port per run");
  replay->add_flag("--isolate", request.is_isolated, "Keep the messages in a private network");
  return replay;
}

/// `model` takes a scenario's name as `run` does; fe_node knows files alone.
std::vector<std::string> with_scenario_file(std::vector<std::string> arguments) {
  if (arguments[0] == "model" && arguments.size() > 1 && arguments[1][0] != '-')
    arguments[1] = find_scenario(arguments[1]).string();
  return arguments;
}

std::vector<std::string> command_words(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"crosswalk"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace

ExitCode launcher_main(const std::vector<std::string>& arguments) {
  if (!arguments.empty()) {
    const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    const std::string_view program = program_for(arguments.front(), rest);
    if (!program.empty()) hand_over(sibling_program(program), with_scenario_file(arguments));
    if (arguments.front() == "test") run_tests(rest);
  }
  CLI::App app("Crosswalk: a multibody pedestrian coupled with a finite-element head and neck.",
               "crosswalk");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  std::function<ExitCode()> action;
  RunRequest request;
  define_run(app, request)->callback([&] {
    action = [&] { return run_command(request, command_words(arguments)); };
  });
  RunRequest resumed;
  define_resume(app, resumed)->callback([&] {
    action = [&] { return resume_command(resumed, command_words(arguments)); };
  });
  ReplayRequest played;
  define_replay(app, played)->callback([&] { action = [&] { return replay_command(played); }; });
  std::string file, run;
  CLI::App* check = app.add_subcommand("check", "Report every mistake in a scenario or a deck.");
  check->footer(
      "A keyword deck is reported by fe_node: `crosswalk check DECK.k --help` tells more.");
  check->add_option("file", file, "Name under scenarios/tests/, scenario file or keyword deck")
      ->required();
  check->callback([&] { action = [&] { return check_command(file); }; });
  app.add_subcommand("keys", "Print every key a scenario may have, as Markdown.")->callback([&] {
    action = keys_command;
  });
  CLI::App* spy = app.add_subcommand("spy", "Look at the messages of a running run (lcm-spy).");
  spy->add_option("run", run, "Run folder; the newest running one by default");
  spy->callback([&] { action = [&] { return spy_command(run); }; });
  app.add_subcommand("test", "Run the tests (./crosswalk test builds them first).");
  app.footer(handover_help());  // after the subcommands, which would inherit it
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::Done : ExitCode::UserError;
  }
  return action ? action() : ExitCode::Done;
}

}  // namespace crosswalk
