#include "launcher/resume_command.h"

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/checkpoint.h"
#include "common/version.h"
#include "launcher/remote.h"
#include "launcher/start.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

Role role_of(const std::string& program) {
  for (const Role role : {Role::Coupler, Role::Mb, Role::Fe, Role::Recorder})
    if (role_name(role) == program) return role;
  CW_ASSERT(false && "a program without role");
  return Role::Tool;
}

/// Empty when the file is missing or cut, as after a crash.
nlohmann::json json_of(const fs::path& file) {
  std::ifstream in(file);
  return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
}

bool is_finished(const RunDirectory& directory) {
  const nlohmann::json summary = json_of(directory.summary());
  return summary.is_object() && summary.contains("record") &&
         summary["record"].value("complete", false);
}

/// The launcher that marked the folder as running is alive.
bool is_running(const RunDirectory& directory) {
  std::ifstream mark(directory.root() / "running");
  pid_t launcher = 0;
  if (!(mark >> launcher)) return false;
  std::error_code none;
  const fs::path program = fs::read_symlink(fmt::format("/proc/{}/exe", launcher), none);
  return program.filename() == "crosswalk";
}

[[noreturn]] void refuse(const fs::path& where, const std::string& what,
                         const std::string& expected, const std::string& found,
                         const std::string& hint) {
  throw UserError(Problem{Place{where.string()}, what, expected, found, hint});
}

/// A name beside `file` that is not taken: signals.1.lcmlog.
void set_aside(const fs::path& file) {
  if (!fs::exists(file)) return;
  for (int i = 1;; ++i) {
    const fs::path aside = file.parent_path() / fmt::format("{}.{}{}", file.stem().string(), i,
                                                            file.extension().string());
    if (fs::exists(aside)) continue;
    fs::rename(file, aside);
    return;
  }
}

std::string run_id_of(const RunDirectory& directory) {
  const nlohmann::json provenance = json_of(directory.provenance());
  if (!provenance.is_object() || !provenance.contains("run_id"))
    refuse(directory.provenance(), "resume", "the record of how the run was made", "none",
           "start the run anew with `crosswalk run`");
  return provenance["run_id"].get<std::string>();
}

void note_in_provenance(const RunDirectory& directory, const InterruptedRun& run,
                        const std::vector<std::string>& command) {
  std::ifstream in(directory.provenance());
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(in);
  json["resumed"].push_back({{"from_window", run.window.value_or(0)},
                             {"crosswalk", version_text()},
                             {"command", command}});
  std::ofstream(directory.provenance()) << json.dump(2) << '\n';
}

}  // namespace

InterruptedRun inspect_interrupted(const RunDirectory& directory, const Scenario& scenario) {
  const fs::path& root = directory.root();
  if (is_running(directory))
    refuse(root, "resume", "a run that ended early", "one that is running", "");
  const std::string digest = fmt::format("{:016x}", scenario.digest);
  const auto recorded = json_of(directory.provenance()).value("scenario_digest", digest);
  if (recorded != digest)
    refuse(directory.scenario(), "resume",
           fmt::format("the scenario the run was started with (digest {})", recorded),
           fmt::format("another one (digest {})", digest),
           "undo the change, or start a new run with it");
  InterruptedRun run{latest_checkpoint(directory.checkpoints())};
  if (run.window)
    for (const std::string& program : programs_of(scenario))
      read_part(directory.checkpoints(), role_of(program), *run.window);
  return run;
}

ExitCode resume_command(RunRequest request, const std::vector<std::string>& command) {
  const RunDirectory directory(fs::absolute(request.scenario).lexically_normal());
  if (!fs::is_regular_file(directory.scenario()))
    refuse(request.scenario, "resume", "the folder of a run", "no scenario.toml there",
           "give the folder that `crosswalk run` named, for example runs/v2370-...");
  PreparedRun run{{}, directory, {}};
  load_scenario(directory.scenario(), {}, run.scenario);
  place_nodes(run.scenario, request.on);
  run.run_id = run_id_of(directory);
  gather_from_hosts(run);
  // A process may have died after its work was done.
  if (is_finished(directory)) {
    fmt::print("{} is finished, nothing is left to do\n", run.run_id);
    tell_results(directory);
    return ExitCode::Done;
  }
  const InterruptedRun interrupted = inspect_interrupted(directory, run.scenario);
  request.is_resumed = interrupted.window.has_value();
  if (request.is_printed_only) return print_commands(run, request);

  if (interrupted.window) {
    fmt::print("resuming {} from the checkpoint of window {}\n", run.run_id, *interrupted.window);
  } else {
    fmt::print("{} ended before its first checkpoint: it starts from the beginning\n", run.run_id);
    set_aside(directory.signals());
  }
  // So that what the processes say from now on is not mixed with their end before.
  for (const std::string& program : programs_of(run.scenario)) set_aside(directory.log(program));
  note_in_provenance(directory, interrupted, command);
  return start_run(run, request);
}

}  // namespace crosswalk
