#include "recorder/run_verdict.h"

#include <algorithm>

#include <fmt/format.h>

namespace crosswalk::recording {

namespace {

// Limits of head injury metrics as they are printed beside the result.
constexpr double kHic15Limit = 700;   // FMVSS 208
constexpr double kClip3msLimit = 80;  // g, FMVSS 208
constexpr double kDamageLow = 0.42;   // Euro NCAP TB 035, modifier band
constexpr double kDamageHigh = 0.47;
constexpr const char* kImpact = "Impact";
constexpr const char* kInjury = "Head injury";
constexpr const char* kAgreement = "Agreement with the test";
constexpr const char* kQuality = "Quality of the run";

class Rows {
 public:
  explicit Rows(const Summary& summary) : summary_(summary) {}

  VerdictRow& add(const char* group, const std::string& label, const std::string& value,
                  const std::string& unit) {
    rows_.push_back({group, label, value, unit, {}, Verdict::Info, {}});
    return rows_.back();
  }

  /// Holds the last row against the published or estimated band of a quantity, when there is one;
  /// `of` says of what a ratio is.
  void hold_against_band(const std::string& quantity, const char* of = "") {
    for (const BandVerdict& v : summary_.bands) {
      if (v.band.quantity != quantity || !v.value) continue;
      VerdictRow& row = rows_.back();
      row.band = fmt::format("{:g} – {:g}{} ({}{}{})", v.band.low, v.band.high, of, v.band.status,
                             v.band.source.empty() ? "" : ", ", v.band.source);
      row.status = v.is_inside                    ? Verdict::Good
                   : v.band.status == "published" ? Verdict::Bad
                                                  : Verdict::Attention;
    }
  }

  void hold_against_limit(double value, double limit, const std::string& text, Verdict above) {
    VerdictRow& row = rows_.back();
    row.band = text;
    row.status = value <= limit ? Verdict::Good : above;
  }

  /// A limit of a head injury metric; without a blow to the head it says nothing.
  void hold_against_injury_limit(double value, double limit, const std::string& text,
                                 Verdict above) {
    hold_against_limit(value, limit, text, above);
    if (summary_.head_contact) return;
    rows_.back().status = Verdict::Info;
    rows_.back().reading = "head not struck";
  }

  std::vector<VerdictRow> take() { return std::move(rows_); }

