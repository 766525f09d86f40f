#include "common/bus.h"

#include <cstdlib>
#include <deque>
#include <mutex>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "common/error.h"
#include "common/lcm_transport.h"
#include "common/tcpq.h"

namespace crosswalk {

std::shared_ptr<Transport> open_transport(const std::string& url) {
  return url.starts_with("tcpq://") ? tcpq_transport(url) : lcm_transport(url);
}

std::shared_ptr<Transport> memory_transport() { return lcm_transport("memq://"); }

// Holds back, doubles or loses outgoing messages with seeded chances.
struct Bus::Faults {
  BusFaults rates;
  std::mt19937_64 random;
  std::mutex mutex;
  struct Held {
    Clock::time_point due;
    std::string channel;
    std::vector<std::byte> bytes;
  };
  std::deque<Held> held;

  bool chance(double p) { return std::uniform_real_distribution<>(0, 1)(random) < p; }

  void send(Transport& transport, const std::string& channel, std::span<const std::byte> bytes) {
    const std::scoped_lock lock(mutex);
    const int copies = chance(rates.loss) ? 0 : chance(rates.duplicate) ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      double delay_ms = rates.delay_ms * std::uniform_real_distribution<>(0, 1)(random);
      if (!chance(0.1)) delay_ms = 0;  // jitter comes in bursts, not on every packet
      if (chance(rates.reorder)) delay_ms += 0.2;
      const auto delay = std::chrono::microseconds(static_cast<std::int64_t>(1e3 * delay_ms));
      held.push_back({Clock::now() + delay, channel, {bytes.begin(), bytes.end()}});
    }
    release(transport);
  }

  void release(Transport& transport) {
    for (auto it = held.begin(); it != held.end();) {
      if (it->due > Clock::now()) {
        ++it;
        continue;
      }
      transport.publish(it->channel, it->bytes);
      it = held.erase(it);
    }
  }
};

BusFaults BusFaults::from_text(std::string_view text) {
  BusFaults faults;
  const std::string all(text);
  std::size_t at = 0;
  while ((at = all.find_first_not_of(' ', at)) != std::string::npos) {
    const std::size_t end = std::min(all.find(' ', at), all.size());
    const std::string word = all.substr(at, end - at);
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const std::string number = equals == std::string::npos ? "" : word.substr(equals + 1);
    char* rest = nullptr;
    const double value = std::strtod(number.c_str(), &rest);
    const bool is_number = !number.empty() && *rest == '\0' && value >= 0;
    if (name == "loss" && is_number && value <= 1)
      faults.loss = value;
    else if (name == "duplicate" && is_number && value <= 1)
      faults.duplicate = value;
    else if (name == "reorder" && is_number && value <= 1)
      faults.reorder = value;
    else if (name == "delay_ms" && is_number)
      faults.delay_ms = value;
    else if (name == "seed" && is_number)
      faults.seed = static_cast<std::uint64_t>(value);
    else {
      throw UserError({{"CROSSWALK_BUS_FAULTS"},
                       word,
                       "loss, duplicate, reorder (0..1), delay_ms or seed with a number",
                       "",
                       ""});
    }
    at = end;
  }
  return faults;
}

BusFaults BusFaults::from_environment() {
  const char* text = std::getenv("CROSSWALK_BUS_FAULTS");
  return text == nullptr ? BusFaults{} : from_text(text);
}

Bus::Bus(std::shared_ptr<Transport> transport, std::string run_id, Role role, BusFaults faults)
    : transport_(std::move(transport)),
      run_id_(std::move(run_id)),
      run_(run_digest(run_id_)),
      role_(role) {
  std::random_device device;
  instance_ = static_cast<int>(device() & 0x7fffffffU) | 1;
  if (faults.any()) {
    faults_ = std::make_unique<Faults>();
    faults_->rates = faults;
    faults_->random.seed(faults.seed + static_cast<std::uint64_t>(role));
  }
}

Bus::~Bus() = default;

msg::header Bus::header(MessageKind kind, std::int64_t seq, int attempt) const {
  msg::header h{};
  h.protocol = kProtocolVersion;
  h.kind = static_cast<std::int16_t>(kind);
  h.sender = static_cast<std::int16_t>(role_);
  h.attempt = static_cast<std::int16_t>(attempt);
  h.run_id = run_;
  h.instance = instance_;
  h.seq = seq;
  return h;
}

void Bus::send(MessageKind kind, std::span<const std::byte> bytes) {
  CW_ASSERT(bytes.size() <= kMaxMessageBytes + kSealBytes);
  const std::string channel = channel_name(run_, kind, role_);
  if (faults_) {
    faults_->send(*transport_, channel, bytes);
  } else {
    transport_->publish(channel, bytes);
  }
}

