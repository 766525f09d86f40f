// From messages to channels: closed-form motion, and the same bits whatever the network did.
#include "recorder/extract.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "tests/recorder/synthetic_run.h"

namespace crosswalk::recording {
namespace {

RunRecord record_of(const std::vector<RawMessage>& messages) {
  RecordBuilder builder;
  for (const RawMessage& m : messages) builder.add(m.data, 1);
  return builder.record();
}

double value_at(const RunChannels& run, const std::string& name, double t) {
  const Channel* c = run.find(name);
  if (c == nullptr) {
    ADD_FAILURE() << "no channel " << name;
    return std::nan("");
  }
  const auto i = static_cast<std::size_t>(std::llround((t - c->t0) / c->dt));
  return i < c->samples.size() ? c->samples[i] : std::nan("");
}

bool same_bits(const RunChannels& a, const RunChannels& b) {
  if (a.channels.size() != b.channels.size()) return false;
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    const auto& x = a.channels[i].samples;
    const auto& y = b.channels[i].samples;
    if (a.channels[i].name != b.channels[i].name || x.size() != y.size() ||
        std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) != 0) {
      return false;
    }
  }
  return true;
}

TEST(Extract, TimeZeroIsTheFirstCarContact) {
  const RunChannels run = extract(record_of(SyntheticRun{}.messages()));
  EXPECT_TRUE(run.has_first_contact);
  EXPECT_NEAR(run.t0, SyntheticRun::kFirstContact, 1.01e-4);  // sampled every 0.1 ms
  EXPECT_NEAR(value_at(run, "head_cog_y", 0), 0, 1e-9);
  EXPECT_NEAR(value_at(run, "head_cog_relative_y", 0), 0, 1e-9);
}

TEST(Extract, DisplacementsAndSpeedsAreThoseOfTheMotion) {
  const RunChannels run = extract(record_of(SyntheticRun{}.messages()));
  const double t = 0.016;
  EXPECT_NEAR(value_at(run, "head_cog_z", t), -0.5e3 * t, 1e-6);
  EXPECT_NEAR(value_at(run, "buck_y", t), 11e3 * t, 1e-6);
  EXPECT_NEAR(value_at(run, "head_cog_relative_y", t), value_at(run, "head_cog_y", t) - 11e3 * t,
              1e-6);
  EXPECT_NEAR(value_at(run, "head_speed_relative", 0.001), std::hypot(11, 0.5), 1e-6);
  EXPECT_NEAR(value_at(run, "head_speed_relative", 0.0175), std::hypot(8, 0.5), 1e-3);
}

TEST(Extract, HeadSignalsAreInJ211Axes) {
  const RunChannels run = extract(record_of(SyntheticRun{}.messages()));
  // The head turns about z up, so about -z of J211.
  EXPECT_NEAR(value_at(run, "head_angular_velocity_z", 0.01), -SyntheticRun::kSpin, 1e-6);
  EXPECT_NEAR(value_at(run, "head_angular_velocity_x", 0.01), 0, 1e-9);
  // At 15 ms the acceleration is 3 / (sqrt(pi) 1.5 ms) along y of W, seen from a head turned by 0.3
  // rad.
  const double t = 0.015 - run.t0, angle = SyntheticRun::kSpin * 0.015;
  const double a = 3 / (std::sqrt(M_PI) * 0.0015);
  EXPECT_NEAR(value_at(run, "head_acceleration_unfiltered_x", t), a * std::sin(angle), 1e-3 * a);
  EXPECT_NEAR(value_at(run, "head_acceleration_unfiltered_y", t), -a * std::cos(angle), 1e-3 * a);
  EXPECT_NEAR(value_at(run, "head_acceleration_resultant", t), a, 0.03 * a);
  EXPECT_NEAR(value_at(run, "head_acceleration_world_y", t), a, 0.03 * a);
}

TEST(Extract, HeadContactIsReportedAgainstTimeZero) {
  const RunChannels run = extract(record_of(SyntheticRun{}.messages()));
  ASSERT_TRUE(run.head_contact);
  EXPECT_NEAR(run.head_contact->time, SyntheticRun::kHeadContact - run.t0, 2.1e-5);
  EXPECT_EQ(run.head_contact->peak_force, 2000);
  EXPECT_NEAR(run.head_contact->buck_speed, 11, 1e-9);
}

TEST(Extract, ContactIsLocatedOnTheProfile) {
  SyntheticRun multibody;
  multibody.has_fe = false;  // the head is a body; its pair with the car is named head_...
  const RunChannels run = extract(record_of(multibody.messages()));
  ASSERT_TRUE(run.head_contact);
  // The head COG is 0.4095 m behind the foremost point and 1.694 m above the ground; its foot on
  // the hood's line from (0, 0.8) to (-1, 1) divides that line at s.
  const double s = (0.4095 * 1.0 + 0.894 * 0.2) / (1.0 + 0.2 * 0.2);
  EXPECT_EQ(run.head_contact->partner, "hood");
  ASSERT_TRUE(run.head_contact->wrap_around_distance);
  EXPECT_NEAR(*run.head_contact->wrap_around_distance, 0.8 + s * std::hypot(1.0, 0.2), 1e-3);
}

