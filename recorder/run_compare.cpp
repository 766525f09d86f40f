#include "recorder/run_compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "recorder/path_gap.h"
#include "recorder/run_report.h"
#include "recorder/run_tables.h"
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

std::vector<std::string> distinct(const std::vector<ComparedRun>& runs,
                                  const std::function<std::string(const ComparedRun&)>& key) {
  std::vector<std::string> out;
  for (const ComparedRun& run : runs) {
    if (std::find(out.begin(), out.end(), key(run)) == out.end()) out.push_back(key(run));
  }
  return out;
}

/// A column of CORA scores: one per signal of the set, and what they were rated against.
struct ScoreColumn {
  std::string label;
  std::string kind;  ///< columns of one kind share a mean
  std::vector<SignalRating> ratings;
};

/// Every run against the measured curves of its test; runs without curves have no column.
std::vector<ScoreColumn> test_columns(const std::vector<ComparedRun>& runs,
                                      const ComparisonSettings& settings) {
  const std::vector<std::string> labels = labels_of(runs);
  std::vector<ScoreColumn> columns;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto reference = reference_data(scenario_of(runs[i]));
    if (!reference || reference->curves.empty()) continue;
    columns.push_back({labels[i], mode_of(runs[i].analysis.summary),
                       rate_against_curves(settings.set, runs[i].analysis.channels.channels,
                                           reference->curves, settings.parameters)});
  }
  return columns;
}

/// Every run against the first run of its scenario.
std::vector<ScoreColumn> mutual_columns(const std::vector<ComparedRun>& runs,
                                        const ComparisonSettings& settings) {
  const std::vector<std::string> labels = labels_of(runs);
  std::vector<ScoreColumn> columns;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto first = std::find_if(runs.begin(), runs.end(), [&](const ComparedRun& run) {
      return scenario_of(run) == scenario_of(runs[i]);
    });
    const auto k = static_cast<std::size_t>(first - runs.begin());
    if (k == i) continue;
    columns.push_back(
        {fmt::format("{} against {}", labels[i], labels[k]), "all",
         rate_against_run(settings.set, runs[i].analysis.channels.channels,
                          first->analysis.channels.channels, labels[k], settings.parameters)});
  }
  return columns;
}

std::optional<double> score_of(const ScoreColumn& column, const RatedSignal& signal) {
  for (const SignalRating& r : column.ratings) {
    if (r.signal.channel == signal.channel && r.cora) return r.cora->C;
  }
  return std::nullopt;
}

/// Scores of one row over the columns, then the mean of every kind that has several.
std::vector<std::string> score_cells(const std::vector<ScoreColumn>& columns,
                                     const std::vector<std::string>& kinds,
                                     const std::vector<std::optional<double>>& scores) {
  std::vector<std::string> cells;
  for (const auto& score : scores) cells.push_back(formatted("{:.3f}", score));
  for (const std::string& kind : kinds) {
    std::vector<double> known;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].kind == kind && scores[i]) known.push_back(*scores[i]);
    }
    const MeanDeviation all = mean_deviation(known);
    cells.push_back(known.empty() ? "–" : fmt::format("{:.3f} ± {:.3f}", all.mean, all.deviation));
  }
  return cells;
}

/// In the layout of the published table: a row per signal, a column per run, then the means.
ReportTable score_table(const std::vector<ScoreColumn>& columns, const ComparisonSettings& settings,
                        const char* title, const std::string& caption) {
  ReportTable table{title, caption, {"signal"}, {}};
  std::vector<std::string> kinds;
  for (const ScoreColumn& column : columns) {
    table.columns.push_back(column.label);
    const auto like = [&column](const ScoreColumn& c) { return c.kind == column.kind; };
    if (std::count_if(columns.begin(), columns.end(), like) > 1 &&
        std::find(kinds.begin(), kinds.end(), column.kind) == kinds.end())
      kinds.push_back(column.kind);
  }
  for (const std::string& kind : kinds)
    table.columns.push_back(fmt::format("{}: mean ± deviation", kind));
  for (const RatedSignal& signal : settings.set) {
    std::vector<std::optional<double>> scores;
    for (const ScoreColumn& column : columns) scores.push_back(score_of(column, signal));
    table.rows.push_back(score_cells(columns, kinds, scores));
    table.rows.back().insert(table.rows.back().begin(),
                             signal.weight == 1
                                 ? signal.label
                                 : fmt::format("{} (weight {:g})", signal.label, signal.weight));
  }
  std::vector<std::optional<double>> means;
  for (const ScoreColumn& column : columns)
    means.push_back(weighted_mean(column.ratings, RatingMethod::Cora));
  table.rows.push_back(score_cells(columns, kinds, means));
  table.rows.back().insert(table.rows.back().begin(), "weighted mean of the signals");
  return table;
}

