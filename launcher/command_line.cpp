#include "launcher/command_line.h"

#include <algorithm>
#include <functional>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/version.h"
#include "launcher/handover.h"

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

}  // namespace

ExitCode launcher_main(const std::vector<std::string>& arguments) {
  if (!arguments.empty()) {
    const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    const std::string_view program = program_for(arguments.front(), rest);
    if (!program.empty()) hand_over(sibling_program(program), arguments);
    if (arguments.front() == "test") run_tests(rest);
  }
  CLI::App app("Crosswalk: a multibody pedestrian coupled with a finite-element head and neck.",
               "crosswalk");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer(handover_help());
  app.add_subcommand("test", "Run the tests (./crosswalk test builds them first).");
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::Done : ExitCode::UserError;
  }
  return ExitCode::Done;
}

}  // namespace crosswalk
