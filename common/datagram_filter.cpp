#include "common/datagram_filter.h"

#include <cstdint>
#include <utility>

#include <linux/filter.h>
#include <linux/if_packet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "common/protocol.h"

namespace crosswalk {

namespace {

constexpr std::uint32_t kWholeMessage = 0x4c433032;  // LCM's magic number; fragments have another
constexpr std::uint32_t kLoopbackIndex = 1;          // of the interface lo, in every namespace
constexpr int kMaxChannelBytes = 64;
// Offsets in the UDP packet: header with its length, magic number, sequence number, channel.
constexpr std::uint32_t kUdpLength = 4, kMagic = 8, kChannel = 16;
constexpr std::uint32_t kMaxUdpBytes = kChannel + kMaxChannelBytes + kMaxMessageBytes;

// Classic BPF: one accumulator, jumps forward, the value returned is the number of bytes kept.
class Program {
 public:
  void load(std::uint16_t size, std::uint32_t at) { add(BPF_LD | BPF_ABS | size, at); }
  void drop_unless_equal(std::uint32_t value) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0);
    drop();
  }
  void drop_if_above(std::uint32_t value) {
    add(BPF_JMP | BPF_JGT | BPF_K, value, 0, 1);
    drop();
  }
  void skip_if_equal(std::uint32_t value, std::uint8_t instructions) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, instructions, 0);
  }
  void skip_unless_equal(std::uint32_t value, std::uint8_t instructions) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, instructions);
  }
  void accept() { add(BPF_RET | BPF_K, 0xffffffff); }
  void drop() { add(BPF_RET | BPF_K, 0); }

  bool attach(int socket) {
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    return setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
  }

 private:
  void add(int code, std::uint32_t k, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    code_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, k});
  }
  std::vector<sock_filter> code_;
};

/// How every channel that the pattern matches begins; with the closing zero when it is a name.
std::string beginning_of(const std::string& pattern) {
  constexpr const char* kLiterals =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
  const std::size_t end = pattern.find_first_not_of(kLiterals);
  if (end == std::string::npos) return pattern + '\0';
  // What follows may make the last character optional, or be another alternative.
  if (pattern[end] == '(' || pattern[end] == '[') return pattern.substr(0, end);
  return {};
}

/// Accepts a packet whose channel begins with `text`; goes on behind these instructions otherwise.
void accept_beginning(Program& program, const std::string& text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::size_t words = text.size() / 4, bytes = text.size() % 4;
  std::size_t left = 2 * (words + bytes) + 1;  // instructions
  std::uint32_t at = kChannel;
  for (std::size_t i = 0; i < text.size(); left -= 2) {
    const bool is_word = i < 4 * words;
    std::uint32_t value = byte(i);
    if (is_word)
      value = value << 24U | std::uint32_t{byte(i + 1)} << 16U | std::uint32_t{byte(i + 2)} << 8U |
              byte(i + 3);
    program.load(is_word ? BPF_W : BPF_B, at);
    program.skip_unless_equal(value, static_cast<std::uint8_t>(left - 2));
    const std::size_t step = is_word ? 4 : 1;
    i += step;
    at += static_cast<std::uint32_t>(step);
  }
  program.accept();
}

}  // namespace

bool let_through_only(int socket, const std::vector<std::string>& patterns, Origin origin) {
  Program program;
  program.load(BPF_H, kUdpLength);
  program.drop_if_above(kMaxUdpBytes);
  program.load(BPF_W, kMagic);
  program.drop_unless_equal(kWholeMessage);
  if (origin == Origin::ThisMachine) {
    // Our own multicast looped back, or whatever came through lo.
    program.load(BPF_B, static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_PKTTYPE));
    program.skip_if_equal(PACKET_LOOPBACK, 3);
    program.load(BPF_W, static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX));
    program.drop_unless_equal(kLoopbackIndex);
  }
  for (const std::string& pattern : patterns) accept_beginning(program, beginning_of(pattern));
  program.drop();
  return program.attach(socket);
}

namespace {
thread_local FilterAtBind* at_bind = nullptr;
}

FilterAtBind::FilterAtBind(std::vector<std::string> patterns, Origin origin)
    : patterns_(std::move(patterns)), origin_(origin) {
  at_bind = this;
}
FilterAtBind::~FilterAtBind() { at_bind = nullptr; }

void FilterAtBind::put_on(int socket) {
  if (let_through_only(socket, patterns_, origin_)) socket_ = socket;
}

}  // namespace crosswalk

/// Stands before the C library's for every call of this process, LCM's included.
extern "C" int bind(int socket, const sockaddr* address, socklen_t size) noexcept {
  if (crosswalk::at_bind != nullptr) crosswalk::at_bind->put_on(socket);
  return static_cast<int>(syscall(SYS_bind, socket, address, size));
}
