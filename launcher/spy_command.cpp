#include "launcher/spy_command.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include "launcher/handover.h"

namespace crosswalk {

namespace fs = std::filesystem;

namespace {

// Debian's liblcm-java and libjchart2d-java.
constexpr const char* kLcmJar = "/usr/share/java/lcm.jar";
constexpr const char* kChartJar = "/usr/share/java/jchart2d.jar";

struct RunningRun {
  pid_t launcher = 0;
  bool is_private = false;
  std::string url;
};

std::optional<RunningRun> running_run(const fs::path& folder) {
  std::ifstream in(folder / "running");
  RunningRun run;
  std::string network;
  if (!(in >> run.launcher >> network >> run.url)) return std::nullopt;
  run.is_private = network == "private";
  return run;
}

fs::path newest_running() {
  fs::path newest;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("runs", ignored)) {
    if (!fs::exists(entry.path() / "running")) continue;
    if (newest.empty() ||
        fs::last_write_time(entry.path() / "running") > fs::last_write_time(newest / "running"))
      newest = entry.path();
  }
  return newest;
}

/// Enters the private network of a running launcher.
void join_network_of(pid_t launcher) {
  for (const char* kind : {"user", "net"}) {
    const std::string path = fmt::format("/proc/{}/ns/{}", launcher, kind);
    const int ns = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool is_joined = ns >= 0 && setns(ns, 0) == 0;
    if (ns >= 0) close(ns);
    // The user namespace is our own already when a root launcher made the network alone.
    if (!is_joined && std::string_view(kind) == "net")
      throw UserError(Problem{Place{path}, "the run's private network", "to be let in", "refused",
                              "use the account that started the run"});
  }
}

}  // namespace

ExitCode spy_command(const std::string& wanted) {
  const fs::path folder = wanted.empty() ? newest_running() : fs::path(wanted);
  const std::optional<RunningRun> run = folder.empty() ? std::nullopt : running_run(folder);
  if (!run)
    throw UserError(Problem{Place{folder.string()}, "spy", "the folder of a run that is running",
                            folder.empty() ? "none under runs/" : "one that is not",
                            "replay a finished one with `crosswalk replay`"});
  if (run->is_private) join_network_of(run->launcher);
  const ProcessSpec spy = spy_process(run->url);
  hand_over(spy.program, spy.arguments);
}

ProcessSpec spy_process(const std::string& url) {
  const fs::path types =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/crosswalk_types.jar";
  for (const fs::path& jar : {fs::path(kLcmJar), fs::path(kChartJar), types})
    if (!fs::exists(jar))
      throw UserError(Problem{Place{jar.string()}, "spy", "this Java archive", "none",
                              "install the packages of cmake/debian-packages.txt and build again"});
  ProcessSpec spec;
  spec.name = "lcm-spy";
  spec.program = "java";
  // The script lcm-spy of LCM 1.3.1 does not start under Java 17; this call does. It knows a URL
  // only from the environment.
  setenv("LCM_DEFAULT_URL", url.c_str(), 1);
  spec.arguments = {"-Djava.net.preferIPv4Stack=true", "-Xmx256m", "-cp",
                    fmt::format("{}:{}:{}", kLcmJar, kChartJar, types.string()), "lcm.spy.Spy"};
  spec.log = "/dev/null";
  return spec;
}

}  // namespace crosswalk
