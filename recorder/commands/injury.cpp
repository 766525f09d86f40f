#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recorder/commands/commands.h"
#include "recorder/csv_table.h"
#include "recorder/head_motion.h"
#include "recorder/isomme.h"
#include "recorder/log_file.h"
#include "recorder/scoring/score_json.h"

namespace crosswalk::recording {

namespace {

std::optional<VectorSeries> components(const CsvTable& table, const std::vector<double>& t,
                                       const std::string& stem) {
  if (!table.has(stem + "x") && !table.has(stem + "y") && !table.has(stem + "z"))
    return std::nullopt;
  return VectorSeries{t, table.column(stem + "x"), table.column(stem + "y"),
                      table.column(stem + "z")};
}

/// Columns `t` with any of `ax ay az` (m/s2), `wx wy wz` (rad/s), `alx aly alz` (rad/s2), head axes
/// of SAE J211, and `fx fz my` (N, N m).
HeadSignals signals_of(const CsvTable& table) {
  const std::vector<double> t = time_column(table);
  HeadSignals signals;
  signals.acceleration = components(table, t, "a");
  signals.angular_velocity = components(table, t, "w");
  signals.angular_acceleration = components(table, t, "al");
  if (table.has("fx") || table.has("fz") || table.has("my")) {
    signals.neck = NeckLoads{t, table.column("fx"), table.column("fz"), table.column("my")};
  }
  if (!signals.acceleration && !signals.angular_velocity && !signals.angular_acceleration &&
      !signals.neck) {
    throw SignalError(SignalFault::Shape,
                      table.file + ": no columns ax,ay,az or wx,wy,wz or alx,aly,alz or fx,fz,my");
  }
  return signals;
}

/// Head signals of an ISO-MME test; those of filter class 0 (none) are filtered here.
HeadSignals signals_of(const MmeTest& test, bool is_filtered) {
  const std::vector<Channel> channels = channels_of(test);
  HeadSignals signals = head_signals(channels);
  const auto is_raw = [&channels, is_filtered](const std::string& name) {
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&name](const Channel& c) { return c.name == name; });
    return !is_filtered && found != channels.end() && found->description.ends_with('0');
  };
  HeadSignals raw;
  if (is_raw("head_acceleration_x")) raw.acceleration = signals.acceleration;
  if (is_raw("head_angular_velocity_x")) raw.angular_velocity = signals.angular_velocity;
  raw = filtered(raw);
  if (raw.acceleration) signals.acceleration = raw.acceleration;
  if (raw.angular_velocity) {
    signals.angular_velocity = raw.angular_velocity;
    signals.angular_acceleration = raw.angular_acceleration;
  }
  signals.notes = raw.notes;
  if (signals.neck) {
    signals.neck.reset();
    signals.notes.push_back(
        "upper neck loads are not rated: an ISO-MME test does not say how far above the condyles "
        "its moment was measured");
  }
  if (!signals.acceleration && !signals.angular_velocity) {
    throw SignalError(SignalFault::Shape, test.name +
                                              ": no head acceleration or angular velocity "
                                              "in three axes on a uniform time base");
  }
  return signals;
}

/// A run's channels are filtered already, at the rate they were recorded with.
bool is_run(const std::filesystem::path& source) {
  return std::filesystem::is_directory(source) || is_event_log(source);
}

HeadSignals read_signals(const InjuryRequest& request) {
  if (is_isomme(request.source))
    return signals_of(read_isomme(request.source), request.is_filtered);
  if (is_run(request.source)) return head_signals(channels_of_run(request.source));
  const HeadSignals signals = signals_of(read_csv(request.source));
  return request.is_filtered ? signals : filtered(signals);
}

