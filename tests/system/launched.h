// Starting `crosswalk` and looking at what it does, for system tests.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process.h"

namespace crosswalk::system_test {

/// A temporary folder of this test, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string text_of(const std::filesystem::path& file);

/// True as soon as `condition` holds; false after `seconds`.
bool wait_for(double seconds, const std::function<bool()>& condition);

/// A program started with its output in a file.
class Launched {
 public:
  Launched(const std::filesystem::path& program, std::vector<std::string> arguments,
           const std::filesystem::path& output);
  /// The exit status, or nothing when it is still running after `seconds`.
  std::optional<ExitStatus> wait(double seconds);
  void send(int signal_number) { process_.send(signal_number); }
  std::string output() const { return text_of(output_); }
  bool has_said(const std::string& text) const;
  /// Process id of the child called `name`; 0 when there is none.
  pid_t child(const std::string& name) const;

 private:
  std::filesystem::path output_;
  Process process_;
};

/// Process ids of all processes whose command line holds `text`.
std::vector<pid_t> processes_with(const std::string& text);
/// Of those, the ones whose program is called `name`.
std::vector<pid_t> processes_called(const std::string& name, const std::string& text);

}  // namespace crosswalk::system_test
