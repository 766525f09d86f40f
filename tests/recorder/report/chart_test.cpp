#include "recorder/report/chart.h"

#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recorder/report/brain_map.h"
#include "recorder/report/channel_charts.h"
#include "tests/recorder/report/synthetic_run.h"

namespace crosswalk::recording {
namespace {

using testing::HasSubstr;
using testing::Not;

const Chart& chart_of(const std::vector<ChartGroup>& groups, const std::string& id) {
  for (const ChartGroup& group : groups) {
    for (const Chart& chart : group.charts) {
      if (chart.id == id) return chart;
    }
  }
  throw std::out_of_range(id);
}

std::vector<ChartGroup> three_sets() {
  return channel_charts({synthetic::curves("a", CurveOrigin::ThisRun, 0),
                         synthetic::curves("b", CurveOrigin::OtherRun, 0.004),
                         synthetic::curves("c", CurveOrigin::Reference, 0)},
                        {{0.118, "head contact"}}, "first leg contact");
}

TEST(AxisTicks, StepsAreOneTwoOrFive) {
  EXPECT_THAT(axis_ticks(0, 200, 7), testing::ElementsAre(0, 50, 100, 150, 200));
  EXPECT_THAT(axis_ticks(-0.3, 0.3, 5),
              testing::SizeIs(testing::AllOf(testing::Ge(3), testing::Le(7))));
  EXPECT_THAT(axis_ticks(1, 1, 5), testing::ElementsAre(1));
}

TEST(ChannelCharts, PanelsOfFigure6AreThereWithUnitsAndTimeZero) {
  const auto groups = three_sets();
  for (const char* id : {"head_x", "head_y", "head_z", "head_speed", "head_acceleration"}) {
    const Chart& chart = chart_of(groups, id);
    EXPECT_EQ(chart.curves.size(), 3U) << id;
    EXPECT_THAT(chart.x_label, HasSubstr("[ms]"));
    EXPECT_THAT(chart.x_label, HasSubstr("first leg contact"));
    EXPECT_THAT(chart.y_label, HasSubstr("[")) << id;
  }
  EXPECT_THAT(chart_of(groups, "head_trajectory").y_label, HasSubstr("[mm]"));
}

TEST(ChannelCharts, AccelerationIsShownInStandardGravity) {
  const auto groups = three_sets();
  const ChartCurve& curve = chart_of(groups, "head_acceleration").curves.front();
  const Signal si = synthetic::curves("a", CurveOrigin::ThisRun, 0).signals[4];
  ASSERT_EQ(si.name, "head_acceleration_resultant");
  EXPECT_DOUBLE_EQ(curve.y[600], si.y[600] / 9.80665);
  EXPECT_DOUBLE_EQ(curve.x[600], 1e3 * si.t[600]);
}

TEST(ChannelCharts, ChannelsWithoutAPlaceComeLastAndFolded) {
  const ChartGroup last = three_sets().back();
  EXPECT_TRUE(last.is_folded);
  EXPECT_EQ(last.charts.size(), 2U);
}

TEST(Chart, RunsDifferInDashSoThatGreyPrintsTellThemApart) {
  const auto groups = three_sets();
  const Chart& chart = chart_of(groups, "head_y");
  const LineStyle run = line_style(chart, chart.curves[0]);
  const LineStyle other = line_style(chart, chart.curves[1]);
  const LineStyle reference = line_style(chart, chart.curves[2]);
  EXPECT_NE(run.dash, other.dash);
  EXPECT_NE(run.dash, reference.dash);
  EXPECT_NE(other.dash, reference.dash);
  EXPECT_NE(run.colour, other.colour);
}

/// Components share the dash pattern of their run: symbols tell them apart.
TEST(Chart, ComponentsDifferInTheirSymbol) {
  const auto groups = three_sets();
  const Chart& chart = chart_of(groups, "head_rotation");
  std::set<std::pair<std::string, int>> seen;
  for (const ChartCurve& curve : chart.curves) {
    const LineStyle style = line_style(chart, curve);
    EXPECT_TRUE(seen.insert({style.dash, style.symbol}).second) << curve.label;
  }
  const std::string path = symbol_at(1, 100, 50).path;
  EXPECT_EQ(path, "M96.8 46.8h6.4v6.4h-6.4z");
  EXPECT_NE(symbol_at(0, 0, 0).is_filled, symbol_at(4, 0, 0).is_filled);
}

TEST(Chart, CurvesOfSeveralTestsDifferInTheirSymbol) {
  const std::vector<CurveSet> sets{synthetic::curves("run", CurveOrigin::ThisRun, 0),
                                   synthetic::curves("test a", CurveOrigin::Reference, 0),
                                   synthetic::curves("test b", CurveOrigin::Reference, 0)};
  const auto groups = channel_charts(sets, {}, "first leg contact");
  const Chart& chart = chart_of(groups, "head_y");
  EXPECT_NE(line_style(chart, chart.curves[1]).symbol, line_style(chart, chart.curves[2]).symbol);
}

TEST(Chart, MoreRunsThanDashPatternsDifferInTheirSymbol) {
  std::vector<CurveSet> sets;
  for (int i = 0; i < 8; ++i)
    sets.push_back(synthetic::curves(std::to_string(i), CurveOrigin::OtherRun, 0));
  const auto groups = channel_charts(sets, {}, "first leg contact");
  const Chart& chart = chart_of(groups, "head_y");
  std::set<int> symbols;
  for (const ChartCurve& curve : chart.curves) symbols.insert(line_style(chart, curve).symbol);
  EXPECT_EQ(symbols.size(), 8U);
  EXPECT_THAT(chart_svg(chart), HasSubstr("stroke-width='1.2'"));
}

TEST(ChartSvg, MissingSamplesBreakTheLine) {
  Chart chart;
  chart.curves.push_back(
      {"a", CurveOrigin::ThisRun, 0, 0, {0, 1, 2, 3, 4}, {1, 2, std::nan(""), 2, 1}});
  const std::string svg = chart_svg(chart);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const std::size_t path = svg.find("<path d='");
  const std::string d = svg.substr(path, svg.find('\'', path + 9) - path);
  EXPECT_EQ(std::count(d.begin(), d.end(), 'M'), 2);
}

TEST(ChartSvg, PeakOfOneSampleSurvivesThinning) {
  Chart chart;
  ChartCurve curve{"a", CurveOrigin::ThisRun, 0, 0, {}, {}};
  for (int i = 0; i < 20000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 12345 ? 100.0 : 0.0);
  }
  chart.curves.push_back(curve);
  const std::string svg = chart_svg(chart);
  // Plot area: y from 256 (low) to 30 (high), widened by 6 % of the range on both sides.
  EXPECT_THAT(svg, HasSubstr(" 42.1"));
  EXPECT_LT(svg.size(), 60000U);
}

TEST(StrainColour, LightnessRises) {
  double last = -1;
  for (int i = 0; i <= 20; ++i) {
    const Rgb c = strain_colour(i / 20.0);
    const double grey = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    EXPECT_GT(grey, last);
    last = grey;
  }
}

}  // namespace
}  // namespace crosswalk::recording