TEST(Extract, ReorderedDoubledAndReplayedMessagesGiveTheSameBits) {
  std::vector<RawMessage> messages = SyntheticRun{}.messages();
  const RunChannels clean = extract(record_of(messages));
  std::mt19937 random(3);
  for (std::size_t i = 0; i < 200; ++i) messages.push_back(messages[random() % messages.size()]);
  std::shuffle(messages.begin(), messages.end(), random);
  const RunRecord shuffled = record_of(messages);
  EXPECT_GT(shuffled.doubled, 0);
  EXPECT_EQ(shuffled.lost, 0);
  EXPECT_TRUE(same_bits(clean, extract(shuffled)));
}

TEST(Extract, LostMessagesAreCountedAndGapsClosedWithAWarning) {
  std::vector<RawMessage> messages = SyntheticRun{}.messages();
  const auto is_head = [](const RawMessage& m) {
    return m.channel.find("_HEAD_") != std::string::npos;
  };
  const auto found = std::find_if(messages.begin() + 1000, messages.end(), is_head);
  messages.erase(found);
  const RunRecord record = record_of(messages);
  EXPECT_EQ(record.lost, 1);
  const RunChannels run = extract(record);
  ASSERT_FALSE(run.warnings.empty());
  EXPECT_NE(run.warnings[0].find("head samples are missing"), std::string::npos);
}

TEST(Extract, MessagesOfAnotherRunAndGarbageAreLeftOut) {
  std::vector<RawMessage> messages = SyntheticRun{}.messages();
  const RunChannels clean = extract(record_of(messages));
  SyntheticRun other;
  other.run_id = "other";
  for (const RawMessage& m : other.messages()) messages.push_back(m);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    RawMessage junk = messages[random() % messages.size()];
    for (int k = 0; k < 8; ++k)
      junk.data[random() % junk.data.size()] = static_cast<std::byte>(random());
    junk.data.resize(random() % junk.data.size());
    messages.push_back(junk);
  }
  const RunRecord record = record_of(messages);
  EXPECT_GT(record.foreign, 0);
  EXPECT_GT(record.unreadable, 0);
  EXPECT_TRUE(same_bits(clean, extract(record)));
}

TEST(Extract, BrokenSealsAndOtherProtocolsAreLeftOut) {
  std::vector<RawMessage> messages = SyntheticRun{}.messages();
  const RunChannels clean = extract(record_of(messages));
  std::vector<RawMessage> mutated = messages;
  for (RawMessage m : messages) {
    m.data[m.data.size() / 2] ^= std::byte{4};
    mutated.push_back(m);
  }
  const RunRecord record = record_of(mutated);
  EXPECT_EQ(record.unreadable, static_cast<std::int64_t>(messages.size()));
  EXPECT_TRUE(same_bits(clean, extract(record)));
  for (RawMessage& m : messages) m.data[9] = std::byte{1};  // protocol, behind the type hash
  EXPECT_TRUE(record_of(messages).head.empty());
}

TEST(Extract, NeckLoadsAreInJ211AxesAndRatedAboutTheCondyles) {
  const RunChannels run = extract(record_of(SyntheticRun{}.messages()));
  const Channel* fz = run.find("neck_force_z");
  const Channel* my = run.find("neck_moment_y");
  ASSERT_TRUE(fz && my);
  EXPECT_NEAR(fz->samples[fz->samples.size() / 2], SyntheticRun::kNeckPull, 1e-3);
  EXPECT_NEAR(my->samples[my->samples.size() / 2], SyntheticRun::kNeckFlexion, 1e-5);
  EXPECT_EQ(my->unit, "Nm");
  const ScoreCard card = score_card(run.head);
  ASSERT_TRUE(card.neck);
  // Tension and flexion; with the lever of a dummy's cell the force along x would count as well.
  EXPECT_NEAR(card.neck->Nij, SyntheticRun::kNeckPull / 6806 + SyntheticRun::kNeckFlexion / 310,
              1e-4);
  EXPECT_EQ(card.neck->Nij, card.neck->NTF);
}

TEST(Numbers, TellsGapsAsRanges) {
  Numbers n;
  for (const int seq : {0, 1, 4, 5, 9}) EXPECT_TRUE(n.add(seq));
  EXPECT_FALSE(n.add(4));
  EXPECT_EQ(n.complete(), 2);
  const auto gaps = n.missing(12, 10);
  ASSERT_EQ(gaps.size(), 3U);
  EXPECT_EQ(gaps[0], (std::pair<std::int64_t, std::int64_t>{2, 3}));
  EXPECT_EQ(gaps[1], (std::pair<std::int64_t, std::int64_t>{6, 8}));
  EXPECT_EQ(gaps[2], (std::pair<std::int64_t, std::int64_t>{10, 11}));
}

}  // namespace
}  // namespace crosswalk::recording
