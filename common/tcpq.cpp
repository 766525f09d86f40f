#include "common/tcpq.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <regex>
#include <thread>

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/error.h"

namespace crosswalk {

namespace tcpq {

namespace {

void put(std::vector<std::byte>& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    out.push_back(static_cast<std::byte>(value >> static_cast<unsigned>(shift)));
}

[[noreturn]] void refuse(const std::string& what) {
  throw ProtocolError(ExitCode::NoTransport, "not the tcpq protocol: " + what);
}

}  // namespace

void Stream::append(std::span<const std::byte> bytes) {
  if (begin_ > 0 && begin_ == buffer_.size()) {
    buffer_.clear();
    begin_ = 0;
  }
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

std::uint32_t Stream::number(std::size_t at) const {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8U | std::to_integer<std::uint32_t>(buffer_[begin_ + at + i]);
  return value;
}

void Stream::drop(std::size_t bytes) {
  begin_ += bytes;
  // Moved to the front now and then, not for every record.
  if (begin_ > (1U << 16U)) {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
}

bool Stream::take_greeting(std::uint32_t& magic, std::uint32_t& version) {
  if (!has(8)) return false;
  magic = number(0);
  version = number(4);
  drop(8);
  return true;
}

bool Stream::take(Record& record) {
  if (!has(8)) return false;
  const std::uint32_t kind = number(0), channel_bytes = number(4);
  if (kind < 1 || kind > 3) refuse(fmt::format("record kind {}", kind));
  if (channel_bytes > kMaxChannelBytes) refuse(fmt::format("channel of {} B", channel_bytes));
  std::size_t size = 8 + channel_bytes;
  std::uint32_t data_bytes = 0;
  if (kind == static_cast<std::uint32_t>(RecordKind::Publish)) {
    if (!has(size + 4)) return false;
    data_bytes = number(size);
    if (data_bytes > kMaxDataBytes) refuse(fmt::format("message of {} B", data_bytes));
    size += 4 + data_bytes;
  }
  if (!has(size)) return false;
  record.kind = static_cast<RecordKind>(kind);
  const std::byte* begin = buffer_.data() + begin_;
  record.channel.assign(reinterpret_cast<const char*>(begin + 8), channel_bytes);
  record.data.assign(begin + size - data_bytes, begin + size);
  drop(size);
  return true;
}

std::vector<std::byte> greeting(std::uint32_t magic) {
  std::vector<std::byte> out;
  put(out, magic);
  put(out, kVersion);
  return out;
}

std::vector<std::byte> encode(RecordKind kind, const std::string& channel,
                              std::span<const std::byte> data) {
  std::vector<std::byte> out;
  out.reserve(12 + channel.size() + data.size());
  put(out, static_cast<std::uint32_t>(kind));
  put(out, static_cast<std::uint32_t>(channel.size()));
  for (const char c : channel) out.push_back(static_cast<std::byte>(c));
  if (kind == RecordKind::Publish) {
    put(out, static_cast<std::uint32_t>(data.size()));
    out.insert(out.end(), data.begin(), data.end());
  }
  return out;
}

Address address_from(const std::string& text) {
  constexpr std::string_view kScheme = "tcpq://";
  std::string rest = text.starts_with(kScheme) ? text.substr(kScheme.size()) : text;
  rest = rest.substr(0, rest.find('?'));
  Address address;
  const std::size_t colon = rest.rfind(':');
  address.host = rest.substr(0, colon);
  if (colon != std::string::npos) {
    const char* begin = rest.data() + colon + 1;
    const char* end = rest.data() + rest.size();
    const auto [stop, error] = std::from_chars(begin, end, address.port);
    if (error != std::errc() || stop != end || address.port < 0 || address.port > 65535)
      address.host.clear();
  }
  if (address.host.empty())
    throw UserError(Problem{{}, "address of the broker", "host:port", text, {}});
  return address;
}

void send_without_delay(int socket) {
  const int on = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

}  // namespace tcpq

namespace {

using Clock = std::chrono::steady_clock;

std::int64_t microseconds_since_1970() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

int connected_socket(const tcpq::Address& address) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found) != 0)
    return -1;
  int number = -1;
  for (const addrinfo* a = found; a != nullptr && number < 0; a = a->ai_next) {
    number = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (number >= 0 && connect(number, a->ai_addr, a->ai_addrlen) != 0) {
      close(number);
      number = -1;
    }
  }
  freeaddrinfo(found);
  return number;
}

class TcpqTransport : public Transport {
 public:
  explicit TcpqTransport(tcpq::Address address) : address_(std::move(address)) {}
  ~TcpqTransport() override { disconnect(); }
  TcpqTransport(const TcpqTransport&) = delete;
  TcpqTransport& operator=(const TcpqTransport&) = delete;