/// What filter the metrics rest on.
const char* filter_text(const InjuryRequest& request) {
  if (is_isomme(request.source)) {
    return request.is_filtered
               ? "as in the file"
               : "as in the file; CFC 1000 linear, CFC 60 angular (ISO 6487) where it has none";
  }
  const bool is_raw = !is_run(request.source) && request.is_filtered;
  return is_raw ? "none" : "CFC 1000 linear, CFC 60 angular (ISO 6487)";
}

std::string window_text(const WindowMaximum& w) {
  if (!w.t1) return {};
  return fmt::format("   {:.2f} .. {:.2f} ms", 1e3 * *w.t1, 1e3 * *w.t2);
}

void print_card(const ScoreCard& card) {
  if (card.linear) {
    const LinearScores& s = *card.linear;
    fmt::print("HIC15            {:10.1f}{}\n", s.HIC15.value, window_text(s.HIC15));
    fmt::print("HIC36            {:10.1f}{}\n", s.HIC36.value, window_text(s.HIC36));
    if (s.clip_single) {
      fmt::print("3 ms, one piece  {:10.1f} g{}\n", s.clip_single->value,
                 window_text(*s.clip_single));
      fmt::print("3 ms, cumulative {:10.1f} g\n", *s.clip_cumulative);
    } else {
      fmt::print("3 ms clip        the record is shorter than 3 ms\n");
    }
    fmt::print("peak resultant   {:10.1f} g\nGSI              {:10.1f}\n", s.peak_g, s.GSI);
  }
  if (card.rotation) {
    const RotationScores& s = *card.rotation;
    fmt::print("BrIC             {:10.3f}   (CSDM set {:.3f}, MPS set {:.3f})\n", s.BrIC.avg,
               s.BrIC.csdm, s.BrIC.mps);
    fmt::print("UBrIC            {:10.3f}   peak to peak (largest value {:.3f})\n", s.UBrIC_p2p,
               s.UBrIC_max);
    fmt::print("DAMAGE           {:10.3f}   at {:.2f} ms\n", s.DAMAGE.value, 1e3 * s.DAMAGE.time);
    fmt::print("RIC36            {:10.3g}\n", s.RIC36);
  }
  if (card.combined) {
    const CombinedScores& s = *card.combined;
    fmt::print("GAMBIT           {:10.3f}   (250 g, 10 000 rad/s2)\nHIP              {:10.2f} kW\n",
               s.GAMBIT_2, 1e-3 * s.HIP_W);
    fmt::print("PRHIC36          {:10.3g}\nHARM             {:10.2f}\n", s.PRHIC36, s.HARM);
  }
  if (card.neck) {
    const NeckResult& s = *card.neck;
    fmt::print("Nij              {:10.3f}   TF {:.3f}  TE {:.3f}  CF {:.3f}  CE {:.3f}\n", s.Nij,
               s.NTF, s.NTE, s.NCF, s.NCE);
    fmt::print("Nkm              {:10.3f}   FA {:.3f}  EA {:.3f}  FP {:.3f}  EP {:.3f}\n", s.Nkm,
               s.NFA, s.NEA, s.NFP, s.NEP);
  }
  fmt::print("\nRisk (families of one metric disagree; each is printed with its name)\n");
  for (const RiskFamily& family : card.risks) {
    std::string line;
    for (const Risk& risk : family.risks)
      line += fmt::format("  {} {:.3f}", risk.level, risk.probability);
    fmt::print("  {:<52}{}\n", family.author, line);
  }
  for (const std::string& note : card.notes) fmt::print("note: {}\n", note);
}

}  // namespace

ExitCode injury(const InjuryRequest& request, OutputForm form) {
  const ScoreCard card = score_card(read_signals(request));
  if (form == OutputForm::Json) {
    nlohmann::ordered_json out = to_json(card);
    out["filter"] = filter_text(request);
    fmt::print("{}\n", out.dump(1));
  } else {
    print_card(card);
    fmt::print("filter: {}\n", filter_text(request));
  }
  return ExitCode::Done;
}

}  // namespace crosswalk::recording
