#include "recorder/report/report.h"

#include <regex>

#include <gtest/gtest.h>

#include "tests/recorder/report/synthetic_run.h"

namespace crosswalk::recording {
namespace {

/// A page is too long to be printed by a failing matcher.
bool holds(const std::string& page, const std::string& part) {
  return page.find(part) != std::string::npos;
}

ReportInput small_input() {
  ReportInput input = synthetic::report_input();
  input.scene = Scene{};
  input.curves.resize(1);
  return input;
}

TEST(Report, VerdictComesBeforeTheCharts) {
  const std::string page = render_report(small_input());
  EXPECT_LT(page.find("Head contact time"), page.find("<svg class='chart'"));
  EXPECT_TRUE(holds(page, "1412"));
  EXPECT_TRUE(holds(page, "outside"));
}

TEST(Report, FetchesNothing) {
  const std::string page = render_report(small_input());
  const std::regex link(R"((src|href)\s*=\s*["']?(https?:)?//|@import|url\(\s*["']?http)");
  EXPECT_FALSE(std::regex_search(page.substr(0, page.find("<script>")), link));
}

TEST(Report, TextOfTheUserIsEscaped) {
  const std::string page = render_report(small_input());
  EXPECT_TRUE(holds(page, "&lt;of the pane&apos;s mass&gt;"));
  EXPECT_FALSE(holds(page, "<of the pane"));
}

TEST(Report, SectionsWithoutContentAreLeftOut) {
  ReportInput input;
  input.title = "empty";
  const std::string page = render_report(input);
  for (const char* id : {"curves", "pictures", "playback", "brain", "estimates", "comparison"}) {
    EXPECT_FALSE(holds(page, std::string("id=\"") + id + "\"")) << id;
  }
  EXPECT_TRUE(holds(page, "id=\"verdict\""));
}

TEST(Report, JsonCannotEndItsScriptElement) {
  ReportInput input = small_input();
  input.curves.front().label = "</script><b>";
  const std::string page = render_report(input);
  EXPECT_FALSE(holds(page, "</script><b>"));
}

}  // namespace
}  // namespace crosswalk::recording
