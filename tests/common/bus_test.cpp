#include "common/bus.h"

#include <random>

#include <gtest/gtest.h>

#include "common/error.h"
#include "crosswalk/msg/node_hello.hpp"
#include "crosswalk/msg/recorder_ack.hpp"
#include "crosswalk/msg/run_control.hpp"

namespace crosswalk {
namespace {

msg::node_hello some_hello() {
  msg::node_hello hello{};
  hello.body_name = {"torso_up", "buck"};
  hello.n_bodies = 2;
  hello.host = "here";
  hello.version = "1";
  return hello;
}

TEST(Bus, DeliversToOtherNodesOfTheRunOnly) {
  const auto transport = memory_transport();
  Bus recorder(transport, "run-a", Role::Recorder);
  Bus coupler(transport, "run-a", Role::Coupler);
  Bus stranger(transport, "run-b", Role::Coupler);
  int heard = 0, strange = 0;
  coupler.subscribe<msg::recorder_ack>(Role::Recorder, [&](const msg::recorder_ack& m) {
    ++heard;
    EXPECT_EQ(m.window, 42);
    EXPECT_EQ(m.h.seq, 5);
    EXPECT_EQ(m.h.instance, recorder.instance());
  });
  stranger.subscribe<msg::recorder_ack>(Role::Recorder,
                                        [&](const msg::recorder_ack&) { ++strange; });
  msg::recorder_ack ack{};
  ack.window = 42;
  recorder.publish(ack, 5);
  coupler.handle_pending();
  EXPECT_EQ(heard, 1);
  EXPECT_EQ(strange, 0);
}

TEST(Bus, HandlerExceptionsComeOutOfWait) {
  const auto transport = memory_transport();
  Bus sender(transport, "r", Role::Recorder);
  Bus receiver(transport, "r", Role::Coupler);
  receiver.subscribe<msg::recorder_ack>(
      Role::Recorder, [](const msg::recorder_ack&) { throw NumericalError(0.1, "broken"); });
  sender.publish(msg::recorder_ack{}, 0);
  EXPECT_THROW(receiver.handle_pending(), NumericalError);
  EXPECT_NO_THROW(receiver.handle_pending());
}

TEST(Bus, GateRefusesTruncatedOversizedForeignAndForgedMessages) {
  const auto transport = memory_transport();
  Bus sender(transport, "r", Role::Mb);
  Bus gate(transport, "r", Role::Coupler);
  const std::vector<std::byte> good = sender.publish(some_hello(), 0);
  msg::node_hello out{};
  EXPECT_TRUE(gate.decode(good, out, Role::Mb));
  EXPECT_EQ(out.body_name, some_hello().body_name);
  EXPECT_FALSE(gate.decode(good, out, Role::Fe)) << "sender's role does not fit the channel";

  for (std::size_t n = 0; n < good.size(); ++n) {
    EXPECT_FALSE(gate.decode({good.data(), n}, out, Role::Mb)) << "truncated to " << n;
  }
  // As LCM tells it when the name of a datagram's channel has no end: nothing is read.
  EXPECT_FALSE(gate.decode({good.data(), 0xfffffff0U}, out, Role::Mb));
  // Behind the seal stand the gates of size and content.
  const std::vector<std::byte> payload(good.begin(), good.end() - kSealBytes);
  const auto passes_sealed = [&](std::vector<std::byte> forged) {
    seal(gate.run(), forged);
    return gate.decode(forged, out, Role::Mb);
  };
  EXPECT_TRUE(passes_sealed(payload));
  std::vector<std::byte> forged = payload;
  forged.resize(static_cast<std::size_t>(kMaxMessageBytes) + 1);
  EXPECT_FALSE(passes_sealed(forged));
  forged = payload;
  forged[8 + 28 + 20] = std::byte{0x7f};  // n_bodies of two thousand million
  EXPECT_FALSE(passes_sealed(forged));
  forged = payload;
  forged[8 + 28 + 28] = std::byte{0xff};  // negative length of the first string
  EXPECT_FALSE(passes_sealed(forged));
  EXPECT_GT(gate.dropped(), 4);
}

TEST(Bus, NoMutatedMessagePasses) {
  const auto transport = memory_transport();
  Bus sender(transport, "r", Role::Coupler);
  Bus gate(transport, "r", Role::Mb);
  msg::run_control control{};
  control.text = "reason";
  const std::vector<std::byte> good = sender.publish(control, 0);
  msg::run_control out{};
  ASSERT_TRUE(gate.decode(good, out, Role::Coupler));
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::vector<std::byte> flipped = good;
    flipped[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_FALSE(gate.decode(flipped, out, Role::Coupler)) << "bit " << bit;
    for (const std::size_t other : {std::size_t{3}, good.size() / 2, good.size() - 1}) {
      if (other == bit / 8) continue;
      std::vector<std::byte> twice = flipped;
      twice[other] ^= static_cast<std::byte>(1U << bit % 8);
      EXPECT_FALSE(gate.decode(twice, out, Role::Coupler)) << "bit " << bit << ", byte " << other;
    }
  }
}

TEST(Bus, SealedMessagesOfTheRunAreHeardWholeByTheirListener) {
  const auto transport = memory_transport();
  Bus sender(transport, "r", Role::Mb), stranger(transport, "s", Role::Mb);
  Bus listener(transport, "r", Role::Recorder);
  std::vector<std::byte> heard;
  int count = 0;
  listener.subscribe_sealed([&](const std::string&, std::span<const std::byte> data, std::int64_t) {
    heard.assign(data.begin(), data.end());
    ++count;
  });
  const std::vector<std::byte> good = sender.publish(some_hello(), 0);
  stranger.publish(some_hello(), 0);
  std::vector<std::byte> foreign = good;
  foreign.resize(good.size() - kSealBytes);
  seal(stranger.run(), foreign);  // as if of another run on this one's channel
  sender.send(MessageKind::NodeHello, foreign);
  listener.handle_pending();
  EXPECT_EQ(count, 1);
  EXPECT_EQ(heard, good);
  EXPECT_EQ(listener.dropped(), 1);
  // What an LCM tool does with it: the type's members, whatever follows.
  msg::node_hello read{};
  EXPECT_GT(read.decode(heard.data(), 0, static_cast<int>(heard.size())), 0);
  EXPECT_EQ(read.body_name, some_hello().body_name);
}

TEST(Bus, RandomBytesNeitherPassNorCrash) {
  const auto transport = memory_transport();
  Bus sender(transport, "r", Role::Coupler);
  Bus gate(transport, "r", Role::Mb);
  std::mt19937 random(1);
  msg::run_control control{};
  control.text = "reason";
  const std::vector<std::byte> good = sender.publish(control, 0);
  int passed = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> bytes = good;
    const int mutations = 1 + static_cast<int>(random() % 8);
    for (int k = 0; k < mutations; ++k)
      bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    bytes.resize(random() % (bytes.size() + 1) + (random() % 4 == 0 ? 20 : 0));
    if (bytes == good) continue;
    msg::run_control out{};
    passed += gate.decode(bytes, out, Role::Coupler) ? 1 : 0;
    EXPECT_LE(out.text.size(), static_cast<std::size_t>(kMaxMessageBytes));
  }
  EXPECT_EQ(passed, 0);
}

TEST(Bus, OwnMessagesAreNotHeard) {
  const auto transport = memory_transport();
  Bus bus(transport, "r", Role::Coupler);
  int heard = 0;
  bus.subscribe<msg::run_control>(Role::Coupler, [&](const msg::run_control&) { ++heard; });
  bus.publish(msg::run_control{}, 0);
  bus.handle_pending();
  EXPECT_EQ(heard, 0);
}

TEST(BusFaults, AreReadStrictly) {
  const BusFaults faults =
      BusFaults::from_text("loss=0.05 duplicate=0.02 reorder=0.01 delay_ms=20 seed=7");
  EXPECT_EQ(faults.loss, 0.05);
  EXPECT_EQ(faults.delay_ms, 20);
  EXPECT_EQ(faults.seed, 7U);
  EXPECT_THROW(BusFaults::from_text("los=0.05"), UserError);
  EXPECT_THROW(BusFaults::from_text("loss=2"), UserError);
  EXPECT_THROW(BusFaults::from_text("loss"), UserError);
}

TEST(BusFaults, LossAndDuplicationHappenAtTheirRates) {
  const auto transport = memory_transport();
  Bus sender(transport, "r", Role::Recorder, BusFaults{.loss = 0.2, .duplicate = 0.1});
  Bus receiver(transport, "r", Role::Coupler);
  std::vector<int> copies(2000);
  receiver.subscribe<msg::recorder_ack>(Role::Recorder, [&](const msg::recorder_ack& m) {
    ++copies[static_cast<std::size_t>(m.h.seq)];
  });
  for (int i = 0; i < 2000; ++i) sender.publish(msg::recorder_ack{}, i);
  receiver.handle_pending();
  // Binomial, five standard deviations.
  EXPECT_NEAR(static_cast<double>(std::count(copies.begin(), copies.end(), 0)), 400, 90);
  EXPECT_NEAR(static_cast<double>(std::count(copies.begin(), copies.end(), 2)), 160, 63);
}

}  // namespace
}  // namespace crosswalk
