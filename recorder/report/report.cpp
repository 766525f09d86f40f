#include "recorder/report/report.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "recorder/report/assets.h"
#include "recorder/report/brain_map.h"
#include "recorder/report/channel_charts.h"
#include "recorder/report/frames.h"
#include "recorder/report/scene_json.h"

namespace crosswalk::recording {
namespace {

using kainjow::mustache::data;

constexpr int kStillHeight = 340;  // px
constexpr int kCoverHeight = 520;  // px

data list() { return data(data::type::list); }
data object() { return data(data::type::object); }

void set_text(data& target, const std::string& key, const std::string& text) {
  if (!text.empty()) target.set(key, text);
}

data texts(const std::vector<std::string>& lines) {
  data out = list();
  for (const std::string& line : lines) out.push_back(line);
  return out;
}

struct Reading {
  const char* style;
  const char* symbol;
  const char* text;
};
Reading reading(Verdict verdict) {
  switch (verdict) {
    case Verdict::Good:
      return {"good", "✓", "within"};
    case Verdict::Attention:
      return {"attention", "▲", "look at it"};
    case Verdict::Bad:
      return {"bad", "✕", "outside"};
    case Verdict::Info:
      break;
  }
  return {"info", "–", "no limit"};
}

data verdict_groups(const std::vector<VerdictRow>& rows) {
  std::vector<std::string> order;
  for (const VerdictRow& row : rows) {
    if (std::find(order.begin(), order.end(), row.group) == order.end()) order.push_back(row.group);
  }
  data groups = list();
  for (const std::string& name : order) {
    data lines = list();
    for (const VerdictRow& row : rows) {
      if (row.group != name) continue;
      const Reading read = reading(row.status);
      data line = object();
      line.set("label", row.label);
      line.set("value", row.value);
      line.set("unit", row.unit);
      line.set("band", row.band);
      line.set("status", read.style);
      line.set("symbol", read.symbol);
      line.set("reading", row.reading.empty() ? read.text : row.reading);
      set_text(line, "note", row.note);
      lines.push_back(line);
    }
    data group = object();
    group.set("group", name);
    group.set("rows", lines);
    groups.push_back(group);
  }
  return groups;
}

data chart_groups(const std::vector<ChartGroup>& groups) {
  data out = list();
  for (const ChartGroup& group : groups) {
    data charts = list();
    for (const Chart& chart : group.charts) {
      data entry = object();
      entry.set("id", chart.id);
      entry.set("title", chart.title);
      set_text(entry, "caption", chart.caption);
      entry.set("svg", chart_svg(chart));
      charts.push_back(entry);
    }
    data entry = object();
    entry.set("title", group.title);
    entry.set("is_folded", data(group.is_folded));
    entry.set("count", std::to_string(group.charts.size()));
    entry.set("charts", charts);
    out.push_back(entry);
  }
  return out;
}

std::string milliseconds(double t) { return fmt::format("{:.0f} ms", 1e3 * t); }

data still_views(const Scene& scene, const std::vector<double>& times) {
  data views = list();
  for (const StillView view : {StillView::Posterior, StillView::Superior}) {
    const Framing part = framing(scene, view, times);
    data stills = list();
    for (const double t : times) {
      data still = object();
      still.set("image", data_url(render_still(scene, view, t, part, kStillHeight)));
      still.set("label", milliseconds(t));
      still.set("alt", fmt::format("{} view at {}", view_name(view), milliseconds(t)));
      stills.push_back(still);
    }
    data entry = object();
    entry.set("title", view == StillView::Posterior ? "Posterior view (from behind the pedestrian)"
                                                    : "Superior view (from above)");
    entry.set("stills", stills);
    views.push_back(entry);
  }
  return views;
}

/// The picture beside the verdict: head contact, or else the middle of the run.
data cover(const ReportInput& input) {
  const Scene& scene = input.scene;
  double t = 0.5 * (scene.frames.front().t + scene.frames.back().t);
  std::string caption = fmt::format("The run at {}", milliseconds(t));
  for (const TimeMark& mark : input.marks) {
    if (mark.label != "head contact") continue;
    t = mark.t;
    caption = fmt::format("Head contact, {} after {}", milliseconds(t), input.time_zero);
  }
  const Framing part = framing(scene, StillView::Posterior, {0.0, t});
  data out = object();
  out.set("image", data_url(render_still(scene, StillView::Posterior, t, part, kCoverHeight)));
  out.set("caption", caption);
  return out;
}

data tissue(const TissuePeak& peak) {
  double largest = 1e-12;
  for (const TissueRegion& region : peak.regions) largest = std::max(largest, region.mps_95);
  data regions = list();
  for (const TissueRegion& r : peak.regions) {
    data entry = object();
    entry.set("name", r.name);
    entry.set("mps_95", fmt::format("{:.3f}", r.mps_95));
    entry.set("mps_max", fmt::format("{:.3f}", r.mps_max));
    entry.set("csdm_15", fmt::format("{:.1f}\u00a0%", 100 * r.csdm_15));
    entry.set("csdm_25", fmt::format("{:.1f}\u00a0%", 100 * r.csdm_25));
    entry.set("pressure",
              fmt::format("{:.0f}, {:.0f}", 1e-3 * r.pressure_min, 1e-3 * r.pressure_max));
    entry.set("von_mises", fmt::format("{:.1f}", 1e-3 * r.von_mises_95));
    entry.set("share", fmt::format("{:.0f}", 100 * r.mps_95 / largest));
    entry.set("colour", css_colour(strain_colour(r.mps_95 / largest)));
    regions.push_back(entry);
  }
  data out = object();
  out.set("time", fmt::format("{:.1f}", 1e3 * peak.t));
  out.set("regions", regions);
  out.set("map", peak.map ? brain_map_html(*peak.map) : "");
  return out;
}

data tables(const std::vector<ReportTable>& all) {
  data out = list();
  for (const ReportTable& table : all) {
    data rows = list();
    for (const auto& cells : table.rows) {
      data row = object();
      row.set("cells", texts(cells));
      rows.push_back(row);
    }
    data entry = object();
    entry.set("title", table.title);
    set_text(entry, "caption", table.caption);
    entry.set("columns", texts(table.columns));
    entry.set("rows", rows);
    out.push_back(entry);
  }
  return out;
}

data bars(const std::vector<BarChart>& all) {
  data out = list();
  for (const BarChart& chart : all) {
    data entry = object();
    entry.set("title", chart.title);
    entry.set("svg", bar_chart_svg(chart));
    out.push_back(entry);
  }
  return out;
}

/// JSON inside a script element: "</" would end it.
std::string script_safe(std::string text) {
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) {
    text.replace(at, 2, "<\\/");
  }
  return text;
}

std::string page_data(const std::vector<ChartGroup>& groups, const Scene& scene) {
  nlohmann::ordered_json out;
  out["charts"] = nlohmann::json::array();
  for (const ChartGroup& group : groups) {
    for (const Chart& chart : group.charts) out["charts"].push_back(chart_json(chart));
  }
  if (!scene.empty()) out["scene"] = scene_json(scene);
  return script_safe(out.dump());
}

void add_section(data& sections, bool is_there, const char* id, const char* name) {
  if (!is_there) return;
  data entry = object();
  entry.set("id", id);
  entry.set("name", name);
  sections.push_back(entry);
}

data section_links(const ReportInput& input, bool has_charts) {
  data sections = list();
  add_section(sections, !input.verdict.empty(), "verdict", "Verdict");
  add_section(sections, !input.bars.empty(), "comparison", "Comparison");
  add_section(sections, !input.tables.empty(), "tables", "Scores");
  add_section(sections, has_charts, "curves", "Curves");
  add_section(sections, !input.scene.empty(), "pictures", "Pictures");
  add_section(sections, !input.scene.empty() && report_is_interactive(), "playback", "Playback");
  add_section(sections, input.tissue.has_value(), "brain", "Brain strain");
  add_section(sections, !input.estimates.empty(), "estimates", "Estimates");
  add_section(sections, !input.provenance.empty(), "provenance", "Provenance");
  return sections;
}

void set_verdict(data& page, const ReportInput& input) {
  page.set("title", input.title);
  set_text(page, "subtitle", input.subtitle);
  set_text(page, "story", input.story);
  page.set("has_warnings", data(!input.warnings.empty()));
  page.set("warning_count", input.warnings.size() == 1
                                ? "1 warning"
                                : fmt::format("{} warnings", input.warnings.size()));
  page.set("warnings", texts(input.warnings));
  page.set("has_verdict", data(!input.verdict.empty()));
  page.set("verdict_groups", verdict_groups(input.verdict));
  if (!input.scene.empty()) page.set("cover", cover(input));
}

void set_annexes(data& page, const ReportInput& input) {
  if (input.tissue) page.set("tissue", tissue(*input.tissue));
  page.set("has_estimates", data(!input.estimates.empty()));
  data estimates = list();
  for (const Estimate& e : input.estimates) {
    data entry = object();
    entry.set("item", e.item);
    entry.set("value", e.value);
    entry.set("basis", e.basis);
    estimates.push_back(entry);
  }
  page.set("estimates", estimates);
  page.set("has_provenance", data(!input.provenance.empty()));
  data provenance = list();
  for (const auto& [key, value] : input.provenance) {
    data entry = object();
    entry.set("key", key);
    entry.set("value", value);
    provenance.push_back(entry);
  }
  page.set("provenance", provenance);
}

}  // namespace

