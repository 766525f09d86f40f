#include "tests/system/datagram_fuzzer.h"

#include <array>
#include <chrono>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace crosswalk::system_test {

namespace {

constexpr const char* kGroup = "239.255.76.67";
constexpr std::size_t kKept = 4000;          // datagrams to choose from
constexpr std::size_t kHeader = 8;           // magic and sequence number of a whole message
constexpr std::size_t kMaxDatagram = 65507;  // of UDP

sockaddr_in address_of(in_addr_t host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = host;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift);
  return out;
}

}  // namespace

DatagramFuzzer::DatagramFuzzer(int port, unsigned seed, int per_second)
    : port_(port),
      random_(seed),
      per_second_(per_second),
      receiver_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0)),
      sender_(socket(AF_INET, SOCK_DGRAM, 0)) {
  const int on = 1;
  setsockopt(receiver_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in any = address_of(htonl(INADDR_ANY), port);
  bind(receiver_, reinterpret_cast<sockaddr*>(&any), sizeof any);
  ip_mreq membership{};
  membership.imr_multiaddr.s_addr = inet_addr(kGroup);
  setsockopt(receiver_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership);
  thread_ = std::thread([this] { run(); });
}

DatagramFuzzer::~DatagramFuzzer() {
  stop_ = true;
  thread_.join();
  close(receiver_);
  close(sender_);
}

void DatagramFuzzer::run() {
  sockaddr_in group = address_of(inet_addr(kGroup), port_);
  const auto pause = std::chrono::microseconds(1'000'000 / per_second_);
  while (!stop_) {
    listen();
    const std::string datagram = next();
    sendto(sender_, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&group),
           sizeof group);
    ++sent_;
    std::this_thread::sleep_for(pause);
  }
}

void DatagramFuzzer::listen() {
  std::array<char, 65536> buffer;
  ssize_t n = 0;
  while ((n = recv(receiver_, buffer.data(), buffer.size(), 0)) > 0) {
    const std::string datagram(buffer.data(), static_cast<std::size_t>(n));
    ++overheard_;
    if (heard_.size() < kKept) {
      heard_.push_back(datagram);
    } else if (random_() % 4 == 0) {
      heard_[below(kKept)] = datagram;
    }
  }
}

std::string DatagramFuzzer::any_heard() {
  return heard_.empty() ? noise(100) : heard_[below(heard_.size())];
}

std::string DatagramFuzzer::noise(std::size_t n) {
  std::string out(n, '\0');
  for (char& c : out) c = static_cast<char>(random_());
  return out;
}

std::string DatagramFuzzer::next() {
  std::string datagram = any_heard();
  const std::size_t channel_end = datagram.find('\0', kHeader);
  const std::size_t payload = channel_end == std::string::npos ? datagram.size() : channel_end + 1;
  switch (random_() % 10) {
    case 0:  // bits anywhere
      for (std::size_t i = 1 + below(8); i > 0 && !datagram.empty(); --i)
        datagram[below(datagram.size())] ^= static_cast<char>(1U << below(8));
      return datagram;
    case 1:
    case 2:  // bits of the payload: the envelope stays sound
      for (std::size_t i = 1 + below(8); i > 0 && payload < datagram.size(); --i)
        datagram[payload + below(datagram.size() - payload)] ^= static_cast<char>(1U << below(8));
      return datagram;
    case 3:  // torn
      return datagram.substr(0, below(datagram.size()));
    case 4:  // too long
      return datagram + noise(below(random_() % 8 == 0 ? kMaxDatagram - datagram.size() : 2000));
    case 5: {  // a fragment of a message, most of its numbers absurd
      const std::string channel = datagram.substr(std::min(kHeader, datagram.size()), 40);
      const bool is_small = random_() % 2 == 0;
      const auto number = [&] {
        return static_cast<std::uint32_t>(is_small ? random_() % 3000 : random_());
      };
      return "LC03" + big_endian(static_cast<std::uint32_t>(random_())) + big_endian(number()) +
             big_endian(number()) + big_endian(static_cast<std::uint32_t>(random_() % 3)) +
             channel + '\0' + noise(below(1400));
    }
    case 6: {  // one message's payload on another's channel
      const std::string other = any_heard();
      return other.substr(0, other.find('\0', std::min(kHeader, other.size()))) + '\0' +
             datagram.substr(payload);
    }
    case 7:  // another run's channel
      if (datagram.size() > kHeader + 4) datagram[kHeader + 3] = static_cast<char>('A' + below(26));
      return datagram;
    case 8:  // rubbish
      return noise(below(2000));
    default:  // an old message as it was
      return datagram;
  }
}

}  // namespace crosswalk::system_test