void Bus::subscribe_sealed(RawHandler handler) {
  subscribe_to(
      channel_pattern(run_),
      [this, handler = std::move(handler)](
          const std::string& channel, std::span<const std::byte> data, std::int64_t received_us) {
        if (unsealed(run_, data)) {
          handler(channel, data, received_us);
        } else {
          refuse();
        }
      });
}

void Bus::subscribe_to(const std::string& pattern, RawHandler handler) {
  if (!transport_->subscribe(pattern, std::move(handler))) {
    throw ProtocolError(ExitCode::NoTransport,
                        "LCM hears none of its own messages: multicast does not loop back on this "
                        "machine. Give 224.0.0.0/4 a route (`ip route add 224.0.0.0/4 dev lo`), or "
                        "start with --isolate");
  }
}

bool Bus::wait_until(Clock::time_point deadline) {
  do {
    auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (faults_) {
      const std::scoped_lock lock(faults_->mutex);
      faults_->release(*transport_);
      left = std::min<std::int64_t>(left, 1);
    }
    if (transport_->handle(static_cast<int>(std::clamp<std::int64_t>(left, 0, 1000)))) return true;
  } while (Clock::now() < deadline);
  return false;
}

bool Bus::wait_until(Clock::time_point deadline, const std::function<bool()>& done) {
  while (!done()) {
    if (!wait_until(deadline)) return done();
  }
  return true;
}

void Bus::handle_pending() {
  while (transport_->handle(0)) {
  }
}

namespace {

// Types with strings. The generated decoders trust lengths on the wire; this table lets the gate
// walk over them first: bytes before the first variable part, where the count of array strings
// stands (or -1), and how many further strings follow.
struct VariableLayout {
  MessageKind kind;
  int prefix;
  int count_at;
  int further_strings;
};
constexpr int kHash = 8, kHeader = 28;
constexpr VariableLayout kVariableLayouts[] = {
    {MessageKind::NodeHello, kHash + kHeader + 28, kHash + kHeader + 20, 2},
    {MessageKind::RunManifest, kHash + kHeader + 48, kHash + kHeader + 40, 2},
    {MessageKind::RunControl, kHash + kHeader + 20, -1, 1},
    {MessageKind::RunEvent, kHash + kHeader + 12, -1, 1},
    {MessageKind::NodeDescription, kHash + kHeader + 8, -1, 1},
};

std::int64_t big_endian(std::span<const std::byte> data, std::size_t at, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) {
    value = value << 8 | std::to_integer<std::uint64_t>(data[at + static_cast<std::size_t>(i)]);
  }
  return bytes == 4 ? static_cast<std::int32_t>(static_cast<std::uint32_t>(value))
                    : static_cast<std::int64_t>(value);
}

bool strings_are_sound(const VariableLayout& layout, std::span<const std::byte> data) {
  auto at = static_cast<std::size_t>(layout.prefix);
  if (data.size() < at) return false;
  std::int64_t strings = layout.further_strings;
  if (layout.count_at >= 0) {
    const std::int64_t n = big_endian(data, static_cast<std::size_t>(layout.count_at), 4);
    if (n < 0 || n > kMaxInterfaceBodies) return false;
    strings += n;
  }
  for (; strings > 0; --strings) {
    if (data.size() - at < 4) return false;
    const std::int64_t length = big_endian(data, at, 4);
    at += 4;
    if (length < 1 || static_cast<std::size_t>(length) > data.size() - at) return false;
    at += static_cast<std::size_t>(length);
    if (data[at - 1] != std::byte{0}) return false;
  }
  return at == data.size();
}

const VariableLayout* variable_layout(MessageKind kind) {
  for (const VariableLayout& layout : kVariableLayouts) {
    if (layout.kind == kind) return &layout;
  }
  return nullptr;
}

}  // namespace

bool Bus::is_fixed_size(MessageKind kind) { return variable_layout(kind) == nullptr; }

bool Bus::refuse() {
  ++dropped_;
  return false;
}

bool Bus::passes_size(MessageKind kind, std::span<const std::byte> data, std::int64_t hash,
                      int exact_size) {
  if (data.size() < static_cast<std::size_t>(kHash + kHeader)) return refuse();
  if (data.size() > static_cast<std::size_t>(kMaxMessageBytes)) return refuse();
  if (big_endian(data, 0, 8) != hash) return refuse();
  if (exact_size >= 0) return static_cast<int>(data.size()) == exact_size || refuse();
  return strings_are_sound(*variable_layout(kind), data) || refuse();
}

bool Bus::passes_header(const msg::header& h, MessageKind kind, std::optional<Role> sender) {
  if (h.instance == instance_) return false;  // our own, looped back
  if (h.run_id != run_ || h.kind != static_cast<int>(kind)) return refuse();
  if (sender && h.sender != static_cast<int>(*sender)) return refuse();
  // A hello of another version goes through, so that the coupler can refuse it naming both
  // versions.
  if (h.protocol != kProtocolVersion && kind != MessageKind::NodeHello) return refuse();
  return true;
}

}  // namespace crosswalk
