#include "launcher/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crosswalk {
namespace {

std::string shown(ProgressDisplay::Style style, const std::vector<Progress>& steps,
                  const std::string& event = {}) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  ProgressDisplay display(out, style);
  for (const Progress& step : steps) display.show(step);
  if (!event.empty()) display.say(event);
  display.finish();
  std::fclose(out);
  std::string result(text, size);
  std::free(text);
  return result;
}

TEST(ProgressLine, IsParsed) {
  const auto progress = parse_progress("@progress 56.2 200 -0.31 1");
  ASSERT_TRUE(progress);
  EXPECT_EQ(progress->t_ms, 56.2);
  EXPECT_EQ(progress->t_end_ms, 200);
  EXPECT_EQ(progress->energy_balance_percent, -0.31);
  EXPECT_TRUE(progress->has_head_contact);
  EXPECT_FALSE(parse_progress("@progress 56.2 200"));
  EXPECT_FALSE(parse_progress("anything else"));
}

TEST(EventLine, IsParsed) {
  const auto event = parse_event("@event warning added mass 2.1 %");
  ASSERT_TRUE(event);
  EXPECT_EQ(event->level, "warning");
  EXPECT_EQ(event->text, "added mass 2.1 %");
  EXPECT_EQ(parse_event("@event error")->text, "");
  EXPECT_FALSE(parse_event("@progress 1 2 3 0"));
}

TEST(ProgressText, HasTimePercentClockBalanceAndContact) {
  EXPECT_EQ(progress_text({56.2, 200, 0.314, true}, 41, 105),
            "  56.20 ms of 200 ms   28 %  0:41 elapsed  1:45 left  energy +0.31 %  head contact");
  EXPECT_EQ(progress_text({0, 200, 0, false}, 0, {}),
            "   0.00 ms of 200 ms    0 %  0:00 elapsed  energy +0.00 %");
  EXPECT_EQ(clock_text(3723), "1:02:03");
}

TEST(ProgressDisplay, PlainStyleWritesALinePerTenMilliseconds) {
  std::vector<Progress> steps;
  for (int i = 0; i <= 250; ++i) steps.push_back({0.1 * i, 200, 0, false});
  const std::string text = shown(ProgressDisplay::Style::Plain, steps, "info");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);  // at 0, 10, 20 ms, and the event
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressDisplay, LiveStyleKeepsOneLineBelowTheEvents) {
  const std::string text =
      shown(ProgressDisplay::Style::Live, {{1, 200, 0, false}, {2, 200, 0, false}}, "contact");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_THAT(text, testing::HasSubstr("\r\033[Kcontact\n\r\033[K   2.00 ms"));
}

}  // namespace
}  // namespace crosswalk
