// Static drawings of charts: the form that prints, and the one shown when scripts are off.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "recorder/report/chart.h"

namespace crosswalk::recording {
namespace {

struct Axis {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double from_px = 0, to_px = 1;

  void include(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  void widen(double share) {
    if (!(low <= high)) {
      low = 0;
      high = 1;
    }
    const double flat = high != 0 ? std::abs(high) : 1;  // of a curve that never changes
    const double span = high > low ? high - low : flat;
    low -= share * span;
    high += share * span;
  }
  double px(double v) const { return from_px + (v - low) / (high - low) * (to_px - from_px); }
};

constexpr double kWidth = 560, kHeight = 300;
constexpr double kLeft = 66, kRight = 12, kTop = 30, kBottom = 44;
constexpr double kLegendKey = 44, kLegendLetter = 6.1, kLegendRow = 16;
constexpr double kSymbolEvery = 84;  // px
constexpr int kColumns = 700;        // at most two points per column survive thinning

std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  if (std::abs(value) < 1e-9 * step) value = 0;
  return fmt::format("{:.{}f}", value, decimals);
}

std::string axes_svg(const Axis& x, const Axis& y, const std::string& x_label,
                     const std::string& y_label) {
  std::string out;
  const std::vector<double> xs = axis_ticks(x.low, x.high, 7);
  const std::vector<double> ys = axis_ticks(y.low, y.high, 5);
  const auto step = [](const std::vector<double>& t) { return t.size() > 1 ? t[1] - t[0] : 1.0; };
  for (const double v : xs) {
    out += fmt::format(
        "<line class='grid' x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}'/>"
        "<text class='tick' x='{0:.1f}' y='{3:.1f}' text-anchor='middle'>{4}</text>",
        x.px(v), y.from_px, y.to_px, y.from_px + 15, tick_text(v, step(xs)));
  }
  for (const double v : ys) {
    out += fmt::format(
        "<line class='{5}' x1='{1:.1f}' x2='{2:.1f}' y1='{0:.1f}' y2='{0:.1f}'/>"
        "<text class='tick' x='{3:.1f}' y='{0:.1f}' dy='4' text-anchor='end'>{4}</text>",
        y.px(v), x.from_px, x.to_px, x.from_px - 6, tick_text(v, step(ys)),
        std::abs(v) < 1e-9 * step(ys) ? "zero" : "grid");
  }
  out += fmt::format("<rect class='frame' x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}'/>",
                     x.from_px, y.to_px, x.to_px - x.from_px, y.from_px - y.to_px);
  out += fmt::format("<text class='axis' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>",
                     0.5 * (x.from_px + x.to_px), y.from_px + 34, html_escaped(x_label));
  out += fmt::format(
      "<text class='axis' transform='translate(14 {:.1f}) rotate(-90)' "
      "text-anchor='middle'>{}</text>",
      0.5 * (y.from_px + y.to_px), html_escaped(y_label));
  return out;
}

/// Keeps the smallest and largest value of every pixel column, in order, so that peaks survive.
std::vector<std::size_t> thinned(const ChartCurve& curve, const Axis& x) {
  std::vector<std::size_t> kept;
  const std::size_t n = std::min(curve.x.size(), curve.y.size());
  if (n <= 2U * kColumns) {
    for (std::size_t i = 0; i < n; ++i) kept.push_back(i);
    return kept;
  }
  const auto column = [&](std::size_t i) {
    return static_cast<long>((curve.x[i] - x.low) / (x.high - x.low) * kColumns);
  };
  for (std::size_t i = 0; i < n;) {
    std::size_t low = i;
    std::size_t high = i;
    std::size_t j = i;
    for (; j < n && column(j) == column(i); ++j) {
      if (curve.y[j] < curve.y[low]) low = j;
      if (curve.y[j] > curve.y[high]) high = j;
    }
    kept.push_back(std::min(low, high));
    if (low != high) kept.push_back(std::max(low, high));
    i = j;
  }
  return kept;
}

std::string symbol_svg(const LineStyle& style, double x, double y) {
  const Symbol symbol = symbol_at(style.symbol, x, y);
  return fmt::format("<path d='{}' fill='{}' stroke='{}' stroke-width='1.2'/>", symbol.path,
                     symbol.is_filled ? style.colour : "#fff", style.colour);
}

/// The curve's symbol every kSymbolEvery px along the way, those of different curves set off.
std::string symbols_svg(const Chart& chart, const ChartCurve& curve,
                        const std::vector<std::size_t>& points, const Axis& x, const Axis& y) {
  const LineStyle style = line_style(chart, curve);
  const auto index = static_cast<double>(&curve - chart.curves.data());
  double due = kSymbolEvery * (index + 0.5) / static_cast<double>(chart.curves.size());
  double way = 0;
  std::optional<double> last_x, last_y;
  std::string out;
  for (const std::size_t i : points) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    const double at_x = x.px(curve.x[i]), at_y = y.px(curve.y[i]);
    // A path in space is as long as it is; over time, only the time counts.
    if (last_x)
      way += chart.is_trajectory ? std::hypot(at_x - *last_x, at_y - *last_y) : at_x - *last_x;
    last_x = at_x;
    last_y = at_y;
    if (way < due) continue;
    out += symbol_svg(style, at_x, at_y);
    due += kSymbolEvery;
  }
  return out;
}

std::string curve_svg(const Chart& chart, const ChartCurve& curve, const Axis& x, const Axis& y) {
  const LineStyle style = line_style(chart, curve);
  std::string path;
  bool pen_down = false;
  std::vector<std::size_t> points;
  if (chart.is_trajectory) {
    const std::size_t stride = std::max<std::size_t>(1, curve.x.size() / 400);
    for (std::size_t i = 0; i < curve.x.size(); i += stride) points.push_back(i);
  } else {
    points = thinned(curve, x);
  }
  for (const std::size_t i : points) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      pen_down = false;
      continue;
    }
    path +=
        fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", x.px(curve.x[i]), y.px(curve.y[i]));
    pen_down = true;
  }
  std::string out = fmt::format(
      "<path d='{}' fill='none' stroke='{}' stroke-width='{}' stroke-linejoin='round'{}/>", path,
      style.colour, style.width,
      style.dash.empty() ? "" : fmt::format(" stroke-dasharray='{}'", style.dash));
  if (style.symbol >= 0) out += symbols_svg(chart, curve, points, x, y);
  return out;
}

