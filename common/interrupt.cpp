#include "common/interrupt.h"

#include <atomic>
#include <csignal>

namespace crosswalk {

namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // else not allowed in a signal handler

extern "C" void on_interrupt(int signal_number) {
  if (flag.exchange(true)) {
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
  }
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() { return flag.load(); }

const std::atomic<bool>& interrupt_flag() { return flag; }

}  // namespace crosswalk
