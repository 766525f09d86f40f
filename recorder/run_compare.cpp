#include "recorder/run_compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "recorder/run_report.h"
#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

const std::string& scenario_of(const ComparedRun& run) {
  return run.analysis.summary.manifest.scenario;
}

std::string label_of(const ComparedRun& run) {
  return fmt::format("{} {}", scenario_of(run), mode_of(run.analysis.summary));
}

/// Labels; the folder's name is added where two runs would be called alike.
std::vector<std::string> labels_of(const std::vector<ComparedRun>& runs) {
  std::vector<std::string> labels;
  for (const ComparedRun& run : runs) labels.push_back(label_of(run));
  std::vector<std::string> unique = labels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (std::count(labels.begin(), labels.end(), labels[i]) > 1)
      unique[i] = fmt::format("{} ({})", labels[i], runs[i].name);
  }
  return unique;
}

struct Row {
  const char* label;
  std::function<std::optional<double>(const Summary&)> value;
  const char* form;
};

std::string formatted(const char* form, const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format(fmt::runtime(form), *value) : "–";
}

const std::vector<Row>& result_rows() {
  const auto quantity = [](const char* key) {
    return [key](const Summary& s) { return summary_quantity(s, key); };
  };
  static const std::vector<Row> kRows{
      {"head contact [ms]", quantity("head_contact_time_ms"), "{:.1f}"},
      {"wrap-around distance [mm]", quantity("wrap_around_distance_mm"), "{:.0f}"},
      {"head speed against the car [m/s]", quantity("head_contact_speed_relative_mps"), "{:.2f}"},
      {"peak acceleration [g]", quantity("peak_g"), "{:.1f}"},
      {"HIC15", quantity("HIC15"), "{:.0f}"},
      {"BrIC", quantity("BrIC"), "{:.2f}"},
      {"DAMAGE", quantity("DAMAGE"), "{:.2f}"},
      {"brain strain MPS95",
       [](const Summary& s) {
         return s.tissue.empty() ? std::nullopt : std::optional(s.tissue.front().mps_95_so_far);
       },
       "{:.3f}"},
      {"interface energy drift [%]",
       [](const Summary& s) {
         return s.coupling && s.fe ? std::optional(s.coupling->drift_percent) : std::nullopt;
       },
       "{:.3f}"},
      {"computing time [s]", [](const Summary& s) { return std::optional(s.timing.wall); },
       "{:.0f}"}};
  return kRows;
}

ReportTable result_table(const std::vector<ComparedRun>& runs) {
  ReportTable table{"Results side by side", "", {"quantity"}, {}};
  for (const std::string& label : labels_of(runs)) table.columns.push_back(label);
  for (const Row& row : result_rows()) {
    std::vector<std::string> cells{row.label};
    for (const ComparedRun& run : runs)
      cells.push_back(formatted(row.form, row.value(run.analysis.summary)));
    table.rows.push_back(cells);
  }
  return table;
}

std::optional<double> cora_between(const RunChannels& reference, const RunChannels& simulation,
                                   const RatedSignal& signal) {
  const SignalRating rating =
      rate_against_run({signal}, simulation.channels, reference.channels, {}).front();
  return rating.cora ? std::optional(rating.cora->C) : std::nullopt;
}

/// Scores against the measured curves where there are any, in the layout of the paper's Table 3.
ReportTable test_table(const std::vector<ComparedRun>& runs) {
  ReportTable table{"CORA against the tests",
                    "Total score C, default parameters; a dash where no measured curve is "
                    "available.",
                    {"signal"},
                    {}};
  for (const std::string& label : labels_of(runs)) table.columns.push_back(label);
  table.columns.push_back("mean ± population deviation");
  for (const RatedSignal& signal : rating_set({})) {
    std::vector<std::string> cells{signal.label};
    std::vector<double> scores;
    for (const ComparedRun& run : runs) {
      std::optional<double> score;
      for (const SignalRating& r : run.analysis.summary.ratings) {
        if (r.signal.channel == signal.channel && r.cora) score = r.cora->C;
      }
      if (score) scores.push_back(*score);
      cells.push_back(formatted("{:.3f}", score));
    }
    const MeanDeviation all = mean_deviation(scores);
    cells.push_back(scores.empty() ? "–" : fmt::format("{:.3f} ± {:.3f}", all.mean, all.deviation));
    table.rows.push_back(cells);
  }
  return table;
}

/// Index of the first run of the same scenario.
std::size_t first_of_scenario(const std::vector<ComparedRun>& runs, std::size_t i) {
  for (std::size_t k = 0; k < i; ++k) {
    if (scenario_of(runs[k]) == scenario_of(runs[i])) return k;
  }
  return i;
}

