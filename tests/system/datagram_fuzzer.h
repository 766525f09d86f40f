// Disturbs the UDP port of a run: it listens to what the processes say and sends it back mutated,
// torn, in false fragments, on foreign channels and, much later, unchanged.
#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace crosswalk::system_test {

class DatagramFuzzer {
 public:
  /// Starts at once, in a thread of its own, with about `per_second` datagrams a second.
  DatagramFuzzer(int port, unsigned seed, int per_second);
  ~DatagramFuzzer();
  DatagramFuzzer(const DatagramFuzzer&) = delete;
  DatagramFuzzer& operator=(const DatagramFuzzer&) = delete;

  std::int64_t sent() const { return sent_; }
  std::int64_t overheard() const { return overheard_; }

 private:
  void run();
  void listen();
  std::string next();
  std::string any_heard();
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  std::string noise(std::size_t n);

  int port_;
  std::mt19937 random_;
  int per_second_;
  int receiver_ = -1, sender_ = -1;
  std::vector<std::string> heard_;  ///< a random choice of everything until now
  std::atomic<std::int64_t> sent_{0}, overheard_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace crosswalk::system_test
