#include "tests/system/launched.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "launcher/network.h"

namespace crosswalk::system_test {

namespace fs = std::filesystem;

namespace {

/// The test program moves into a network of its own, in which multicast stays: the launcher then
/// uses it as it is, and processes started by hand find each other and the runs. Where that is not
/// allowed, runs share the machine's multicast.
class Network : public testing::Environment {
 public:
  void SetUp() override {
    const Multicast here = probe_multicast();
    const std::string obstacle =
        here.defect.empty() && here.interface == "lo" ? "" : enter_private_network();
    if (!here.defect.empty()) {
      ASSERT_EQ(obstacle, "");
    }
  }
};
const testing::Environment* const kNetwork = testing::AddGlobalTestEnvironment(new Network);

std::vector<std::string> command_line(pid_t pid) {
  std::vector<std::string> words;
  std::ifstream in("/proc/" + std::to_string(pid) + "/cmdline");
  for (std::string word; std::getline(in, word, '\0');) words.push_back(word);
  return words;
}

std::vector<pid_t> all_processes() {
  std::vector<pid_t> pids;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    pid_t pid = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (error == std::errc() && end == name.data() + name.size()) pids.push_back(pid);
  }
  return pids;
}

}  // namespace

TemporaryFolder::TemporaryFolder()
    : path_(fs::path(testing::TempDir()) / ("crosswalk_system_" + std::to_string(getpid()))) {
  fs::remove_all(path_);
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  if (testing::Test::HasFailure()) return;  // leave the logs to be looked at
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

bool wait_for(double seconds, const std::function<bool()>& condition) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

Launched::Launched(const fs::path& program, std::vector<std::string> arguments,
                   const fs::path& output)
    : output_(output),
      process_({program.filename().string(), program, std::move(arguments), output, false}) {}

std::optional<ExitStatus> Launched::wait(double seconds) {
  if (!wait_for(seconds, [this] { return process_.poll().has_value(); })) return std::nullopt;
  return *process_.poll();
}

bool Launched::has_said(const std::string& text) const {
  return output().find(text) != std::string::npos;
}

pid_t Launched::child(const std::string& name) const {
  for (const pid_t pid : all_processes()) {
    const std::vector<std::string> words = command_line(pid);
    if (words.empty() || fs::path(words.front()).filename() != name) continue;
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number, command, state;
    pid_t parent = 0;
    if (stat >> number >> command >> state >> parent && parent == process_.pid()) return pid;
  }
  return 0;
}

std::vector<pid_t> processes_with(const std::string& text) {
  std::vector<pid_t> found;
  for (const pid_t pid : all_processes()) {
    const std::vector<std::string> words = command_line(pid);
    if (pid != getpid() && std::any_of(words.begin(), words.end(), [&](const std::string& word) {
          return word.find(text) != std::string::npos;
        }))
      found.push_back(pid);
  }
  return found;
}

std::vector<pid_t> processes_called(const std::string& name, const std::string& text) {
  std::vector<pid_t> found = processes_with(text);
  std::erase_if(found, [&](pid_t pid) {
    const std::vector<std::string> words = command_line(pid);
    return words.empty() || fs::path(words.front()).filename() != name;
  });
  return found;
}

}  // namespace crosswalk::system_test
