#include "common/lcm_transport.h"

#include <deque>
#include <exception>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>

#include "common/datagram_filter.h"
#include "common/error.h"
#include "common/log.h"

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

/// With a time to live of 0, LCM's default as well, multicast does not leave the machine.
Origin origin_of(const std::string& url) {
  const std::size_t ttl = url.find("ttl=");
  const bool is_zero =
      ttl == std::string::npos || url.substr(ttl, url.find('&', ttl) - ttl) == "ttl=0";
  return is_zero ? Origin::ThisMachine : Origin::Anywhere;
}

class LcmTransport : public Transport {
 public:
  /// `filter`: where messages may come from; nothing: no filter at all.
  LcmTransport(const std::string& url, std::optional<Origin> filter) : lcm_(url), filter_(filter) {}
  bool good() { return lcm_.good(); }

  bool subscribe(const std::string& pattern, MessageHandler handler) override {
    subscribers_.push_back(Subscriber{std::move(handler), &failure_});
    if (filter_ && patterns_.empty()) {
      // LCM opens its receiving socket with the first subscription, and tries it out.
      FilterAtBind filter({"LCM_SELF_TEST", pattern}, *filter_);
      if (!add(pattern)) return false;
      receiver_ = filter.socket();
    } else if (!add(pattern)) {
      return false;
    }
    if (filter_ && (receiver_ < 0 || !let_through_only(receiver_, patterns_, *filter_)))
      log_warning("no filter in front of LCM's socket: forged fragments are not kept out");
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
  bool add(const std::string& pattern) {
    lcm::Subscription* subscription =
        lcm_.subscribe(pattern, &Subscriber::on_message, &subscribers_.back());
    if (subscription == nullptr) return false;
    subscription->setQueueCapacity(0);  // LCM drops silently beyond 30 otherwise
    patterns_.push_back(pattern);
    return true;
  }

  lcm::LCM lcm_;
  std::optional<Origin> filter_;
  int receiver_ = -1;
  std::vector<std::string> patterns_;
  std::deque<Subscriber> subscribers_;  // stable addresses
  std::exception_ptr failure_;
};

std::shared_ptr<Transport> started(const std::string& url, std::optional<Origin> filter) {
  auto transport = std::make_shared<LcmTransport>(url, filter);
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

}  // namespace

std::shared_ptr<Transport> lcm_transport(const std::string& url) {
  return started(url, url.starts_with("udpm://") ? std::optional(origin_of(url)) : std::nullopt);
}

std::shared_ptr<Transport> plain_lcm_transport(const std::string& url) {
  return started(url, std::nullopt);
}

}  // namespace crosswalk
