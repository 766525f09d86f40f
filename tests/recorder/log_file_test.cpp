#include "recorder/log_file.h"

#include <array>
#include <fstream>

#include <gtest/gtest.h>

#include "common/error.h"

namespace crosswalk::recording {
namespace {

namespace fs = std::filesystem;

struct LogFileTest : ::testing::Test {
  fs::path path = fs::temp_directory_path() /
                  (std::string("cw_log_") +
                   ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".lcmlog");
  ~LogFileTest() override { fs::remove(path); }

  void write(int events) const {
    LogWriter writer(path);
    for (int i = 0; i < events; ++i) {
      const std::vector<std::byte> data(static_cast<std::size_t>(10 + i),
                                        static_cast<std::byte>(i));
      writer.write(1000 * i, "CW_TEST_" + std::to_string(i % 3), data);
    }
  }
  std::vector<LogEvent> read(LogExtent* extent = nullptr) const {
    std::vector<LogEvent> events;
    const LogExtent found = read_log(path, [&](const LogEvent& e) { events.push_back(e); });
    if (extent != nullptr) *extent = found;
    return events;
  }
};

TEST_F(LogFileTest, IsKnownByItsFirstBytes) {
  write(1);
  EXPECT_TRUE(is_event_log(path));
  EXPECT_FALSE(is_event_log(path.parent_path()));
  EXPECT_FALSE(is_event_log("/nowhere"));
  std::ofstream(path) << "t,value\n0,1\n";
  EXPECT_FALSE(is_event_log(path));
}

TEST_F(LogFileTest, EventsComeBackAsWritten) {
  write(20);
  LogExtent extent;
  const std::vector<LogEvent> events = read(&extent);
  ASSERT_EQ(events.size(), 20U);
  EXPECT_EQ(extent.cut_bytes, 0);
  for (int i = 0; i < 20; ++i) {
    const LogEvent& e = events[static_cast<std::size_t>(i)];
    EXPECT_EQ(e.number, i);
    EXPECT_EQ(e.time_us, 1000 * i);
    EXPECT_EQ(e.channel, "CW_TEST_" + std::to_string(i % 3));
    ASSERT_EQ(e.data.size(), static_cast<std::size_t>(10 + i));
    EXPECT_EQ(e.data.back(), static_cast<std::byte>(i));
  }
}

TEST_F(LogFileTest, HeaderBytesFollowTheFormatOfLcmLogger) {
  {
    LogWriter writer(path);
    const std::array<std::byte, 2> data{std::byte{0xAB}, std::byte{0xCD}};
    writer.write(0x0102030405060708, "XY", data);
  }
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const std::string expected(
      "\xED\xA1\xDA\x01"
      "\0\0\0\0\0\0\0\0"
      "\x01\x02\x03\x04\x05\x06\x07\x08"
      "\0\0\0\x02\0\0\0\x02"
      "XY\xAB\xCD",
      32);
  EXPECT_EQ(bytes, expected);
}

TEST_F(LogFileTest, ACutLogIsReadUpToTheLastWholeEvent) {
  write(20);
  fs::resize_file(path, fs::file_size(path) - 5);
  LogExtent extent;
  EXPECT_EQ(read(&extent).size(), 19U);
  EXPECT_GT(extent.cut_bytes, 0);
}

TEST_F(LogFileTest, DamageInTheMiddleCostsOnlyTheEventsItTouches) {
  write(20);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(0);
  file.write("\0\0\0\0", 4);  // the sync word of the first event
  file.close();
  EXPECT_EQ(read().size(), 19U);
}

TEST_F(LogFileTest, AMissingFileIsTheUsersError) {
  EXPECT_THROW(read_log("/nowhere/at.all", [](const LogEvent&) {}), UserError);
  EXPECT_THROW(LogWriter("/nowhere/at.all"), UserError);
}

TEST_F(LogFileTest, AFollowerSeesEveryEventOnceHoweverTheFileGrows) {
  write(20);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  fs::remove(path);
  LogFollower follower(path);
  std::vector<std::int64_t> numbers;
  const auto look = [&] { follower.poll([&](const LogEvent& e) { numbers.push_back(e.number); }); };
  look();  // there is no file yet
  std::ofstream out(path, std::ios::binary);
  for (std::size_t at = 0; at < bytes.size(); at += 37) {
    out << bytes.substr(at, 37) << std::flush;
    look();
  }
  ASSERT_EQ(numbers.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(numbers[static_cast<std::size_t>(i)], i);
}

TEST_F(LogFileTest, AFollowerGoesOnWhenAResumedRunHasCutTheLogBack) {
  write(20);
  LogFollower follower(path);
  std::vector<std::int64_t> numbers;
  follower.poll([&](const LogEvent& e) { numbers.push_back(e.number); });
  write(9);  // shorter than before, then beyond
  follower.poll([&](const LogEvent& e) { numbers.push_back(e.number); });
  write(40);
  follower.poll([&](const LogEvent& e) { numbers.push_back(e.number); });
  ASSERT_GT(numbers.size(), 30U);
  EXPECT_EQ(numbers.back(), 39);
}

}  // namespace
}  // namespace crosswalk::recording
