// A drawn chart: curves with labels and units, ready to be written as a static SVG drawing (print,
// no script) or handed to the page script as JSON.
//
// Style (colour-blind safe after Okabe and Ito, and told apart without colour): one dash pattern
// per run; one symbol per component, or per run where there are more runs than dash patterns.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "recorder/report/report.h"

namespace crosswalk::recording {

struct ChartCurve {
  std::string label;
  CurveOrigin origin = CurveOrigin::ThisRun;
  int set = 0;        ///< which run or test: dash pattern
  int component = 0;  ///< which of several curves of one run: colour and symbol
  std::vector<double> x;
  std::vector<double> y;
};

struct Chart {
  std::string id;  ///< stable, for tests and links
  std::string title;
  std::string caption;
  std::string x_label;         ///< with unit, and with what zero means
  std::string y_label;         ///< with unit
  bool is_trajectory = false;  ///< both axes are lengths at one scale; no time marks
  int components = 1;          ///< curves per run
  std::vector<ChartCurve> curves;
  std::vector<TimeMark> marks;  ///< at x of the chart (ms)
};

struct LineStyle {
  std::string colour;
  std::string dash;  ///< SVG stroke-dasharray in px, empty for solid
  double width = 1.6;
  int symbol = -1;  ///< drawn along the curve; -1 for none
};
LineStyle line_style(const Chart& chart, const ChartCurve& curve);

/// Outline of a symbol about a point, SVG path data, and whether it is filled.
struct Symbol {
  std::string path;
  bool is_filled = false;
};
Symbol symbol_at(int symbol, double x, double y);

/// Round axis values covering [low, high]: about `count` of them, steps 1, 2 or 5 times a power of
/// ten.
std::vector<double> axis_ticks(double low, double high, int count);

std::string chart_svg(const Chart& chart);
std::string bar_chart_svg(const BarChart& chart);

/// Curves as base64 float32, with the styles.
nlohmann::ordered_json chart_json(const Chart& chart);

std::string html_escaped(const std::string& text);

}  // namespace crosswalk::recording
