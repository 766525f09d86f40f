#include "launcher/process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/error.h"

extern char** environ;

namespace crosswalk {

namespace {

/// Attributes and redirections of posix_spawn, freed on every path.
struct SpawnSetup {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
  SpawnSetup() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;
};

/// A shell on another machine tells a signal as 128 plus its number; 255 is ssh's own failure.
ExitStatus status_from(int raw, bool is_remote) {
  constexpr int kShellSignal = 128, kSignals = 64;
  if (WIFSIGNALED(raw)) return {0, WTERMSIG(raw)};
  const int code = WEXITSTATUS(raw);
  if (is_remote && code > kShellSignal && code <= kShellSignal + kSignals &&
      code != static_cast<int>(ExitCode::Interrupted))
    return {0, code - kShellSignal};
  return {code, 0};
}

bool needs_quotes(const std::string& word) {
  return word.empty() || word.find_first_not_of(
                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWX"
                             "YZ0123456789_-+=./:,@%") != std::string::npos;
}

}  // namespace

std::string shell_word(const std::string& word) {
  if (!needs_quotes(word)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string ProcessSpec::command_text() const {
  std::string text = shell_word(program.string());
  for (const std::string& argument : arguments) text += " " + shell_word(argument);
  return text;
}

std::string ExitStatus::text() const {
  if (signal != 0) return fmt::format("killed by signal {} ({})", signal, strsignal(signal));
  return fmt::format("exit {}", code);
}

Process::Process(ProcessSpec spec) : spec_(std::move(spec)) {
  SpawnSetup setup;
  posix_spawnattr_setflags(&setup.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&setup.attributes, 0);
  sigset_t defaults;
  sigfillset(&defaults);
  posix_spawnattr_setsigdefault(&setup.attributes, &defaults);
  const int log_flags = O_WRONLY | O_CREAT | O_APPEND;
  std::array<int, 2> pipe_ends = {-1, -1};
  if (spec_.is_output_piped && pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw UserError(Problem{{}, "pipe", {}, std::strerror(errno), {}});
  std::array<int, 2> input_ends = {-1, -1};
  if (!spec_.host.empty()) {
    if (pipe2(input_ends.data(), O_CLOEXEC) != 0)
      throw UserError(Problem{{}, "pipe", {}, std::strerror(errno), {}});
    posix_spawn_file_actions_adddup2(&setup.files, input_ends[0], 0);
  } else {
    posix_spawn_file_actions_addopen(&setup.files, 0, "/dev/null", O_RDONLY, 0);
  }
  posix_spawn_file_actions_addopen(&setup.files, 2, spec_.log.c_str(), log_flags, 0644);
  posix_spawn_file_actions_adddup2(&setup.files, spec_.is_output_piped ? pipe_ends[1] : 2, 1);
  std::vector<std::string> words = {spec_.program.string()};
  words.insert(words.end(), spec_.arguments.begin(), spec_.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // ssh is looked for in PATH; our own programs have a folder.
  const int error = posix_spawnp(&pid_, spec_.program.c_str(), &setup.files, &setup.attributes,
                                 argv.data(), environ);
  if (pipe_ends[1] >= 0) close(pipe_ends[1]);
  if (input_ends[0] >= 0) close(input_ends[0]);
  output_ = pipe_ends[0];
  input_ = input_ends[1];
  if (error != 0) {
    pid_ = -1;
    if (output_ >= 0) close(output_);
    if (input_ >= 0) close(input_);
    throw UserError(
        Problem{Place{spec_.program.string()}, "cannot be started", {}, std::strerror(error), {}});
  }
  if (output_ >= 0) fcntl(output_, F_SETFL, O_NONBLOCK);
}

Process::Process(Process&& other) noexcept
    : spec_(std::move(other.spec_)),
      pid_(std::exchange(other.pid_, -1)),
      output_(std::exchange(other.output_, -1)),
      input_(std::exchange(other.input_, -1)),
      status_(other.status_) {}

Process::~Process() {
  if (is_running()) {
    send(SIGKILL);
    abandon();
    wait();
  }
  if (output_ >= 0) close(output_);
  if (input_ >= 0) close(input_);
}

const std::optional<ExitStatus>& Process::poll() {
  int raw = 0;
  if (is_running() && waitpid(pid_, &raw, WNOHANG) == pid_)
    status_ = status_from(raw, !spec_.host.empty());
  return status_;
}

ExitStatus Process::wait() {
  int raw = 0;
  while (is_running()) {
    if (waitpid(pid_, &raw, 0) == pid_)
      status_ = status_from(raw, !spec_.host.empty());
    else if (errno != EINTR)
      status_ = ExitStatus{static_cast<int>(ExitCode::Bug), 0};  // not our child: cannot be
  }
  return *status_;
}

void Process::send(int signal_number) {
  if (!is_running()) return;
  if (spec_.host.empty()) {
    // A group of its own: what a node starts itself gets the signal as well.
    kill(-pid_, signal_number);
    return;
  }
  const std::string line = fmt::format("{}\n", sigabbrev_np(signal_number));
  if (input_ < 0 || write(input_, line.data(), line.size()) < 0) abandon();
}

void Process::abandon() {
  if (is_running()) kill(-pid_, SIGKILL);
}

}  // namespace crosswalk
