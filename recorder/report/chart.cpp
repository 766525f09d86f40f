#include "recorder/report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/report/image.h"

namespace crosswalk::recording {
namespace {

// Okabe and Ito's palette (Color Universal Design, 2008) in an order of falling contrast.
constexpr std::array<const char*, 6> kSetColours{"#0072b2", "#d55e00", "#009e73",
                                                 "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<const char*, 4> kDashes{"", "7 3", "10 3 2 3", "2 2"};
constexpr std::array<const char*, 6> kComponentColours{"#0b3c5d", "#d55e00", "#56b4e9",
                                                       "#009e73", "#cc79a7", "#8a8a8a"};
constexpr const char* kReferenceColour = "#222222";
constexpr const char* kReferenceDash = "1.5 3";

std::string base64_floats(const std::vector<double>& values) {
  std::vector<float> narrow(values.size());
  std::transform(values.begin(), values.end(), narrow.begin(),
                 [](double v) { return static_cast<float>(v); });
  return base64(narrow.data(), narrow.size() * sizeof(float));
}

/// Sets whose lines look alike: curves of several tests.
bool has_several_references(const Chart& chart) {
  int set = -1;
  for (const ChartCurve& curve : chart.curves) {
    if (curve.origin != CurveOrigin::Reference) continue;
    if (set >= 0 && curve.set != set) return true;
    set = curve.set;
  }
  return false;
}

int set_count(const Chart& chart) {
  int count = 0;
  for (const ChartCurve& curve : chart.curves) count = std::max(count, curve.set + 1);
  return count;
}

}  // namespace

LineStyle line_style(const Chart& chart, const ChartCurve& curve) {
  LineStyle style;
  const auto wrapped = [](const auto& list, int i) {
    return list[static_cast<std::size_t>(i) % list.size()];
  };
  if (chart.components > 1) {
    style.colour = wrapped(kComponentColours, curve.component);
  } else {
    style.colour = wrapped(kSetColours, curve.set);
  }
  style.dash = wrapped(kDashes, curve.set);
  if (curve.origin == CurveOrigin::Reference) {
    if (chart.components == 1) style.colour = kReferenceColour;
    style.dash = kReferenceDash;
  }
  if (curve.set == 0) style.width = 2.0;
  if (chart.components > 1) {
    style.symbol = curve.component;
  } else if (set_count(chart) > static_cast<int>(kDashes.size()) || has_several_references(chart)) {
    style.symbol = curve.set;
  }
  return style;
}

Symbol symbol_at(int symbol, double x, double y) {
  constexpr double kHalf = 3.2;  // px
  constexpr int kShapes = 4;     // circle, square, triangle, diamond; open, then filled
  Symbol out;
  out.is_filled = symbol / kShapes % 2 == 1;
  const double r = kHalf;
  switch (symbol % kShapes) {
    case 0:
      out.path = fmt::format("M{0:.1f} {1:.1f}a{2} {2} 0 1 0 {3} 0a{2} {2} 0 1 0 -{3} 0z", x - r, y,
                             r, 2 * r);
      break;
    case 1:
      out.path = fmt::format("M{:.1f} {:.1f}h{}v{}h-{}z", x - r, y - r, 2 * r, 2 * r, 2 * r);
      break;
    case 2:
      out.path =
          fmt::format("M{:.1f} {:.1f}l{} {}h-{}z", x, y - 1.2 * r, 1.2 * r, 2.1 * r, 2.4 * r);
      break;
    default:
      out.path = fmt::format("M{:.1f} {:.1f}l{} {}l-{} {}l-{} -{}z", x, y - 1.3 * r, 1.3 * r,
                             1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r);
  }
  return out;
}

std::vector<double> axis_ticks(double low, double high, int count) {
  if (!(high > low)) return {low};
  const double raw = (high - low) / std::max(1, count);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  const auto first = static_cast<long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long>(std::floor(high / step + 1e-9));
  for (long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

nlohmann::ordered_json chart_json(const Chart& chart) {
  nlohmann::ordered_json out;
  out["id"] = chart.id;
  out["x_label"] = chart.x_label;
  out["y_label"] = chart.y_label;
  out["trajectory"] = chart.is_trajectory;
  out["marks"] = nlohmann::json::array();
  for (const TimeMark& mark : chart.marks) {
    out["marks"].push_back({{"x", mark.t}, {"label", mark.label}});
  }
  out["curves"] = nlohmann::json::array();
  for (const ChartCurve& curve : chart.curves) {
    const LineStyle style = line_style(chart, curve);
    out["curves"].push_back({{"label", curve.label},
                             {"colour", style.colour},
                             {"dash", style.dash},
                             {"width", style.width},
                             {"symbol", style.symbol},
                             {"x", base64_floats(curve.x)},
                             {"y", base64_floats(curve.y)}});
  }
  return out;
}

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace crosswalk::recording
