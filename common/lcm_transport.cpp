#include "common/lcm_transport.h"

#include <deque>
#include <exception>
#include <utility>

#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>

#include "common/error.h"

namespace crosswalk {

namespace {

// LCM takes a member function; this is the object it belongs to. Nothing is thrown through its C
// code.
struct Subscriber {
  MessageHandler handler;
  std::exception_ptr* failure = nullptr;
  void on_message(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    if (*failure) return;
    try {
      const auto* data = static_cast<const std::byte*>(buffer->data);
      handler(channel, {data, buffer->data_size}, buffer->recv_utime);
    } catch (...) {
      *failure = std::current_exception();
    }
  }
};

class LcmTransport : public Transport {
 public:
  explicit LcmTransport(const std::string& url) : lcm_(url) {}
  bool good() { return lcm_.good(); }

  bool subscribe(const std::string& pattern, MessageHandler handler) override {
    subscribers_.push_back(Subscriber{std::move(handler), &failure_});
    lcm::Subscription* subscription =
        lcm_.subscribe(pattern, &Subscriber::on_message, &subscribers_.back());
    if (subscription == nullptr) return false;
    subscription->setQueueCapacity(0);  // LCM drops silently beyond 30 otherwise
    return true;
  }

  void publish(const std::string& channel, std::span<const std::byte> bytes) override {
    lcm_.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
  }

  bool handle(int timeout_ms) override {
    const bool handled = lcm_.handleTimeout(timeout_ms) > 0;
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return handled;
  }

 private:
  lcm::LCM lcm_;
  std::deque<Subscriber> subscribers_;  // stable addresses
  std::exception_ptr failure_;
};

}  // namespace

std::shared_ptr<Transport> lcm_transport(const std::string& url) {
  auto transport = std::make_shared<LcmTransport>(url);
  if (!transport->good()) {
    throw ProtocolError(
        ExitCode::NoTransport,
        fmt::format(
            "LCM cannot start on {}: no network route for multicast (224.0.0.0/4). Add one with "
            "`ip link set lo up && ip route add 224.0.0.0/4 dev lo`, or start with --isolate",
            url));
  }
  return transport;
}

}  // namespace crosswalk
