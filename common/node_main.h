// The `main` shared by coupler, mb_node, fe_node and recorder: command line, log, exit codes.
//
//   PROGRAM run --scenario FILE --run-id ID [--url URL] [--out DIR] [--threads N] [--wait-s S]
//   PROGRAM check FILE        reads the file, reports every problem, starts nothing
//   PROGRAM keys              the key reference of its tables, as Markdown
// and whatever further commands a program adds. Exceptions become one message and an ExitCode.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/run_directory.h"
#include "common/scenario.h"

namespace CLI {
class App;
}

namespace crosswalk {

/// What `run` was started with. The scenario's shared tables are read; the node reads its own from
/// the document and then calls document.finish().
struct RunContext {
  ConfigDocument& document;
  Scenario scenario;
  std::string run_id;
  std::string url;  ///< LCM; the default one of the run id when not given
  RunDirectory directory;
  int threads = 0;      ///< 0: as many as OpenMP takes; already set
  double wait_s = 300;  ///< patience with peers that have not joined
  bool resume = false;  ///< continue from the latest checkpoint; told to coupler and recorder
};

/// A further command of a program. `define` adds its options and returns what to do.
struct NodeCommand {
  std::string name;
  std::string purpose;
  std::function<std::function<ExitCode()>(CLI::App& options)> define;
};

using CheckFile = std::function<ExitCode(const std::filesystem::path& file)>;

struct NodeProgram {
  std::string name;     ///< "mb_node"
  std::string purpose;  ///< one line of --help
  /// Reads every key of the program's tables; for `check` and `keys`, which finish the document.
  std::function<void(ConfigDocument& document, const Scenario& scenario)> read = {};
  std::function<ExitCode(RunContext& context)> run = {};
  /// Files other than .toml given to `check` (fe_node: keyword decks): adds its options and returns
  /// what checks a file. May be empty.
  std::function<CheckFile(CLI::App& options)> check_file = {};
  std::vector<NodeCommand> commands = {};
};

/// Runs the program; the value for main to return.
int node_main(int argc, char** argv, const NodeProgram& program);

/// Calls `action` and turns what it throws into one message on the console (and in the log) and an
/// exit code. The only place that catches everything.
ExitCode guarded(const std::string& program, const std::function<ExitCode()>& action);

}  // namespace crosswalk
