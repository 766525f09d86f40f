// The recorder's books: what it acknowledges, what it asks for, and that its log gives the channels
// back.
#include "recorder/recorder.h"

#include <algorithm>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "recorder/analysis.h"
#include "recorder/message_decode.h"
#include "tests/recorder/synthetic_run.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;

struct RecorderTest : ::testing::Test {
  fs::path folder =
      fs::temp_directory_path() / (std::string("cw_recorder_") +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::path log = folder / "signals.lcmlog";
  SyntheticRun run;
  std::vector<RawMessage> messages = run.messages();
  std::int64_t digest = run_digest(run.run_id);

  RecorderTest() { fs::create_directories(folder); }
  ~RecorderTest() override { fs::remove_all(folder); }

  void feed(Recorder& recorder, const RawMessage& m) const { recorder.add(m.channel, m.data, 0); }

  /// What a sender would send again for a gap.
  std::vector<RawMessage> resent(const Gap& gap) const {
    std::vector<RawMessage> out;
    for (const RawMessage& m : messages) {
      const auto h = peek_header(m.data);
      const bool is_kind = gap.kind == 0 ? rule_of(static_cast<MessageKind>(h->kind)).is_record
                                         : h->kind == gap.kind;
      if (h->sender == static_cast<int>(gap.role) && is_kind && h->seq >= gap.first &&
          h->seq <= gap.last) {
        out.push_back(m);
      }
    }
    return out;
  }
};

TEST_F(RecorderTest, AcknowledgesEveryWindowOfACleanRun) {
  Recorder recorder(log, digest);
  EXPECT_EQ(recorder.complete_window(), -1);
  for (const RawMessage& m : messages) feed(recorder, m);
  EXPECT_EQ(recorder.complete_window(), SyntheticRun::kWindows - 1);
  EXPECT_TRUE(recorder.gaps().empty());
  EXPECT_TRUE(recorder.is_complete());
  EXPECT_EQ(recorder.messages(), static_cast<std::int64_t>(messages.size()));
}

TEST_F(RecorderTest, DoesNotAcknowledgeAWindowWithAHole) {
  Recorder recorder(log, digest);
  int lost = 0;
  for (const RawMessage& m : messages) {
    const auto h = peek_header(m.data);
    const bool is_hole = h->kind == static_cast<int>(MessageKind::FeDone) && h->seq == 100;
    if (is_hole) {
      ++lost;
    } else {
      feed(recorder, m);
    }
  }
  ASSERT_EQ(lost, 1);
  EXPECT_EQ(recorder.complete_window(), 99);
  EXPECT_FALSE(recorder.is_complete());
  const std::vector<Gap> gaps = recorder.gaps();
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_EQ(gaps[0].role, Role::Fe);
  EXPECT_EQ(gaps[0].kind, static_cast<int>(MessageKind::FeDone));
  EXPECT_EQ(gaps[0].first, 100);
  EXPECT_EQ(gaps[0].last, 100);
}

TEST_F(RecorderTest, AsksForTheVeryLastMessagesToo) {
  // Everything after the audit of the last window is lost but the coupler's Finish and the
  // statuses.
  Recorder recorder(log, digest);
  for (const RawMessage& m : messages) {
    const auto h = peek_header(m.data);
    const bool is_last_done =
        h->kind == static_cast<int>(MessageKind::MbDone) && h->seq == SyntheticRun::kWindows - 1;
    if (!is_last_done) feed(recorder, m);
  }
  EXPECT_FALSE(recorder.is_complete());
  const std::vector<Gap> gaps = recorder.gaps();
  ASSERT_FALSE(gaps.empty());
  for (const Gap& gap : gaps) {
    for (const RawMessage& m : resent(gap)) feed(recorder, m);
  }
  EXPECT_TRUE(recorder.is_complete());
}

TEST_F(RecorderTest, FillsEveryGapOfALossyNetworkAndGivesTheSameChannels) {
  Recorder clean(folder / "clean.lcmlog", digest);
  for (const RawMessage& m : messages) feed(clean, m);
  clean.flush();
  Recorder lossy(log, digest);
  std::mt19937 random(11);
  const auto is_lost = [&random] { return random() % 5 == 0; };
  for (const RawMessage& m : messages) {
    const auto kind = static_cast<MessageKind>(peek_header(m.data)->kind);
    const bool is_repeated =
        kind == MessageKind::RunManifest || kind == MessageKind::RunControl ||
        kind == MessageKind::NodeStatus;  // the network repeats these until heard
    if (is_repeated || !is_lost()) feed(lossy, m);
  }
  int rounds = 0;
  for (; !lossy.is_complete() && rounds < 2000; ++rounds) {
    for (const Gap& gap : lossy.gaps()) {
      for (const RawMessage& m : resent(gap)) {
        if (!is_lost()) feed(lossy, m);
      }
    }
  }
  EXPECT_TRUE(lossy.is_complete()) << "after " << rounds << " rounds";
  lossy.flush();
  const auto csv = [&](const fs::path& from, const char* name) {
    const RunDirectory directory(folder / name);
    write_results(analyze_log(from), directory);
    std::ifstream in(directory.channels(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string expected = csv(folder / "clean.lcmlog", "a");
  EXPECT_GT(expected.size(), 100000U);
  EXPECT_TRUE(expected == csv(log, "b"));
}

TEST_F(RecorderTest, IgnoresGarbageButLogsIt) {
  Recorder recorder(log, digest);
  const std::vector<std::byte> junk(100, std::byte{0x5A});
  recorder.add("CW_JUNK", junk, 0);
  for (const RawMessage& m : messages) feed(recorder, m);
  EXPECT_TRUE(recorder.is_complete());
  EXPECT_EQ(recorder.messages(), static_cast<std::int64_t>(messages.size()) + 1);
}

}  // namespace
}  // namespace crosswalk::recording
