// A child process in a process group of its own, its output in files or a pipe; or our end of a
// process on another machine.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace crosswalk {

struct ProcessSpec {
  std::string name;
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path log;         ///< takes standard error, and standard output unless piped
  bool is_output_piped = false;      ///< standard output comes to us
  std::string host = {};             ///< of another machine: the program is a way to it (remote.h)
  std::string command_text() const;  ///< for copy and paste into a shell
};

/// Quoted for a shell where needed.
std::string shell_word(const std::string& word);

struct ExitStatus {
  int code = 0;    ///< when it left by itself
  int signal = 0;  ///< when it was killed; else 0
  bool is_success() const { return code == 0 && signal == 0; }
  std::string text() const;  ///< "exit 3" or "killed by signal 9 (Killed)"
};

class Process {
 public:
  /// Starts it; throws UserError when that fails.
  explicit Process(ProcessSpec spec);
  ~Process();  ///< kills what still runs
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;

  const std::string& name() const { return spec_.name; }
  const ProcessSpec& spec() const { return spec_; }
  pid_t pid() const { return pid_; }
  bool is_running() const { return pid_ > 0 && !status_; }
  /// How it ended; looks, never waits.
  const std::optional<ExitStatus>& poll();
  ExitStatus wait();
  /// To the process, also on another machine.
  void send(int signal_number);
  /// Kills what runs here, should the other machine not answer any more.
  void abandon();
  /// Reading end of the pipe, non-blocking; -1 when not piped.
  int output() const { return output_; }

 private:
  ProcessSpec spec_;
  pid_t pid_ = -1;
  int output_ = -1;
  int input_ = -1;  ///< writing end of the standard input of a process on another machine
  std::optional<ExitStatus> status_;
};

}  // namespace crosswalk
