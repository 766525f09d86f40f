// The broker with our client and with LCM's own, over the loopback interface.
#include "coupler/broker.h"

#include <thread>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/error.h"
#include "common/lcm_transport.h"

namespace crosswalk {
namespace {

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return {data, data + text.size()};
}

std::string text_of(std::span<const std::byte> data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

class BrokerTest : public testing::Test {
 protected:
  ~BrokerTest() override {
    stop_ = true;
    thread_.join();
  }
  std::string url() const { return "tcpq://127.0.0.1:" + std::to_string(broker_.port()); }
  /// Handles messages of `transport` until `text` ends in `end`.
  static bool hears(Transport& transport, const std::string& text, const std::string& end) {
    for (int i = 0; i < 100 && !text.ends_with(end); ++i) transport.handle(100);
    return text.ends_with(end);
  }
  /// A subscription is in force when a message published after it arrives.
  static void settle(Transport& transport, std::string& heard, const std::string& channel) {
    transport.publish(channel, bytes_of("ready"));
    EXPECT_TRUE(hears(transport, heard, "ready"));
    heard.clear();
  }

  Broker broker_{{"127.0.0.1", 0}};
  std::atomic<bool> stop_ = false;
  std::thread thread_{[this] { broker_.serve(stop_); }};
};

TEST_F(BrokerTest, HandsMessagesToSubscribersOfTheChannel) {
  const auto a = tcpq_transport(url()), b = tcpq_transport(url());
  std::string heard;
  b->subscribe("CW_1_.*", [&](const std::string& channel, std::span<const std::byte> data,
                              std::int64_t) { heard += channel + "=" + text_of(data); });
  settle(*b, heard, "CW_1_X");
  a->publish("CW_2_X", bytes_of("no"));
  a->publish("XCW_1_X", bytes_of("no"));  // the expression must match the whole name
  a->publish("CW_1_X", bytes_of("yes"));
  EXPECT_TRUE(hears(*b, heard, "yes"));
  EXPECT_EQ(heard, "CW_1_X=yes");
}

TEST_F(BrokerTest, SpeaksWithLcmsOwnClient) {
  const auto ours = tcpq_transport(url());
  const auto theirs = lcm_transport(url());
  std::string heard_by_us, heard_by_them;
  ours->subscribe("TO_US", [&](const std::string&, std::span<const std::byte> data, std::int64_t) {
    heard_by_us += text_of(data);
  });
  theirs->subscribe("TO_THEM", [&](const std::string&, std::span<const std::byte> data,
                                   std::int64_t) { heard_by_them += text_of(data); });
  settle(*ours, heard_by_us, "TO_US");
  settle(*theirs, heard_by_them, "TO_THEM");
  const std::string large(100000, 'x');
  ours->publish("TO_THEM", bytes_of(large + "1"));
  theirs->publish("TO_US", bytes_of(large + "2"));
  EXPECT_TRUE(hears(*theirs, heard_by_them, "1"));
  EXPECT_TRUE(hears(*ours, heard_by_us, "2"));
  EXPECT_EQ(heard_by_them.size(), large.size() + 1);
  EXPECT_EQ(heard_by_us.size(), large.size() + 1);
}

TEST_F(BrokerTest, LetsAForeignClientGoAndServesTheOthers) {
  const auto a = tcpq_transport(url());
  std::string heard;
  a->subscribe("X", [&](const std::string&, std::span<const std::byte> data, std::int64_t) {
    heard += text_of(data);
  });
  settle(*a, heard, "X");
  for (const std::string& greeting :
       {std::string("GET / HTTP/1.0\r\n\r\n"),
        std::string("\x28\x76\x17\xfb\0\0\1\0\0\0\0\1\xff\xff\xff\xff", 16),
        std::string("\x28\x76\x17\xfb\0\0\1\0\0\0\0\2\0\0\0\1[", 17)}) {
    const int foreign = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(broker_.port()));
    ASSERT_EQ(connect(foreign, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_GT(write(foreign, greeting.data(), greeting.size()), 0);
    char buffer[64];
    while (read(foreign, buffer, sizeof buffer) > 0) {
    }  // until it is closed
    close(foreign);
    a->publish("X", bytes_of("still here"));
    EXPECT_TRUE(hears(*a, heard, "still here"));
  }
}

TEST(Tcpq, WithoutABrokerSaysHowToStartOne) {
  try {
    tcpq_transport("tcpq://127.0.0.1:1", 0.1);
    FAIL();
  } catch (const ProtocolError& error) {
    EXPECT_EQ(error.code(), ExitCode::NoTransport);
    EXPECT_NE(std::string(error.what()).find("crosswalk broker --listen 127.0.0.1:1"),
              std::string::npos);
  }
}

TEST(Tcpq, AddressesAreRead) {
  EXPECT_EQ(tcpq::address_from("tcpq://host:77").port, 77);
  EXPECT_EQ(tcpq::address_from("host").port, tcpq::kDefaultPort);
  EXPECT_EQ(tcpq::address_from("host").host, "host");
  for (const char* bad : {"", ":1", "host:x", "host:99999"})
    EXPECT_THROW(tcpq::address_from(bad), UserError) << bad;
}

TEST(TcpqStream, GivesRecordsWhateverThePieces) {
  std::vector<std::byte> bytes = tcpq::encode(tcpq::RecordKind::Subscribe, "a");
  const auto second = tcpq::encode(tcpq::RecordKind::Publish, "channel", bytes_of("data"));
  bytes.insert(bytes.end(), second.begin(), second.end());
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    tcpq::Stream stream;
    std::vector<tcpq::Record> records;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      stream.append({bytes.data() + at, std::min(piece, bytes.size() - at)});
      for (tcpq::Record record; stream.take(record);) records.push_back(record);
    }
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0].channel, "a");
    EXPECT_EQ(records[1].channel, "channel");
    EXPECT_EQ(text_of(records[1].data), "data");
  }
}

}  // namespace
}  // namespace crosswalk
