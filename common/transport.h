// What carries the messages of a bus: LCM, or our own client of a tcpq broker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace crosswalk {

/// Channel, payload, arrival in us since 1970.
using MessageHandler = std::function<void(
    const std::string& channel, std::span<const std::byte> data, std::int64_t received_us)>;

class Transport {
 public:
  virtual ~Transport() = default;
  /// Channels that the regular expression matches whole. False when the transport hears nothing.
  virtual bool subscribe(const std::string& pattern, MessageHandler handler) = 0;
  /// From any thread. A message that cannot leave is lost, as on the wire.
  virtual void publish(const std::string& channel, std::span<const std::byte> data) = 0;
  /// Handles at least one message, or returns false when the time is over. What handlers throw
  /// comes out here.
  virtual bool handle(int timeout_ms) = 0;
};

}  // namespace crosswalk