/// A group of bars per signal, a bar per column [yu2020, Figure 7].
BarChart score_bars(const std::vector<ScoreColumn>& columns, const ComparisonSettings& settings,
                    const char* title) {
  BarChart chart{title, "total score C [–]", {}, {}, {}};
  for (const ScoreColumn& column : columns) chart.labels.push_back(column.label);
  for (const RatedSignal& signal : settings.set) {
    chart.groups.push_back(signal.label);
    chart.values.emplace_back();
    for (const ScoreColumn& column : columns)
      chart.values.back().push_back(score_of(column, signal).value_or(kNoValue));
  }
  return chart;
}

/// One bar per model in each test; the last run of a kind stands when there are several.
BarChart bar_chart(const std::vector<ComparedRun>& runs, const char* title, const char* axis,
                   const char* quantity) {
  BarChart chart{title,
                 axis,
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

/// Characters of a UTF-8 text.
std::size_t shown_width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

constexpr const char* kTestTitle = "CORA against the tests";
constexpr const char* kMutualTitle = "CORA of the runs against each other";

/// Head paths of the two modes should agree until something is struck: a neck of other length or
/// place would show here.
ReportTable path_table(const std::vector<ComparedRun>& runs) {
  ReportTable table{"Head paths before head contact",
                    "Distance of the head's centre of mass to that of the first run of the "
                    "scenario, displacements since time zero.",
                    {"runs", "largest distance [mm]", "at [ms]", "compared until [ms]"},
                    {}};
  const std::vector<std::string> labels = labels_of(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::size_t k = 0;  // the first run of the scenario
    while (scenario_of(runs[k]) != scenario_of(runs[i])) ++k;
    if (k == i) continue;
    const std::optional<PathGap> gap = path_gap(runs[k].analysis, runs[i].analysis);
    if (!gap) continue;
    table.rows.push_back(
        {fmt::format("{} against {}", labels[i], labels[k]), fmt::format("{:.1f}", gap->largest_mm),
         fmt::format("{:.1f}", 1e3 * gap->time), fmt::format("{:.1f}", 1e3 * gap->until)});
  }
  return table;
}

/// One model coupled in two ways: what the coupling alone does to the result.
ReportTable coupling_table(const std::vector<ComparedRun>& runs) {
  ReportTable table{
      "Error bar of the coupling",
      "One scenario with two schemes or windows: largest distance of the head's centre of mass "
      "until the head strikes and over the whole run, and change of its peak acceleration. A pane "
      "that cracks enlarges the least difference of any kind: behind its first crack the share of "
      "the coupling shows only in runs whose windshield does not crack.",
      {"runs", "until the head strikes [mm]", "head path [mm]", "at [ms]", "peak acceleration [%]"},
      {}};
  const auto label = [](const ComparedRun& run) {
    const Manifest& m = run.analysis.summary.manifest;
    return fmt::format("{} {:g} us", m.scheme_name(), 1e-3 * static_cast<double>(m.window_ns));
  };
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Summary &a = runs[k].analysis.summary, &b = runs[i].analysis.summary;
      if (scenario_of(runs[k]) != scenario_of(runs[i]) || !a.fe || !b.fe) continue;
      if (label(runs[k]) == label(runs[i])) continue;
      const auto before = path_gap(runs[k].analysis, runs[i].analysis);
      const auto gap = path_gap(runs[k].analysis, runs[i].analysis, PathSpan::Whole);
      const auto peak = summary_quantity(a, "peak_g"), other = summary_quantity(b, "peak_g");
      if (!before || !gap || !peak || !other || !(*peak > 0)) continue;
      table.rows.push_back(
          {fmt::format("{} {} against {}", scenario_of(runs[i]), label(runs[i]), label(runs[k])),
           fmt::format("{:.4f}", before->largest_mm), fmt::format("{:.4f}", gap->largest_mm),
           fmt::format("{:.1f}", 1e3 * gap->time),
           fmt::format("{:.2f}", 100 * std::abs(*other / *peak - 1))});
    }
  return table;
}

std::vector<ReportTable> tables_of(const std::vector<ComparedRun>& runs,
                                   const ComparisonSettings& settings) {
  std::vector<ReportTable> tables{result_table(runs)};
  const std::vector<ScoreColumn> tests = test_columns(runs, settings);
  if (!tests.empty()) {
    tables.push_back(score_table(tests, settings, kTestTitle,
                                 "Total score C; a dash where no measured curve is available. "
                                 "Deviation: of the population, as in [yu2020, Table 3]. " +
                                     parameter_text(settings.parameters.cora) + "."));
  }
  ReportTable paths = path_table(runs);
  if (!paths.rows.empty()) tables.push_back(std::move(paths));
  ReportTable coupling = coupling_table(runs);
  if (!coupling.rows.empty()) tables.push_back(std::move(coupling));
  const std::vector<ScoreColumn> mutual = mutual_columns(runs, settings);
  if (!mutual.empty()) {
    tables.push_back(score_table(mutual, settings, kMutualTitle,
                                 "Total score C of each run against the first run of its scenario; "
                                 "1 means equal curves. This is no validation. " +
                                     parameter_text(settings.parameters.cora) + "."));
  }
  return tables;
}

std::vector<BarChart> bars_of(const std::vector<ComparedRun>& runs,
                              const ComparisonSettings& settings) {
  std::vector<BarChart> bars{
      bar_chart(runs, "HIC15", "HIC15 [–]", "HIC15"),
      bar_chart(runs, "Head contact time", "head contact after time zero [ms]",
                "head_contact_time_ms")};
  const std::vector<ScoreColumn> tests = test_columns(runs, settings);
  if (!tests.empty()) bars.push_back(score_bars(tests, settings, kTestTitle));
  const std::vector<ScoreColumn> mutual = mutual_columns(runs, settings);
  if (!mutual.empty()) bars.push_back(score_bars(mutual, settings, kMutualTitle));
  return bars;
}

}  // namespace

