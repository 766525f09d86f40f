// What reaches LCM's socket, over real UDP.
#include "common/datagram_filter.h"

#include <array>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/error.h"
#include "common/lcm_transport.h"

namespace crosswalk {
namespace {

sockaddr_in address_of(const char* host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = inet_addr(host);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

class Socket {
 public:
  Socket() : number_(socket(AF_INET, SOCK_DGRAM, 0)) {}
  ~Socket() { close(number_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int number() const { return number_; }
  int bind_to(const char* host) {
    sockaddr_in address = address_of(host, 0);
    EXPECT_EQ(bind(number_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    getsockname(number_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }
  void send(const std::string& bytes, const char* host, int port) {
    sockaddr_in to = address_of(host, port);
    sendto(number_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to);
  }
  bool has_one() {
    pollfd wait{number_, POLLIN, 0};
    std::array<char, 65536> buffer;
    return poll(&wait, 1, 0) > 0 && recv(number_, buffer.data(), buffer.size(), 0) >= 0;
  }

 private:
  int number_;
};

using namespace std::string_literals;

std::string whole(const std::string& channel, std::size_t payload = 100) {
  return "LC02\0\0\0\1"s + channel + '\0' + std::string(payload, 'x');
}

/// Sends to a filtered socket on this machine; true when it comes through.
bool comes_through(const std::string& datagram, const std::vector<std::string>& patterns,
                   Origin origin = Origin::ThisMachine) {
  Socket receiver, sender;
  const int port = receiver.bind_to("127.0.0.1");
  EXPECT_TRUE(let_through_only(receiver.number(), patterns, origin));
  sender.send(datagram, "127.0.0.1", port);
  return receiver.has_one();
}

TEST(DatagramFilter, LetsThroughWhatIsSubscribed) {
  const std::vector<std::string> patterns = {"CW_12AB_STEP_TO_MB_COUPLER",
                                             "CW_12AB_CONTROL_(COUPLER|TOOL)"};
  for (const Origin origin : {Origin::ThisMachine, Origin::Anywhere}) {
    EXPECT_TRUE(comes_through(whole("CW_12AB_STEP_TO_MB_COUPLER"), patterns, origin));
    EXPECT_TRUE(comes_through(whole("CW_12AB_STEP_TO_MB_COUPLER", 1400), patterns, origin));
    EXPECT_TRUE(comes_through(whole("CW_12AB_CONTROL_TOOL"), patterns, origin));
    for (const char* other :
         {"CW_12AB_STEP_TO_MB_COUPLER2", "CW_12AB_STEP_TO_MB_COUPLE", "CW_12AB_STEP_TO_FE_COUPLER",
          "CW_12AC_STEP_TO_MB_COUPLER", "XW_12AB_CONTROL_TOOL", "CW_12AB_CONTROL", "", "A"})
      EXPECT_FALSE(comes_through(whole(other), patterns, origin)) << other;
  }
  for (const char* everything : {".*", "A*", "A|B", "A?B"})
    EXPECT_TRUE(comes_through(whole("B"), {everything})) << everything;
  EXPECT_TRUE(comes_through(whole("CW_1_X"), {"CW_1_[A-Z_]+"}));
  EXPECT_FALSE(comes_through(whole("CW_2_X"), {"CW_1_[A-Z_]+"}));
}

TEST(DatagramFilter, DropsFragmentsOversizedAndTornDatagrams) {
  const std::string good = whole("ABC");
  EXPECT_TRUE(comes_through(good, {"ABC"}));
  EXPECT_TRUE(comes_through(good, {".*"}));
  std::string fragment = good;
  fragment[3] = '3';
  EXPECT_FALSE(comes_through(fragment, {".*"}));
  EXPECT_FALSE(comes_through(whole("ABC", 2000), {".*"}));
  EXPECT_FALSE(comes_through(whole("ABC", 60000), {".*"}));
  for (std::size_t n = 0; n < 8 + 4; ++n) EXPECT_FALSE(comes_through(good.substr(0, n), {"ABC"}));
}

TEST(DatagramFilter, StandsBeforeASocketCanReceive) {
  Socket bound_before, receiver, bound_after, sender;
  const int early = bound_before.bind_to("127.0.0.1");
  int port = 0;
  {
    FilterAtBind filter({"ABC"}, Origin::ThisMachine);
    EXPECT_EQ(filter.socket(), -1);
    port = receiver.bind_to("127.0.0.1");
    EXPECT_EQ(filter.socket(), receiver.number());
  }
  const int late = bound_after.bind_to("127.0.0.1");
  for (const int to : {early, port, late}) sender.send(whole("OTHER"), "127.0.0.1", to);
  EXPECT_TRUE(bound_before.has_one());
  EXPECT_FALSE(receiver.has_one());
  EXPECT_TRUE(bound_after.has_one());
  sender.send(whole("ABC"), "127.0.0.1", port);
  EXPECT_TRUE(receiver.has_one());
}

// A fragment whose offset and size wrap around 32 bits: LCM 1.3.1 copies it over foreign memory.
std::string forged_fragment(const std::string& channel) {
  return "LC03\0\0\0\1\0\0\0\100\xff\xff\xff\xf0\0\0\0\2"s + channel + '\0' + std::string(20, 'x');
}

constexpr const char* kGroup = "239.255.76.67";

class ForgedFragment : public testing::Test {
 protected:
  void SetUp() override {
    port_ = Socket().bind_to("0.0.0.0");  // free again at once
    url_ = "udpm://"s + kGroup + ":" + std::to_string(port_) + "?ttl=0";
    try {
      if (plain_lcm_transport(url_)->subscribe("A", {})) return;
    } catch (const ProtocolError&) {
    }
    GTEST_SKIP() << "no multicast on this machine";
  }
  /// How a process ends that listens on channel A of `transport` while forged fragments and
  /// messages come: 0 when it has heard a hundred messages.
  int end_of_listener(std::shared_ptr<Transport> (*transport)(const std::string& url)) {
    const pid_t pid = fork();
    if (pid == 0) {
      int heard = 0;
      const auto listener = transport(url_);
      listener->subscribe(
          "A", [&](const std::string&, std::span<const std::byte>, std::int64_t) { ++heard; });
      for (int i = 0; i < 1000 && heard < 100; ++i) listener->handle(100);
      _exit(heard >= 100 ? 0 : 1);
    }
    Socket sender;
    int status = 0;
    while (waitpid(pid, &status, WNOHANG) == 0) {
      sender.send(forged_fragment("A"), kGroup, port_);
      usleep(1000);
      sender.send(whole("A"), kGroup, port_);
      usleep(1000);
    }
    return status;
  }
  int port_ = 0;
  std::string url_;
};

TEST_F(ForgedFragment, KillsAPlainLcmListenerButNotOurs) {
  EXPECT_NE(end_of_listener(plain_lcm_transport), 0)
      << "LCM has learnt to check its fragments; the filter still keeps other machines out";
  EXPECT_EQ(end_of_listener(lcm_transport), 0);
}

}  // namespace
}  // namespace crosswalk