/// Where the legend's entries go: as many rows as they need, the drawing grows upwards by the rest.
struct LegendPlaces {
  std::vector<double> x;
  std::vector<int> row;
  int rows = 1;
};

LegendPlaces legend_places(const std::vector<std::string>& labels) {
  LegendPlaces places;
  double x = kLeft;
  for (const std::string& label : labels) {
    const double width = kLegendKey + kLegendLetter * static_cast<double>(label.size());
    if (x > kLeft && x + width > kWidth) {
      x = kLeft;
      ++places.rows;
    }
    places.x.push_back(x);
    places.row.push_back(places.rows - 1);
    x += width;
  }
  return places;
}

std::vector<std::string> labels_of(const Chart& chart) {
  std::vector<std::string> labels;
  for (const ChartCurve& curve : chart.curves) labels.push_back(curve.label);
  return labels;
}

/// The opening of a drawing whose legend has `rows` rows.
std::string svg_begin(const std::string& title, int rows) {
  const double extra = kLegendRow * (rows - 1);
  return fmt::format("<svg class='chart' viewBox='0 {} {} {}' role='img' aria-label='{}'>", -extra,
                     kWidth, kHeight + extra, html_escaped(title));
}

double legend_y(const LegendPlaces& places, std::size_t i) {
  return 12 - kLegendRow * (places.rows - 1 - places.row[i]);
}

std::string legend_svg(const Chart& chart, const LegendPlaces& places) {
  std::string out;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const LineStyle style = line_style(chart, chart.curves[i]);
    const double x = places.x[i];
    const double y = legend_y(places, i);
    out += fmt::format(
        "<line x1='{:.0f}' x2='{:.0f}' y1='{}' y2='{}' stroke='{}' stroke-width='{}'{}/>"
        "<text class='legend' x='{:.0f}' y='{}'>{}</text>",
        x, x + 24, y, y, style.colour, style.width,
        style.dash.empty() ? "" : fmt::format(" stroke-dasharray='{}'", style.dash), x + 28, y + 4,
        html_escaped(chart.curves[i].label));
    if (style.symbol >= 0) out += symbol_svg(style, x + 12, y);
  }
  return out;
}

/// One scale on both axes: the axis with room to spare is widened about its middle.
void equalise(Axis& x, Axis& y) {
  const double scale_x = (x.to_px - x.from_px) / (x.high - x.low);
  const double scale_y = (y.from_px - y.to_px) / (y.high - y.low);
  Axis& spare = scale_x > scale_y ? x : y;
  const double factor = std::max(scale_x, scale_y) / std::min(scale_x, scale_y);
  const double middle = 0.5 * (spare.low + spare.high);
  const double half = 0.5 * (spare.high - spare.low) * factor;
  spare.low = middle - half;
  spare.high = middle + half;
}