ReportTable mutual_table(const std::vector<ComparedRun>& runs) {
  ReportTable table{"CORA of the runs against each other",
                    "Each run against the first run of its scenario; 1 means equal curves. This is "
                    "no validation.",
                    {"signal"},
                    {}};
  const std::vector<std::string> labels = labels_of(runs);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t k = first_of_scenario(runs, i);
    if (k == i) continue;
    pairs.emplace_back(k, i);
    table.columns.push_back(fmt::format("{} against {}", labels[i], labels[k]));
  }
  if (pairs.empty()) return table;
  for (const RatedSignal& signal : rating_set({})) {
    std::vector<std::string> cells{signal.label};
    for (const auto& [k, i] : pairs) {
      cells.push_back(formatted(
          "{:.3f}", cora_between(runs[k].analysis.channels, runs[i].analysis.channels, signal)));
    }
    table.rows.push_back(cells);
  }
  return table;
}

std::vector<std::string> distinct(const std::vector<ComparedRun>& runs,
                                  const std::function<std::string(const ComparedRun&)>& key) {
  std::vector<std::string> out;
  for (const ComparedRun& run : runs) {
    if (std::find(out.begin(), out.end(), key(run)) == out.end()) out.push_back(key(run));
  }
  return out;
}

/// One bar per model in each test; the last run of a kind stands when there are several.
BarChart bar_chart(const std::vector<ComparedRun>& runs, const char* title, const char* unit,
                   const char* quantity) {
  BarChart chart{title,
                 unit,
                 distinct(runs, scenario_of),
                 distinct(runs, [](const ComparedRun& r) { return mode_of(r.analysis.summary); }),
                 {}};
  chart.values.assign(chart.groups.size(), std::vector<double>(chart.labels.size(), kNoValue));
  for (const ComparedRun& run : runs) {
    const auto at = [](const std::vector<std::string>& list, const std::string& text) {
      return static_cast<std::size_t>(std::find(list.begin(), list.end(), text) - list.begin());
    };
    const auto value = summary_quantity(run.analysis.summary, quantity);
    chart.values[at(chart.groups, scenario_of(run))]
                [at(chart.labels, mode_of(run.analysis.summary))] = value.value_or(kNoValue);
  }
  return chart;
}

std::vector<ReportTable> tables_of(const std::vector<ComparedRun>& runs) {
  std::vector<ReportTable> tables{result_table(runs)};
  const bool has_ratings = std::any_of(runs.begin(), runs.end(), [](const ComparedRun& run) {
    return !run.analysis.summary.ratings.empty();
  });
  if (has_ratings) tables.push_back(test_table(runs));
  ReportTable mutual = mutual_table(runs);
  if (!mutual.rows.empty()) tables.push_back(std::move(mutual));
  return tables;
}

}  // namespace

ReportInput comparison_input(const std::vector<ComparedRun>& runs) {
  const std::vector<std::string> labels = labels_of(runs);
  ReportInput input;
  input.title = fmt::format("Comparison of {} runs", runs.size());
  for (const std::string& label : labels)
    input.subtitle += (input.subtitle.empty() ? "" : " · ") + label;
  input.story =
      "The same quantities of every run side by side; curves overlaid on the time after "
      "first leg contact of each.";
  input.bars = {bar_chart(runs, "HIC15", "–", "HIC15"),
                bar_chart(runs, "Head contact time", "ms", "head_contact_time_ms")};
  input.tables = tables_of(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Summary& s = runs[i].analysis.summary;
    input.curves.push_back(curve_set(runs[i].analysis.channels, labels[i],
                                     i == 0 ? CurveOrigin::ThisRun : CurveOrigin::OtherRun));
    for (const std::string& warning : s.warnings)
      input.warnings.push_back(labels[i] + ": " + warning);
    input.provenance.emplace_back(labels[i], runs[i].name + ", run id " + s.manifest.run_id);
  }
  input.scene = runs.front().scene;
  const auto& contact = runs.front().analysis.summary.head_contact;
  if (contact) input.marks.push_back({contact->time, "head contact"});
  return input;
}

std::string comparison_text(const std::vector<ComparedRun>& runs) {
  std::string out;
  for (const ReportTable& table : tables_of(runs)) {
    std::vector<std::size_t> widths;
    const auto widen = [&widths](const std::vector<std::string>& cells) {
      widths.resize(std::max(widths.size(), cells.size()));
      for (std::size_t i = 0; i < cells.size(); ++i)
        widths[i] = std::max(widths[i], cells[i].size());
    };
    widen(table.columns);
    for (const auto& row : table.rows) widen(row);
    const auto line = [&widths](const std::vector<std::string>& cells) {
      std::string text = fmt::format("  {:<{}}", cells[0], widths[0]);
      for (std::size_t i = 1; i < cells.size(); ++i)
        text += fmt::format("  {:>{}}", cells[i], widths[i]);
      return text + "\n";
    };
    out += table.title + "\n" + line(table.columns);
    for (const auto& row : table.rows) out += line(row);
    out += "\n";
  }
  return out;
}

}  // namespace crosswalk::recording
