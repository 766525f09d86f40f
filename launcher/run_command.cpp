#include "launcher/run_command.h"

#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "launcher/check_command.h"
#include "launcher/remote.h"
#include "launcher/start.h"

namespace crosswalk {

namespace fs = std::filesystem;

ExitCode run_command(const RunRequest& request, const std::vector<std::string>& command) {
  const fs::path file = find_scenario(request.scenario);
  Scenario scenario;
  const ConfigDocument document = load_scenario(file, request, scenario);
  place_nodes(scenario, request.on);
  check_with_programs(file, programs_of(scenario));

  const RunDirectory directory = make_run_directory(request.out, scenario.name);
  const PreparedRun run{scenario, directory,
                        fmt::format("{}-{}", directory.root().filename().string(), getpid())};
  std::ofstream(directory.scenario()) << document.resolved_text();
  write_provenance(directory, run.run_id, scenario.digest, command);
  return request.is_printed_only ? print_commands(run, request) : start_run(run, request);
}

}  // namespace crosswalk