ReportInput comparison_input(const std::vector<ComparedRun>& runs,
                             const ComparisonSettings& settings) {
  const std::vector<std::string> labels = labels_of(runs);
  ReportInput input;
  input.title = fmt::format("Comparison of {} runs", runs.size());
  for (const std::string& label : labels)
    input.subtitle += (input.subtitle.empty() ? "" : " · ") + label;
  const bool is_contact_zero = std::all_of(runs.begin(), runs.end(), [](const ComparedRun& run) {
    return run.analysis.summary.has_first_contact;
  });
  if (!is_contact_zero) input.time_zero = "first leg contact, or start of a run without";
  input.story = fmt::format(
      "The same quantities of every run side by side; curves overlaid on the time after {} of "
      "each.",
      input.time_zero);
  input.bars = bars_of(runs, settings);
  input.tables = tables_of(runs, settings);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Summary& s = runs[i].analysis.summary;
    input.curves.push_back(curve_set(runs[i].analysis.channels, labels[i],
                                     i == 0 ? CurveOrigin::ThisRun : CurveOrigin::OtherRun));
    for (const std::string& warning : s.warnings)
      input.warnings.push_back(labels[i] + ": " + warning);
    input.provenance.emplace_back(labels[i], runs[i].name + ", run id " + s.manifest.run_id);
  }
  for (const std::string& scenario : distinct(runs, scenario_of))
    add_reference_curves(input, scenario);
  input.scene = runs.front().scene;
  const auto& contact = runs.front().analysis.summary.head_contact;
  if (contact) input.marks.push_back({contact->time, "head contact"});
  return input;
}

std::string comparison_text(const std::vector<ComparedRun>& runs,
                            const ComparisonSettings& settings) {
  std::string out;
  for (const ReportTable& table : tables_of(runs, settings)) {
    std::vector<std::size_t> widths;
    const auto widen = [&widths](const std::vector<std::string>& cells) {
      widths.resize(std::max(widths.size(), cells.size()));
      for (std::size_t i = 0; i < cells.size(); ++i)
        widths[i] = std::max(widths[i], shown_width(cells[i]));
    };
    widen(table.columns);
    for (const auto& row : table.rows) widen(row);
    const auto line = [&widths](const std::vector<std::string>& cells) {
      std::string text = "  " + cells[0] + std::string(widths[0] - shown_width(cells[0]), ' ');
      for (std::size_t i = 1; i < cells.size(); ++i)
        text += "  " + std::string(widths[i] - shown_width(cells[i]), ' ') + cells[i];
      return text + "\n";
    };
    out += table.title + "\n" + line(table.columns);
    for (const auto& row : table.rows) out += line(row);
    out += "\n";
  }
  return out + parameter_text(settings.parameters.cora) + "\n";
}

}  // namespace crosswalk::recording