 private:
  const Summary& summary_;
  std::vector<VerdictRow> rows_;
};

void add_impact(Rows& rows, const Summary& s) {
  if (s.initial_buck_speed) {
    rows.add(kImpact, "Car speed", fmt::format("{:.1f}", 3.6 * *s.initial_buck_speed), "km/h")
        .note = "At the start.";
  }
  if (!s.head_contact) {
    rows.add(kImpact, "Head contact", "none", "").note = "No force above 50 N on the head.";
    return;
  }
  const HeadContact& c = *s.head_contact;
  rows.add(kImpact, "Head contact time", fmt::format("{:.1f}", 1e3 * c.time), "ms").note =
      fmt::format("After {}; struck: {}.", time_zero_of(s), c.partner);
  rows.hold_against_band("head_contact_time_ms");
  if (c.wrap_around_distance) {
    rows.add(kImpact, "Wrap-around distance (WAD)",
             fmt::format("{:.0f}", 1e3 * *c.wrap_around_distance), "mm")
        .note = "Along the car front, from the ground to where the head strikes.";
    rows.hold_against_band("wrap_around_distance_mm");
  }
  rows.add(kImpact, "Head speed against the car", fmt::format("{:.2f}", c.relative_speed), "m/s")
      .note = c.buck_speed > 0
                  ? fmt::format("Just before head contact; {:.2f} times the car's speed.",
                                c.relative_speed / c.buck_speed)
                  : "Just before head contact.";
  rows.hold_against_band("head_contact_speed_relative_mps");
  rows.hold_against_band("head_contact_speed_ratio", " times the car's speed");
}

void add_aftermath(Rows& rows, const Summary& s) {
  if (s.after.head_on_road) {
    const RoadImpact& r = *s.after.head_on_road;
    rows.add(kInjury, "HIC15 on the road", fmt::format("{:.0f}", r.HIC15.value), "").note =
        fmt::format(
            "The head strikes the road at {:.0f} ms, peak {:.0f} g; before, by the car: {:.0f}.",
            1e3 * r.time, r.peak_g, r.HIC15_before.value);
    rows.hold_against_limit(r.HIC15.value, kHic15Limit, "up to 700 (FMVSS 208)", Verdict::Bad);
  }
  if (s.after.thrown && s.after.thrown->rest_time) {
    rows.add(kImpact, "Throw distance", fmt::format("{:.1f}", s.after.thrown->distance), "m").note =
        fmt::format("Of the centre of mass, along the car's travel; at rest after {:.1f} s.",
                    *s.after.thrown->rest_time);
    rows.hold_against_band("throw_distance_m");
  }
}

std::string risk_note(const Summary& s, const char* family, const char* level, const char* words) {
  const auto risk = risk_of(s, family, level);
  return risk ? fmt::format(" {:.0f} % risk of {} ({}).", 100 * *risk, words, level) : "";
}

void add_linear(Rows& rows, const Summary& s) {
  const LinearScores& l = *s.card.linear;
  rows.add(kInjury, "HIC15", fmt::format("{:.0f}", l.HIC15.value), "").note =
      "Head injury criterion over at most 15 ms." +
      risk_note(s, "hic_lognormal", "AIS3+", "serious head injury");
  rows.hold_against_injury_limit(l.HIC15.value, kHic15Limit, "up to 700 (FMVSS 208)", Verdict::Bad);
  if (l.clip_single) {
    rows.add(kInjury, "3 ms acceleration", fmt::format("{:.1f}", l.clip_single->value), "g").note =
        fmt::format("Exceeded for 3 ms; the peak is {:.0f} g.", l.peak_g);
    rows.hold_against_injury_limit(l.clip_single->value, kClip3msLimit, "up to 80 g (FMVSS 208)",
                                   Verdict::Bad);
  }
}

void add_rotation(Rows& rows, const Summary& s) {
  const RotationScores& r = *s.card.rotation;
  rows.add(kInjury, "BrIC", fmt::format("{:.2f}", r.BrIC.avg), "").note =
      fmt::format("Brain injury criterion from rotation, at most {:.0f} rad/s.", r.peak_w) +
      risk_note(s, "bric_mps", "AIS3+", "serious brain injury");
  rows.add(kInjury, "DAMAGE", fmt::format("{:.2f}", r.DAMAGE.value), "").note =
      "Brain strain estimated from the head's angular acceleration.";
  rows.hold_against_injury_limit(r.DAMAGE.value, kDamageLow, "0.42 – 0.47 (Euro NCAP TB 035 band)",
                                 r.DAMAGE.value > kDamageHigh ? Verdict::Bad : Verdict::Attention);
}

void add_injury(Rows& rows, const Summary& s) {
  if (s.card.linear) add_linear(rows, s);
  if (s.card.rotation) add_rotation(rows, s);
  if (s.tissue.empty()) return;
  const RegionPeak& brain = s.tissue.front();
  VerdictRow& mps =
      rows.add(kInjury, "Brain strain MPS95", fmt::format("{:.3f}", brain.mps_95_so_far), "");
  mps.note = fmt::format("95 % of {} stays below this first principal Green strain.", brain.region);
  mps.reading = "not validated";
  VerdictRow& csdm =
      rows.add(kInjury, "CSDM 0.25", fmt::format("{:.1f}", 100 * brain.csdm_25), "%");
  csdm.note = "Share of the brain that was ever strained beyond 0.25.";
  csdm.reading = "not validated";
}

void add_agreement(Rows& rows, const Summary& s) {
  for (const SignalRating& r : s.ratings) {
    if (!r.cora) continue;
    VerdictRow& row =
        rows.add(kAgreement, "CORA, " + r.signal.label, fmt::format("{:.3f}", r.cora->C), "");
    row.note =
        fmt::format("Corridor {:.2f}, shape {:.2f}, size {:.2f}, phase {:.2f}; 1 is equal to {}.",
                    r.cora->C1, r.cora->V, r.cora->G, r.cora->P, r.reference);
    if (r.iso) row.band = fmt::format("ISO/TS 18571: {:.3f} ({})", r.iso->R, r.iso->grade);
  }
  if (!s.ratings.empty()) return;
  VerdictRow& row = rows.add(kAgreement, "CORA and ISO/TS 18571", "not rated", "");
  row.note = std::string("No measured curve of this test is available, so nothing is claimed") +
             (s.bands.empty() ? "." : "; the bands above are all that is compared.");
  row.reading = "no curve";
}

void add_limited(Rows& rows, const char* label, double value, double limit, const char* unit,
                 const std::string& note, int digits = 2) {
  rows.add(kQuality, label, fmt::format("{:.{}f}", value, digits), unit).note = note;
  rows.hold_against_limit(value, limit, fmt::format("up to {:g} {}", limit, unit),
                          Verdict::Attention);
}

void add_quality(Rows& rows, const Summary& s) {
  if (s.coupling && s.fe) {
    add_limited(
        rows, "Interface energy drift", s.coupling->drift_percent, 1, "%",
        fmt::format("Work lost or gained where the two solvers meet, of {:.0f} J exchanged.",
                    s.coupling->exchanged),
        3);
  }
  if (s.mb) {
    add_limited(
        rows, "Multibody energy balance", s.mb->balance_percent, 1, "%",
        "Gravity, contacts, joints, friction and the car's work: energy unaccounted for, of "
        "the peak kinetic energy.");
  }
  if (s.fe) {
    add_limited(rows, "Finite-element energy balance", s.fe->balance_percent, 2, "%",
                "Energy unaccounted for, of the peak.");
    add_limited(rows, "Hourglass energy", s.fe->hourglass_percent, 10, "%",
                "In modes that one-point elements do not feel, of the internal energy.");
    if (!s.tissue.empty())
      add_limited(rows, "Brain inside out", 100 * s.tissue.front().inside_out,
                  kInsideOutLimitPercent, "%",
                  "Largest share of the brain's bricks with a corner turned inside out at once.");
    if (s.fe->added_mass_percent) {
      add_limited(rows, "Added mass", *s.fe->added_mass_percent, 2, "%", "By mass scaling.");
    }
  }
  if (s.coupling) {
    rows.add(kQuality, "Energy balance of the whole run",
             fmt::format("{:.2f}", s.coupling->balance_percent), "%")
        .note = s.fe ? "Both solvers together, of the peak energy." : "Of the peak energy.";
  }
  VerdictRow& record = rows.add(kQuality, "Record", s.is_complete ? "complete" : "incomplete", "");
  record.status = s.is_complete ? Verdict::Good : Verdict::Bad;
  record.reading = s.is_complete ? "nothing missing" : "ended early";
  record.note = s.is_complete ? fmt::format("Every one of {} messages is in the log.", s.messages)
                              : s.outcome;
  rows.add(kQuality, "Computing time", fmt::format("{:.0f}", s.timing.wall), "s").note =
      fmt::format("For {:.0f} ms; solving took {:.1f} s for the bodies{}.", 1e3 * s.simulated,
                  s.timing.mb,
                  s.fe ? fmt::format(", {:.1f} s for the finite elements", s.timing.fe) : "");
}

}  // namespace

std::string time_zero_of(const Summary& summary) {
  return summary.has_first_contact ? "first leg contact" : "the start of the computation";
}

std::optional<double> risk_of(const Summary& s, const std::string& family,
                              const std::string& level) {
  for (const RiskFamily& f : s.card.risks) {
    if (f.key != family) continue;
    for (const Risk& risk : f.risks) {
      if (risk.level == level) return risk.probability;
    }
  }
  return std::nullopt;
}

std::vector<VerdictRow> verdict_of(const Summary& summary) {
  Rows rows(summary);
  add_impact(rows, summary);
  add_injury(rows, summary);
  add_aftermath(rows, summary);
  add_agreement(rows, summary);
  add_quality(rows, summary);
  return rows.take();
}

}  // namespace crosswalk::recording
