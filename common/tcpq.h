// The tcpq protocol of LCM: a TCP stream to a broker that hands every message to the clients that
// subscribed its channel. For networks without multicast.
//
// Both sides open with a magic number and a version; then the client sends records: kind, channel
// length, channel and, for a publication, data length and data. The broker sends publications in
// the same form. All numbers are 32 bits, big-endian. Subscriptions are regular expressions for the
// whole channel name.
//
// LCM's own client sends every record in five pieces without TCP_NODELAY, which costs two delayed
// acknowledgements, 88 ms, per round trip; and two of its threads may not publish at once. So the
// client is ours as well: one send per record, TCP_NODELAY, locked.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/transport.h"

namespace crosswalk {

namespace tcpq {

inline constexpr std::uint32_t kServerMagic = 0x287617fa;
inline constexpr std::uint32_t kClientMagic = 0x287617fb;
inline constexpr std::uint32_t kVersion = 0x0100;
inline constexpr int kDefaultPort = 7700;
inline constexpr std::uint32_t kMaxChannelBytes = 255;
inline constexpr std::uint32_t kMaxDataBytes = 16U << 20U;
enum class RecordKind : std::uint32_t { Publish = 1, Subscribe = 2, Unsubscribe = 3 };

struct Record {
  RecordKind kind{};
  std::string channel;
  std::vector<std::byte> data;
};

/// Bytes of a stream on their way to becoming records.
class Stream {
 public:
  void append(std::span<const std::byte> bytes);
  /// The two numbers a peer opens with; false when they have not come yet.
  bool take_greeting(std::uint32_t& magic, std::uint32_t& version);
  /// The next whole record; false when there is none yet. Throws ProtocolError for bytes that are
  /// none.
  bool take(Record& record);

 private:
  bool has(std::size_t bytes) const { return buffer_.size() - begin_ >= bytes; }
  std::uint32_t number(std::size_t at) const;
  void drop(std::size_t bytes);

  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0;
};

std::vector<std::byte> greeting(std::uint32_t magic);
std::vector<std::byte> encode(RecordKind kind, const std::string& channel,
                              std::span<const std::byte> data = {});

struct Address {
  std::string host;
  int port = kDefaultPort;
};
/// "host", "host:port" or "tcpq://host:port"; throws UserError.
Address address_from(const std::string& text);
/// Small messages leave at once.
void send_without_delay(int socket);

}  // namespace tcpq

/// Connects to the broker, which may come up to `patience_s` later; throws
/// ProtocolError{NoTransport}. A connection lost later is tried again with every message; the
/// subscriptions are kept.
std::shared_ptr<Transport> tcpq_transport(const std::string& url, double patience_s = 10);

}  // namespace crosswalk