bool report_is_interactive() { return !assets::page_script.empty(); }

std::string render_report(const ReportInput& input) {
  const std::vector<ChartGroup> groups = channel_charts(input.curves, input.marks, input.time_zero);
  data page = object();
  page.set("style", std::string(assets::report_style));
  page.set("script_style", std::string(assets::page_script_style));
  set_verdict(page, input);
  page.set("sections", section_links(input, !groups.empty()));
  page.set("has_bars", data(!input.bars.empty()));
  page.set("bars", bars(input.bars));
  page.set("has_tables", data(!input.tables.empty()));
  page.set("tables", tables(input.tables));
  page.set("has_charts", data(!groups.empty()));
  page.set("time_zero", input.time_zero);
  page.set("chart_groups", chart_groups(groups));
  page.set("has_stills", data(!input.scene.empty()));
  page.set("has_scene", data(!input.scene.empty()));
  page.set("has_surface", data(input.scene.head.has_value()));
  if (!input.scene.empty()) {
    page.set("still_views",
             still_views(input.scene, input.still_times.empty() ? default_still_times(input.scene)
                                                                : input.still_times));
  }
  page.set("is_interactive", data(report_is_interactive()));
  if (report_is_interactive()) {
    page.set("data", page_data(groups, input.scene));
    page.set("script", std::string(assets::page_script));
  }
  set_annexes(page, input);
  kainjow::mustache::mustache page_template{std::string(assets::report_template)};
  CW_ASSERT(page_template.is_valid());
  return page_template.render(page);
}

void write_report(const std::filesystem::path& file, const ReportInput& input) {
  std::ofstream stream(file, std::ios::binary);
  stream << render_report(input);
  if (!stream)
    throw UserError(Problem{{file.string()}, "report", "a file that can be written", "", ""});
}

}  // namespace crosswalk::recording
