#include "recorder/run_tables.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/run_verdict.h"
#include "recorder/scoring/score_json.h"

namespace crosswalk::recording {

namespace {

std::string percent(double share) { return fmt::format("{:.1f}\u00a0%", 100 * share); }

std::string three(double value) { return fmt::format("{:.3f}", value); }

std::string reference_text(const SignalRating& r) {
  return r.fault.empty() ? r.reference : r.reference + ": " + r.fault;
}

ReportTable cora_table(const Summary& s) {
  ReportTable table{"CORA ratings against the measured curves",
                    "Over the whole common time. " + parameter_text(CoraParameters{}) +
                        ". Lag below zero: the simulation is late.",
                    {"signal", "C", "corridor C1", "cross-correlation C2", "shape V", "size G",
                     "phase P", "lag [ms]", "rated [ms]", "reference"},
                    {}};
  for (const SignalRating& r : s.ratings) {
    std::vector<std::string> row{r.signal.label};
    if (r.cora) {
      for (const double v : {r.cora->C, r.cora->C1, r.cora->C2, r.cora->V, r.cora->G, r.cora->P})
        row.push_back(three(v));
      row.push_back(fmt::format("{:+.2f}", 1e3 * r.cora->delta));
      row.push_back(fmt::format("{:.0f} – {:.0f}", 1e3 * r.cora->t_min, 1e3 * r.cora->t_max));
    }
    row.resize(table.columns.size() - 1, "–");
    row.push_back(reference_text(r));
    table.rows.push_back(row);
  }
  return table;
}

ReportTable iso_table(const Summary& s) {
  ReportTable table{
      "ISO/TS 18571 ratings against the measured curves",
      "",
      {"signal", "R", "corridor Z", "phase EP", "magnitude EM", "slope ES", "grade", "reference"},
      {}};
  for (const SignalRating& r : s.ratings) {
    std::vector<std::string> row{r.signal.label};
    if (r.iso) {
      for (const double v : {r.iso->R, r.iso->Z, r.iso->EP, r.iso->EM, r.iso->ES})
        row.push_back(three(v));
      row.push_back(r.iso->grade);
    }
    row.resize(table.columns.size() - 1, "–");
    row.push_back(reference_text(r));
    table.rows.push_back(row);
  }
  return table;
}

std::string window_text(const WindowMaximum& w) {
  if (!w.t1) return "";
  return fmt::format("{:.2f} to {:.2f} ms", 1e3 * *w.t1, 1e3 * *w.t2);
}

void add_linear(ReportTable& table, const LinearScores& l) {
  table.rows.push_back({"HIC15", fmt::format("{:.1f}", l.HIC15.value), "–", window_text(l.HIC15)});
  table.rows.push_back({"HIC36", fmt::format("{:.1f}", l.HIC36.value), "–", window_text(l.HIC36)});
  if (l.clip_single) {
    table.rows.push_back({"3 ms acceleration, one piece",
                          fmt::format("{:.1f}", l.clip_single->value), "g",
                          window_text(*l.clip_single)});
    table.rows.push_back(
        {"3 ms acceleration, cumulative", fmt::format("{:.1f}", *l.clip_cumulative), "g", ""});
  }
  table.rows.push_back({"peak acceleration", fmt::format("{:.1f}", l.peak_g), "g", ""});
  table.rows.push_back({"GSI", fmt::format("{:.1f}", l.GSI), "–", ""});
}

void add_rotation(ReportTable& table, const RotationScores& r) {
  table.rows.push_back({"peak angular velocity", fmt::format("{:.1f}", r.peak_w), "rad/s", ""});
  table.rows.push_back(
      {"peak angular acceleration", fmt::format("{:.0f}", r.peak_alpha), "rad/s²", ""});
  table.rows.push_back({"BrIC", three(r.BrIC.avg), "–",
                        fmt::format("mean critical values; {:.3f} by CSDM, {:.3f} by MPS",
                                    r.BrIC.csdm, r.BrIC.mps)});
  table.rows.push_back({"UBrIC", three(r.UBrIC_p2p), "–",
                        fmt::format("peak to peak; {:.3f} by largest value", r.UBrIC_max)});
  table.rows.push_back({"DAMAGE", three(r.DAMAGE.value), "–",
                        fmt::format("at {:.2f} ms; about x {:.3f}, y {:.3f}, z {:.3f}",
                                    1e3 * r.DAMAGE.time, r.DAMAGE.x, r.DAMAGE.y, r.DAMAGE.z)});
  table.rows.push_back({"RIC15, RIC36", fmt::format("{:.3g}, {:.3g}", r.RIC15, r.RIC36), "–", ""});
}

void add_combined(ReportTable& table, const CombinedScores& c) {
  table.rows.push_back(
      {"GAMBIT", three(c.GAMBIT_2), "–",
       fmt::format("250 g, 10 000 rad/s², power 2; {:.3f} with 25 000 rad/s², power 2.5",
                   c.GAMBIT_2p5)});
  table.rows.push_back({"HIP", fmt::format("{:.2f}", 1e-3 * c.HIP_W), "kW", ""});
  table.rows.push_back(
      {"PRHIC15, PRHIC36", fmt::format("{:.3g}, {:.3g}", c.PRHIC15, c.PRHIC36), "–", ""});
  table.rows.push_back({"KLC", three(c.KLC), "–", ""});
  table.rows.push_back({"HARM", fmt::format("{:.2f}", c.HARM), "–", ""});
}

void add_neck(ReportTable& table, const NeckResult& n) {
  table.rows.push_back(
      {"Nij", fmt::format("{:.2f}", n.Nij), "–",
       fmt::format("tension-flexion {:.2f}, tension-extension {:.2f}, compression-flexion {:.2f}, "
                   "compression-extension {:.2f}; critical values of the Hybrid III 50th",
                   n.NTF, n.NTE, n.NCF, n.NCE)});
  table.rows.push_back(
      {"Nkm", fmt::format("{:.2f}", n.Nkm), "–",
       fmt::format("flexion-anterior {:.2f}, extension-anterior {:.2f}, flexion-posterior {:.2f}, "
                   "extension-posterior {:.2f}",
                   n.NFA, n.NEA, n.NFP, n.NEP)});
}

ReportTable energy_table(const Summary& s) {
  ReportTable table{"Energy of the bodies at the end",
                    "What the car put in, where it is, and which law took it (docs/multibody.md).",
                    {"book", "energy", "unit"},
                    {}};
  table.rows.push_back({"held at the start", fmt::format("{:.1f}", s.mb->start), "J"});
  for (auto [name, energy] : energy_rows(s.mb->end)) {
    std::replace(name.begin(), name.end(), '_', ' ');
    table.rows.push_back({name, fmt::format("{:.1f}", energy), "J"});
  }
  return table;
}

ReportTable injury_table(const Summary& s) {
  ReportTable table{"Head and neck injury metrics",
                    "Head COG in SAE J211 axes; linear acceleration CFC 1000, angular velocity CFC "
                    "60, angular acceleration its derivative; loads of the neck on the head at the "
                    "condyles, force CFC 1000, moment CFC 600.",
                    {"metric", "value", "unit", "when, how"},
                    {}};
  if (s.card.linear) add_linear(table, *s.card.linear);
  if (s.card.rotation) add_rotation(table, *s.card.rotation);
  if (s.card.combined) add_combined(table, *s.card.combined);
  if (s.card.neck) add_neck(table, *s.card.neck);
  return table;
}

ReportTable risk_table(const Summary& s) {
  ReportTable table{"Injury risk",
                    "Families of curves disagree; each is printed with its author.",
                    {"curve"},
                    {}};
  std::vector<std::string> levels;
  for (const RiskFamily& family : s.card.risks) {
    for (const Risk& risk : family.risks) {
      if (std::find(levels.begin(), levels.end(), risk.level) == levels.end())
        levels.push_back(risk.level);
    }
  }
  std::sort(levels.begin(), levels.end());
  table.columns.insert(table.columns.end(), levels.begin(), levels.end());
  for (const RiskFamily& family : s.card.risks) {
    std::vector<std::string> row{family.author};
    for (const std::string& level : levels) {
      const auto risk = risk_of(s, family.key, level);
      row.push_back(risk ? percent(*risk) : "");
    }
    table.rows.push_back(row);
  }
  return table;
}

std::string label_of(const std::string& channel) {
  for (const RatedSignal& signal : rating_set({})) {
    if (signal.channel == channel) return signal.label;
  }
  return channel;
}

/// The layout of the published table: a row per signal, a column per model.
ReportTable published_table(const Summary& s) {
  ReportTable table{
      "Published CORA scores of other models in this test", s.published_source, {"signal"}, {}};
  for (const PublishedScore& p : s.published) {
    const std::string label = label_of(p.signal);
    auto column = std::find(table.columns.begin() + 1, table.columns.end(), p.model);
    if (column == table.columns.end()) column = table.columns.insert(column, p.model);
    auto row = std::find_if(table.rows.begin(), table.rows.end(),
                            [&label](const auto& cells) { return cells[0] == label; });
    if (row == table.rows.end()) row = table.rows.insert(row, {label});
    row->resize(std::max(row->size(), table.columns.size()));
    (*row)[static_cast<std::size_t>(column - table.columns.begin())] =
        fmt::format("{:.3f}", p.score);
  }
  return table;
}

}  // namespace

std::string parameter_text(const CoraParameters& parameters) {
  std::string text = "CORA parameters:";
  const nlohmann::ordered_json object = to_json(parameters);
  for (const auto& [key, value] : object.items()) {
    if (value.is_null()) continue;
    text += fmt::format(" {} {}", key, value.is_string() ? value.get<std::string>() : value.dump());
    text += ",";
  }
  text.pop_back();
  return text;
}

std::vector<ReportTable> run_tables(const Summary& s) {
  std::vector<ReportTable> tables;
  if (!s.ratings.empty()) tables = {cora_table(s), iso_table(s)};
  if (s.card.linear || s.card.rotation) tables.push_back(injury_table(s));
  if (!s.card.risks.empty()) tables.push_back(risk_table(s));
  if (s.mb) tables.push_back(energy_table(s));
  if (!s.published.empty()) tables.push_back(published_table(s));
  return tables;
}

}  // namespace crosswalk::recording
