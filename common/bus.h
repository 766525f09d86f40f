// One process's view of one run's traffic.
//
// The transport below, LCM, is a lossy datagram bus. The gate in front of every handler drops what
// is not ours (seal, size, type hash, protocol, kind, run, sender) and counts it; reliability is
// built above (participant, coupler, recorder). Handlers run inside wait(); what they throw is
// raised from wait(), never through LCM's C code. publish() may be called from any thread,
// everything else from one.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/messages.h"
#include "common/protocol.h"
#include "common/seal.h"
#include "common/transport.h"
#include "crosswalk/msg/header.hpp"

namespace crosswalk {

/// Processes own one transport; a test shares one in memory among all nodes. An LCM URL: udpm://,
/// memq:// or tcpq://. Throws ProtocolError{NoTransport} with the cure when it cannot start.
std::shared_ptr<Transport> open_transport(const std::string& url);
std::shared_ptr<Transport> memory_transport();

/// Injected faults, for tests. CROSSWALK_BUS_FAULTS="loss=0.05 duplicate=0.02 reorder=0.02
/// delay_ms=20 seed=7".
struct BusFaults {
  double loss = 0, duplicate = 0, reorder = 0;  ///< probabilities per message sent
  double delay_ms = 0;                          ///< largest random delay
  std::uint64_t seed = 1;
  bool any() const { return loss > 0 || duplicate > 0 || reorder > 0 || delay_ms > 0; }
  /// Throws UserError for an unknown name or a value out of range.
  static BusFaults from_text(std::string_view text);
  static BusFaults from_environment();
};

class Bus {
 public:
  using Clock = std::chrono::steady_clock;
  using RawHandler = MessageHandler;

  Bus(std::shared_ptr<Transport> transport, std::string run_id, Role role, BusFaults faults = {});
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  Role role() const { return role_; }
  const std::string& run_id() const { return run_id_; }
  std::int64_t run() const { return run_; }
  /// Random positive number of this process and bus.
  int instance() const { return instance_; }
  /// Messages the gate refused so far.
  int dropped() const { return dropped_; }

  /// Fills the header, seals and sends. Returns the bytes, for re-sending.
  template <class M>
  std::vector<std::byte> publish(M message, std::int64_t seq, int attempt = 1) {
    message.h = header(kKindOf<M>, seq, attempt);
    std::vector<std::byte> bytes;
    const auto size = static_cast<std::size_t>(message.getEncodedSize());
    bytes.reserve(size + kSealBytes);
    bytes.resize(size);
    message.encode(bytes.data(), 0, static_cast<int>(size));
    seal(run_, bytes);
    send(kKindOf<M>, bytes);
    return bytes;
  }
  /// Sends bytes that publish() returned once more.
  void send(MessageKind kind, std::span<const std::byte> bytes);

  /// Messages of type M from `sender`; this bus's own are never delivered.
  template <class M>
  void subscribe(Role sender, std::function<void(const M&)> handler) {
    subscribe_to(channel_name(run_, kKindOf<M>, sender),
                 [this, sender, handler = std::move(handler)](
                     const std::string&, std::span<const std::byte> data, std::int64_t) {
                   M message{};
                   if (decode(data, message, sender)) handler(message);
                 });
  }
  template <class M>
  void subscribe_any_sender(std::function<void(const M&)> handler) {
    subscribe_to(channel_pattern(run_, kKindOf<M>),
                 [this, handler = std::move(handler)](
                     const std::string&, std::span<const std::byte> data, std::int64_t) {
                   M message{};
                   if (decode(data, message, std::nullopt)) handler(message);
                 });
  }
  /// Every message of the run with a sound seal, whoever sent it, undecoded.
  void subscribe_sealed(RawHandler handler);

  /// The gate. False, and counted, for anything but a sound message of this type and run.
  template <class M>
  bool decode(std::span<const std::byte> sealed, M& message, std::optional<Role> sender) {
    const auto payload = unsealed(run_, sealed);
    if (!payload) return refuse();
    const std::span<const std::byte> data = *payload;
    const bool is_fixed = is_fixed_size(kKindOf<M>);
    if (!passes_size(kKindOf<M>, data, M::getHash(), is_fixed ? message.getEncodedSize() : -1))
      return false;
    if (message.decode(data.data(), 0, static_cast<int>(data.size())) < 0) return refuse();
    return passes_header(message.h, kKindOf<M>, sender);
  }

  /// Handles at least one message, or returns false at the deadline.
  bool wait_until(Clock::time_point deadline);
  /// Handles messages until `done()` or the deadline; returns done().
  bool wait_until(Clock::time_point deadline, const std::function<bool()>& done);
  /// Handles what has already arrived.
  void handle_pending();

 private:
  /// Channels that the regular expression matches.
  void subscribe_to(const std::string& pattern, RawHandler handler);
  msg::header header(MessageKind kind, std::int64_t seq, int attempt) const;
  static bool is_fixed_size(MessageKind kind);
  bool passes_size(MessageKind kind, std::span<const std::byte> data, std::int64_t hash,
                   int exact_size);
  bool passes_header(const msg::header& h, MessageKind kind, std::optional<Role> sender);
  bool refuse();

  struct Faults;
  std::shared_ptr<Transport> transport_;
  std::string run_id_;
  std::int64_t run_;
  Role role_;
  int instance_;
  int dropped_ = 0;
  std::unique_ptr<Faults> faults_;
};

}  // namespace crosswalk
