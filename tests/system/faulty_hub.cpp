// An Ethernet hub that spoils the traffic, for tests on kernels without the netem module: every
// frame that comes in on one interface leaves on all others, lost, doubled, late or behind its
// successor with the given chances.
//
//   faulty_hub INTERFACE... [loss=0.05] [duplicate=0.02] [reorder=0.02] [jitter_ms=20] [seed=1]
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

using Clock = std::chrono::steady_clock;

struct Rates {
  double loss = 0, duplicate = 0, reorder = 0, jitter_ms = 0;
  unsigned seed = 1;
};

/// A socket for whole frames, each behind the header that carries unfinished checksums along.
int open_port(const char* name) {
  const int number = socket(AF_PACKET, SOCK_RAW, htons(ETH_P_ALL));
  const int on = 1;
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(ETH_P_ALL);
  address.sll_ifindex = static_cast<int>(if_nametoindex(name));
  if (number < 0 || address.sll_ifindex == 0 ||
      setsockopt(number, SOL_PACKET, PACKET_VNET_HDR, &on, sizeof on) != 0 ||
      setsockopt(number, SOL_PACKET, PACKET_IGNORE_OUTGOING, &on, sizeof on) != 0 ||
      bind(number, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    std::perror(name);
    std::exit(1);
  }
  return number;
}

class Hub {
 public:
  Hub(std::vector<int> ports, Rates rates)
      : ports_(std::move(ports)), rates_(rates), random_(rates.seed) {}

  [[noreturn]] void run() {
    std::vector<pollfd> waits;
    for (const int port : ports_) waits.push_back({port, POLLIN, 0});
    std::array<char, 1U << 17U> frame;
    while (true) {
      poll(waits.data(), waits.size(), held_.empty() ? 1000 : 1);
      for (const pollfd& wait : waits) {
        ssize_t n = 0;
        while ((n = recv(wait.fd, frame.data(), frame.size(), MSG_DONTWAIT)) > 0)
          take(wait.fd, {frame.data(), static_cast<std::size_t>(n)});
      }
      release();
    }
  }

 private:
  bool chance(double p) { return std::uniform_real_distribution<>(0, 1)(random_) < p; }

  void take(int from, const std::string& frame) {
    for (const int to : ports_) {
      if (to == from || chance(rates_.loss)) continue;
      const int copies = chance(rates_.duplicate) ? 2 : 1;
      for (int i = 0; i < copies; ++i) {
        double delay_ms = rates_.jitter_ms * std::uniform_real_distribution<>(0, 1)(random_);
        if (chance(rates_.reorder)) delay_ms += 1;  // behind what follows closely
        held_.emplace(Clock::now() + std::chrono::microseconds(static_cast<int>(1e3 * delay_ms)),
                      std::pair{to, frame});
      }
    }
  }

  void release() {
    while (!held_.empty() && held_.begin()->first <= Clock::now()) {
      const auto& [to, frame] = held_.begin()->second;
      // A full port loses the frame, as hubs do.
      if (send(to, frame.data(), frame.size(), MSG_DONTWAIT) < 0) ++lost_;
      held_.erase(held_.begin());
    }
  }

  std::vector<int> ports_;
  Rates rates_;
  std::mt19937 random_;
  std::multimap<Clock::time_point, std::pair<int, std::string>> held_;
  int lost_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Rates rates;
  std::vector<int> ports;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      ports.push_back(open_port(argv[i]));
      continue;
    }
    const std::string name = word.substr(0, equals);
    const double value = std::atof(word.c_str() + equals + 1);
    if (name == "loss") rates.loss = value;
    if (name == "duplicate") rates.duplicate = value;
    if (name == "reorder") rates.reorder = value;
    if (name == "jitter_ms") rates.jitter_ms = value;
    if (name == "seed") rates.seed = static_cast<unsigned>(value);
  }
  Hub(std::move(ports), rates).run();
}
