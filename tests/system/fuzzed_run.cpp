#include "tests/system/fuzzed_run.h"

#include <algorithm>

#include "crosswalk/msg/node_status.hpp"
#include "launcher/network.h"
#include "recorder/log_file.h"
#include "recorder/message_decode.h"

namespace crosswalk::system_test {

namespace fs = std::filesystem;

int port_of_run(const fs::path& run) {
  std::string mark;
  wait_for(kLong, [&] { return (mark = text_of(run / "running")).ends_with('\n'); });
  const std::size_t url = mark.find("udpm://");
  return url == std::string::npos ? 0 : port_of(mark.substr(url));
}

FuzzedRun::Outcome FuzzedRun::disturbed(const std::string& name, const std::string& undisturbed,
                                        const std::vector<std::string>& options, unsigned seed,
                                        int per_second) {
  Launched launched = run(name, options);
  DatagramFuzzer fuzzer(port_of_run(out(name)), seed, per_second);
  const auto status = launched.wait(4 * kLong);
  Outcome outcome{.is_success = status && status->is_success(),
                  .sent = fuzzer.sent(),
                  .overheard = fuzzer.overheard(),
                  .output = launched.output()};
  if (!outcome.is_success) return outcome;
  outcome.has_same_channels = channels_of(out(name)) == channels_of(out(undisturbed));
  recording::read_log(out(name) / "signals.lcmlog", [&](const recording::LogEvent& event) {
    const auto h = recording::peek_header(event.data);
    if (!h || h->kind != static_cast<int>(MessageKind::NodeStatus)) return;
    if (const auto m = recording::decoded<msg::node_status>(event.data))
      outcome.refused = std::max(outcome.refused, m->dropped);
  });
  return outcome;
}

}  // namespace crosswalk::system_test
