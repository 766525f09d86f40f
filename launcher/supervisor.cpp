#include "launcher/supervisor.h"

#include <algorithm>
#include <array>
#include <fstream>

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include "common/interrupt.h"

namespace crosswalk {

namespace {

constexpr int kPollMs = 50;
// Time for the coupler's orderly abort, then for everybody's own leaving; and, after a good end,
// for the recorder to write its results.
constexpr std::chrono::seconds kCouplerGrace{2};
constexpr std::chrono::seconds kGrace{4};  // a killed node ends the run within 5 s
constexpr std::chrono::seconds kRecorderGrace{300};
constexpr std::size_t kMaxLastLines = 8;
// How a node's last message begins when the coupler ended the run (common/node_session.cpp).
constexpr std::string_view kToldToLeave = "the coupler ended the run";

/// "[   23.418] [fe_node] error text" -> "text"; other lines as they are.
std::string without_prefix(const std::string& line) {
  if (!line.starts_with('[')) return line;
  const std::size_t second = line.find("] [");
  const std::size_t level = second == std::string::npos ? second : line.find("] ", second + 3);
  const std::size_t text = level == std::string::npos ? level : line.find(' ', level + 2);
  return text == std::string::npos ? line : line.substr(text + 1);
}

}  // namespace

std::string last_words(const std::filesystem::path& log) {
  std::ifstream file(log);
  std::vector<std::string> error, last;  // the last error message and the last message
  bool is_in_error = false;
  for (std::string line; std::getline(file, line);) {
    if (line.empty()) continue;
    const bool is_new_message = line.starts_with('[');
    if (is_new_message) {
      last.clear();
      is_in_error = line.find("] error ") != std::string::npos;
      if (is_in_error) error.clear();
    }
    std::vector<std::string>& message = is_in_error ? error : last;
    if (message.size() < kMaxLastLines) message.push_back(without_prefix(line));
  }
  return fmt::format("{}", fmt::join(error.empty() ? last : error, "\n"));
}

Supervisor::Supervisor(const std::vector<ProcessSpec>& specs, ProgressDisplay& display)
    : display_(display) {
  for (const ProcessSpec& spec : specs) processes_.emplace_back(spec);
}

Verdict Supervisor::run() {
  while (is_anyone_running()) {
    read_coupler(kPollMs);
    look_at_processes();
    if (is_interrupted() && !was_interrupted_) {
      was_interrupted_ = true;
      display_.say("stopping; a second Ctrl-C does not wait");
      if (!ending_since_) ending_since_ = Clock::now();
    }
    press_for_the_end();
  }
  read_coupler(0);
  display_.finish();
  return verdict();
}

void Supervisor::read_coupler(int timeout_ms) {
  const int fd = processes_.front().output();
  pollfd wait{fd, POLLIN, 0};
  const int ready = ::poll(&wait, 1, timeout_ms);
  if (ready <= 0) return;
  std::array<char, 4096> buffer;
  ssize_t count = 0;
  while ((count = ::read(fd, buffer.data(), buffer.size())) > 0) {
    unfinished_line_.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t end = 0;
    while ((end = unfinished_line_.find('\n')) != std::string::npos) {
      take_line(unfinished_line_.substr(0, end));
      unfinished_line_.erase(0, end + 1);
    }
  }
  // A closed pipe is always ready: keep the pace while the others leave.
  if (count == 0 && timeout_ms > 0) ::poll(nullptr, 0, timeout_ms);
}

void Supervisor::take_line(const std::string& line) {
  if (const auto progress = parse_progress(line)) {
    display_.show(*progress);
  } else if (const auto event = parse_event(line)) {
    if (event->level == "error") coupler_error_ = event->text;
    display_.say(event->level == "info" ? event->text
                                        : fmt::format("{}: {}", event->level, event->text));
  }
}

void Supervisor::look_at_processes() {
  // The solver nodes before the coupler: when both have gone since the last look, theirs was first.
  for (std::size_t i = processes_.size(); i-- > 0;) {
    Process& process = processes_[i];
    if (!process.is_running() || !process.poll()) continue;
    const ExitStatus& status = *process.poll();
    const bool is_coupler = i == 0;
    // A node that left because the coupler told it to is no cause; the coupler's own end follows.
    const bool is_follower = !is_coupler && processes_.front().is_running() &&
                             last_words(process.spec().log).starts_with(kToldToLeave);
    if (!status.is_success() && !failure_ && !was_interrupted_ && !is_follower) {
      failure_ = Failure{process.name(), status, {}};
      if (display_.last()) failure_->t_ms = display_.last()->t_ms;
    }
    if ((is_coupler || !status.is_success()) && !ending_since_) ending_since_ = Clock::now();
  }
}

void Supervisor::press_for_the_end() {
  if (!ending_since_) return;
  const auto elapsed = Clock::now() - *ending_since_;
  const bool is_good_end = !failure_ && !was_interrupted_;
  const auto grace = is_good_end ? kRecorderGrace : kGrace;
  const auto coupler_grace = is_good_end ? kRecorderGrace : kCouplerGrace;
  if (pressure_ == 0 && !is_good_end) {
    processes_.front().send(SIGTERM);
    pressure_ = 1;
  } else if (pressure_ <= 1 && elapsed > coupler_grace) {
    for (Process& process : processes_) process.send(SIGTERM);
    pressure_ = 2;
  } else if (pressure_ == 2 && elapsed > grace + (is_good_end ? kGrace : std::chrono::seconds(0))) {
    for (Process& process : processes_) process.send(SIGKILL);
    pressure_ = 3;
  } else if (pressure_ == 3 && elapsed > 2 * grace) {
    for (Process& process : processes_) process.abandon();
    pressure_ = 4;
  }
}

bool Supervisor::is_anyone_running() const {
  return std::any_of(processes_.begin(), processes_.end(),
                     [](const Process& process) { return process.is_running(); });
}

Verdict Supervisor::verdict() const {
  const std::string when =
      display_.last() ? fmt::format(" at {:.2f} ms", display_.last()->t_ms) : " before the start";
  if (was_interrupted_) return {ExitCode::Interrupted, "interrupted" + when};
  if (!failure_) return {};
  const auto& culprit =
      *std::find_if(processes_.begin(), processes_.end(),
                    [&](const Process& process) { return process.name() == failure_->name; });
  const ExitCode code = failure_->status.signal != 0 ? ExitCode::NodeFailed
                                                     : static_cast<ExitCode>(failure_->status.code);
  const std::string at =
      failure_->t_ms ? fmt::format(" at {:.2f} ms", *failure_->t_ms) : " before the start";
  // What a killed process logged last is no reason; the coupler may know one.
  std::string reason = failure_->status.signal != 0 ? "" : last_words(culprit.spec().log);
  if (failure_->name == "coupler" && !coupler_error_.empty()) reason = coupler_error_;
  return {code, fmt::format("{} failed{} ({}){}\nits log: {}", failure_->name, at,
                            failure_->status.text(), reason.empty() ? "" : ":\n" + reason,
                            culprit.spec().log.string())};
}

}  // namespace crosswalk