  bool try_to_connect() {
    const std::scoped_lock lock(mutex_);
    if (socket_ >= 0) return true;
    if (Clock::now() < next_try_) return false;
    next_try_ = Clock::now() + std::chrono::milliseconds(200);
    socket_ = connected_socket(address_);
    if (socket_ < 0) return false;
    tcpq::send_without_delay(socket_);
    stream_ = {};
    is_greeted_ = false;
    send(tcpq::greeting(tcpq::kClientMagic));
    for (const Subscriber& subscriber : subscribers_)
      send(tcpq::encode(tcpq::RecordKind::Subscribe, subscriber.pattern));
    return socket_ >= 0;
  }

  bool subscribe(const std::string& pattern, MessageHandler handler) override {
    try_to_connect();
    const std::scoped_lock lock(mutex_);
    subscribers_.push_back({pattern, std::regex(pattern), std::move(handler)});
    matches_.clear();
    send(tcpq::encode(tcpq::RecordKind::Subscribe, pattern));
    return true;
  }

  void publish(const std::string& channel, std::span<const std::byte> data) override {
    const std::scoped_lock lock(mutex_);
    send(tcpq::encode(tcpq::RecordKind::Publish, channel, data));
  }

  bool handle(int timeout_ms) override {
    const auto deadline = Clock::now() + std::chrono::milliseconds(timeout_ms);
    while (true) {
      if (tcpq::Record record; next_record(record)) {
        dispatch(record);
        return true;
      }
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
      const int wait_ms = std::max(0, static_cast<int>(left.count()));
      if (!try_to_connect()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(std::min(wait_ms, 50)));
      } else {
        receive(wait_ms);
      }
      if (wait_ms == 0) {
        tcpq::Record record;
        const bool has_one = next_record(record);
        if (has_one) dispatch(record);
        return has_one;
      }
    }
  }

 private:
  struct Subscriber {
    std::string pattern;
    std::regex expression;
    MessageHandler handler;
  };

  void disconnect() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
  }

  // The whole of it, or the connection is given up; receive() then closes it.
  void send(const std::vector<std::byte>& bytes) {
    std::size_t sent = 0;
    while (socket_ >= 0 && sent < bytes.size()) {
      const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n > 0)
        sent += static_cast<std::size_t>(n);
      else if (errno != EINTR) {
        shutdown(socket_, SHUT_RDWR);
        return;
      }
    }
  }

  void receive(int timeout_ms) {
    pollfd wait{socket_, POLLIN, 0};
    if (poll(&wait, 1, timeout_ms) <= 0) return;
    std::array<std::byte, 1U << 16U> buffer;
    const ssize_t n = recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (n > 0) {
      stream_.append({buffer.data(), static_cast<std::size_t>(n)});
    } else if (n == 0 || (errno != EAGAIN && errno != EINTR)) {
      const std::scoped_lock lock(mutex_);
      disconnect();
    }
  }

  bool next_record(tcpq::Record& record) {
    if (!is_greeted_) {
      std::uint32_t magic = 0, version = 0;
      if (!stream_.take_greeting(magic, version)) return false;
      if (magic != tcpq::kServerMagic)
        throw ProtocolError(ExitCode::NoTransport, fmt::format("{}:{} is no broker of messages",
                                                               address_.host, address_.port));
      is_greeted_ = true;
    }
    return stream_.take(record);
  }

  void dispatch(const tcpq::Record& record) {
    auto found = matches_.find(record.channel);
    if (found == matches_.end()) {
      std::vector<Subscriber*> takers;
      for (Subscriber& subscriber : subscribers_)
        if (std::regex_match(record.channel, subscriber.expression)) takers.push_back(&subscriber);
      found = matches_.emplace(record.channel, std::move(takers)).first;
    }
    const std::int64_t now = microseconds_since_1970();
    for (Subscriber* taker : found->second) taker->handler(record.channel, record.data, now);
  }

  tcpq::Address address_;
  std::mutex mutex_;  // sending; only the thread that handles opens and closes the socket
  int socket_ = -1;
  Clock::time_point next_try_{};
  bool is_greeted_ = false;
  tcpq::Stream stream_;
  std::deque<Subscriber> subscribers_;  // stable addresses
  std::map<std::string, std::vector<Subscriber*>> matches_;
};

}  // namespace

std::shared_ptr<Transport> tcpq_transport(const std::string& url, double patience_s) {
  const tcpq::Address address = tcpq::address_from(url);
  auto transport = std::make_shared<TcpqTransport>(address);
  const auto deadline = Clock::now() + std::chrono::duration<double>(patience_s);
  while (!transport->try_to_connect()) {
    if (Clock::now() > deadline)
      throw ProtocolError(
          ExitCode::NoTransport,
          fmt::format("no broker answers at {}:{}; start it there with `crosswalk broker --listen "
                      "{}:{}`",
                      address.host, address.port, address.host, address.port));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return transport;
}

}  // namespace crosswalk