/// Three digits, and no more decimals than needed: 1545, 134, 0.971.
std::string bar_text(double value) {
  return std::abs(value) >= 100 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

/// A label under the axis, on two lines when it has two words or more.
std::string group_label_svg(double x, double y, const std::string& label) {
  const std::size_t middle = label.find(' ');
  std::string out;
  for (int line = 0; line < (middle == std::string::npos ? 1 : 2); ++line) {
    const std::string text = line == 0 ? label.substr(0, middle) : label.substr(middle + 1);
    out += fmt::format("<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>", x,
                       y + 13 * line, html_escaped(text));
  }
  return out;
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  Axis x;
  Axis y;
  for (const ChartCurve& curve : chart.curves) {
    for (const double v : curve.x) x.include(v);
    for (const double v : curve.y) y.include(v);
  }
  x.widen(chart.is_trajectory ? 0.04 : 0.0);
  y.widen(0.06);
  x.from_px = kLeft;
  x.to_px = kWidth - kRight;
  y.from_px = kHeight - kBottom;
  y.to_px = kTop;
  if (chart.is_trajectory) equalise(x, y);
  const LegendPlaces legend = legend_places(labels_of(chart));
  std::string out = svg_begin(chart.title, legend.rows);
  out += axes_svg(x, y, chart.x_label, chart.y_label);
  for (const TimeMark& mark : chart.marks) {
    if (mark.t < x.low || mark.t > x.high) continue;
    out += fmt::format(
        "<line class='mark' x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}'/>"
        "<text class='marktext' x='{3:.1f}' y='{4}' text-anchor='{5}'>{6}</text>",
        x.px(mark.t), kTop, kHeight - kBottom,
        x.px(mark.t) + (x.px(mark.t) > 0.6 * kWidth ? -4 : 4), kTop + 12,
        x.px(mark.t) > 0.6 * kWidth ? "end" : "start", html_escaped(mark.label));
  }
  for (auto it = chart.curves.rbegin(); it != chart.curves.rend(); ++it) {
    out += curve_svg(chart, *it, x, y);
  }
  return out + legend_svg(chart, legend) + "</svg>";
}

std::string bar_chart_svg(const BarChart& chart) {
  Axis x;
  Axis y;
  x.low = 0;
  x.high = static_cast<double>(std::max<std::size_t>(1, chart.groups.size()));
  y.include(0);
  for (const auto& group : chart.values) {
    for (const double v : group) y.include(v);
  }
  if (!(y.high > 0)) y.high = 1;
  y.high *= 1.12;
  x.from_px = kLeft;
  x.to_px = kWidth - kRight;
  y.from_px = kHeight - kBottom;
  y.to_px = kTop;
  Chart style;
  style.components = static_cast<int>(chart.labels.size()) + 1;  // apart in grey, as components
  const LegendPlaces legend = legend_places(chart.labels);
  std::string out = svg_begin(chart.title, legend.rows);
  for (const double v : axis_ticks(y.low, y.high, 5)) {
    out += fmt::format(
        "<line class='grid' x1='{1:.1f}' x2='{2:.1f}' y1='{0:.1f}' y2='{0:.1f}'/>"
        "<text class='tick' x='{3:.1f}' y='{0:.1f}' dy='4' text-anchor='end'>{4:g}</text>",
        y.px(v), x.from_px, x.to_px, x.from_px - 6, v);
  }
  const double bar = 0.8 / static_cast<double>(std::max<std::size_t>(1, chart.labels.size()));
  for (std::size_t g = 0; g < chart.groups.size(); ++g) {
    for (std::size_t b = 0; b < chart.labels.size() && b < chart.values[g].size(); ++b) {
      const double v = chart.values[g][b];
      const double left = x.px(static_cast<double>(g) + 0.1 + bar * static_cast<double>(b));
      const double wide = x.px(bar) - x.px(0);
      if (!std::isfinite(v)) continue;
      ChartCurve curve;
      curve.component = static_cast<int>(b);
      out += fmt::format(
          "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}' stroke='#222'/>"
          "<text class='tick' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>",
          left, y.px(v), wide - 2, y.from_px - y.px(v), line_style(style, curve).colour,
          left + 0.5 * wide, y.px(v) - 4, bar_text(v));
    }
    out += group_label_svg(x.px(static_cast<double>(g) + 0.5), y.from_px + 16, chart.groups[g]);
  }
  for (std::size_t b = 0; b < chart.labels.size(); ++b) {
    ChartCurve curve;
    curve.component = static_cast<int>(b);
    out += fmt::format(
        "<rect x='{:.0f}' y='{}' width='14' height='12' fill='{}' stroke='#222'/>"
        "<text class='legend' x='{:.0f}' y='{}'>{}</text>",
        legend.x[b], legend_y(legend, b) - 7, line_style(style, curve).colour, legend.x[b] + 19,
        legend_y(legend, b) + 4, html_escaped(chart.labels[b]));
  }
  out += fmt::format(
      "<text class='axis' transform='translate(14 {:.1f}) rotate(-90)' "
      "text-anchor='middle'>{}</text>",
      0.5 * (y.from_px + y.to_px), html_escaped(chart.axis));
  return out + "</svg>";
}

}  // namespace crosswalk::recording
