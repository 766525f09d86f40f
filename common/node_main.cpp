#include "common/node_main.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>
#include <optional>

#include <CLI/CLI.hpp>
#include <omp.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "common/error_object.h"
#include "common/interrupt.h"
#include "common/log.h"
#include "common/protocol.h"
#include "common/version.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

struct RunOptions {
  fs::path scenario, out;
  std::string run_id, url;
  int threads = 0;
  double wait_s = 300;
  bool resume = false;
  bool is_verbose = false;
};

/// A process started by the launcher gets SIGTERM when the launcher dies, however that happens.
void leave_with_launcher() {
  const char* launcher = std::getenv("CROSSWALK_LAUNCHER");
  if (launcher != nullptr && launcher == std::to_string(getppid()))
    prctl(PR_SET_PDEATHSIG, SIGTERM);
}

ExitCode run(const NodeProgram& program, const RunOptions& options,
             const std::vector<std::string>& command) {
  const RunDirectory directory(options.out.empty() ? fs::path("runs") / options.run_id
                                                   : options.out);
  directory.create();
  open_log(program.name, directory.log(program.name),
           options.is_verbose ? LogLevel::Debug : LogLevel::Info);
  catch_interrupts();
  leave_with_launcher();
  if (options.threads > 0) omp_set_num_threads(options.threads);
  ConfigDocument document(options.scenario);
  ignore_tables_of_others(document, program.name);
  RunContext context{.document = document,
                     .scenario = read_scenario(document),
                     .run_id = options.run_id,
                     .url = options.url.empty() ? default_lcm_url(options.run_id) : options.url,
                     .directory = directory,
                     .threads = options.threads,
                     .wait_s = options.wait_s,
                     .resume = options.resume};
  log_info("{} {}, run '{}', scenario '{}' (digest {:016x})", program.name, version_text(),
           context.run_id, context.scenario.name, context.scenario.digest);
  write_provenance(directory, context.run_id, context.scenario.digest, command);
  return program.run(context);
}

ExitCode check(const NodeProgram& program, const fs::path& file, const CheckFile& check_file) {
  if (file.extension() != ".toml" && check_file) return check_file(file);
  ConfigDocument document(file);
  ignore_tables_of_others(document, program.name);
  const Scenario scenario = read_scenario(document);
  if (program.read) program.read(document, scenario);
  document.finish();
  return ExitCode::Done;
}

ExitCode print_keys(const NodeProgram& program) {
  ConfigDocument document = ConfigDocument::for_reference();
  if (program.read) program.read(document, Scenario{});
  std::cout << document.key_reference();
  return ExitCode::Done;
}

/// A wrong call, or a request for help: as text, or as an error object where --json was asked for.
int usage_error(CLI::App& app, const CLI::ParseError& error,
                const std::vector<std::string>& command) {
  const bool is_json = std::find(command.begin(), command.end(), "--json") != command.end();
  if (is_json && error.get_exit_code() != 0) {
    std::cout << error_object("usage", error.what()) << "\n";
    return static_cast<int>(ExitCode::UserError);
  }
  return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::UserError);
}

}  // namespace

ExitCode guarded(const std::string& program, const std::function<ExitCode()>& action) {
  const auto say = [&](const std::string& text) {
    log_text(LogLevel::Error, text);
    flush_log();
  };
  try {
    const ExitCode code = action();
    flush_log();
    return code;
  } catch (const UserError& error) {
    say(error.what());
    return ExitCode::UserError;
  } catch (const NumericalError& error) {
    say(fmt::format("{} stopped at {}", program, error.what()));
    return ExitCode::NumericalLimit;
  } catch (const ProtocolError& error) {
    say(error.what());
    return error.code();
  } catch (const std::bad_alloc&) {
    say(fmt::format("{} ran out of memory", program));
    return ExitCode::NodeFailed;
  } catch (const std::exception& error) {
    say(fmt::format("{} {}: {}; this is a bug, please report it", program, version_text(),
                    error.what()));
    return ExitCode::Bug;
  }
}

int node_main(int argc, char** argv, const NodeProgram& program) {
  CLI::App app(program.purpose, program.name);
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  const std::vector<std::string> command(argv, argv + argc);
  std::function<ExitCode()> action;

  RunOptions options;
  CLI::App* run_command = app.add_subcommand("run", "Take part in a run.");
  run_command
      ->add_option("--scenario", options.scenario, "Scenario file, the same for every process")
      ->required();
  run_command->add_option("--run-id", options.run_id, "Name of the run, the same for every process")
      ->required();
  run_command->add_option("--url", options.url, "LCM URL; by default one UDP port per run id");
  run_command->add_option("--out", options.out, "Run folder; runs/<run id> by default");
  run_command->add_option("--threads", options.threads, "Threads of the solver")
      ->check(CLI::Range(1, 256));
  run_command->add_flag("--resume", options.resume, "Continue from the latest checkpoint in --out");
  run_command->add_option("--wait-s", options.wait_s, "Patience with peers that have not joined, s")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  run_command->add_flag("--verbose", options.is_verbose, "Log every window");
  run_command->callback([&] { action = [&] { return run(program, options, command); }; });

  fs::path file;
  CLI::App* check_command = app.add_subcommand("check", "Report every mistake in a file.");
  check_command->add_option("file", file, "Scenario or model file")->required();
  const CheckFile check_file =
      program.check_file ? program.check_file(*check_command) : CheckFile{};
  check_command->callback([&] { action = [&] { return check(program, file, check_file); }; });

  app.add_subcommand("keys", "Print the scenario keys this program reads, as Markdown.")
      ->callback([&] { action = [&] { return print_keys(program); }; });

  for (const NodeCommand& extra : program.commands) {
    CLI::App* sub = app.add_subcommand(extra.name, extra.purpose);
    sub->callback([&action, run_it = extra.define(*sub)] { action = run_it; });
  }

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, command);
  }
  return static_cast<int>(guarded(program.name, action));
}

}  // namespace crosswalk
