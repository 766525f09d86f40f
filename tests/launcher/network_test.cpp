#include "launcher/network.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace crosswalk {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:27000?ttl=0&recv_buf_size=4194304";

TEST(LcmUrl, PortIsReadAndReplaced) {
  EXPECT_EQ(port_of(kUrl), 27000);
  EXPECT_EQ(url_with_port(kUrl, 27001), "udpm://239.255.76.67:27001?ttl=0&recv_buf_size=4194304");
  EXPECT_EQ(port_of("udpm://239.255.76.67"), 0);
  EXPECT_EQ(port_of("tcpq://host:7700"), 0);
  EXPECT_EQ(url_with_port("tcpq://host:7700", 1), "tcpq://host:7700");
}

TEST(UdpPort, BoundOneIsNotFree) {
  const int holder = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in any{};
  any.sin_family = AF_INET;
  ASSERT_EQ(bind(holder, reinterpret_cast<sockaddr*>(&any), sizeof any), 0);
  socklen_t size = sizeof any;
  getsockname(holder, reinterpret_cast<sockaddr*>(&any), &size);
  EXPECT_FALSE(is_udp_port_free(ntohs(any.sin_port)));
  close(holder);
  EXPECT_TRUE(is_udp_port_free(ntohs(any.sin_port)));
}

}  // namespace
}  // namespace crosswalk
