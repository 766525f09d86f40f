#include "recorder/summary.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "recorder/description.h"

namespace crosswalk::recording {

namespace {

// Limits the project holds itself to; the last two are those of the seed paper [yu2020, 3.3].
constexpr double kDriftLimitPercent = 1.0;
constexpr double kBalanceLimitPercent = 2.0;
constexpr double kMultibodyLimitPercent = 1.0;
constexpr double kHourglassLimitPercent = 10.0;
constexpr double kAddedMassLimitPercent = 2.0;

double held(const FeWindow& w) {
  return w.kinetic + w.internal + w.hourglass + w.contact + w.damping;
}

std::optional<double> described_mass(const RunRecord& record) {
  const nlohmann::json fe = description_of(record, Role::Fe);
  if (!fe.contains("mass_kg") || !fe["mass_kg"].is_number()) return std::nullopt;
  return fe["mass_kg"].get<double>();
}

FiniteElementBalance balance_of(const RunRecord& record) {
  FiniteElementBalance b;
  const FeWindow& first = record.fe.begin()->second;
  const double start = held(first) - first.external_work - first.interface_work;
  double worst = 0;
  for (const auto& [window, w] : record.fe) {
    b.peak_energy = std::max(b.peak_energy, held(w));
    worst = std::max(worst, std::abs(held(w) - w.external_work - w.interface_work - start));
  }
  const FeWindow& last = record.fe.rbegin()->second;
  if (b.peak_energy > 0) b.balance_percent = 100 * worst / b.peak_energy;
  if (last.internal > 0) b.hourglass_percent = 100 * last.hourglass / last.internal;
  for (const auto& [window, w] : record.fe) b.added_mass = std::max(b.added_mass, w.added_mass);
  if (const auto mass = described_mass(record); mass && *mass > 0) {
    b.added_mass_percent = 100 * b.added_mass / *mass;
  }
  return b;
}

std::optional<MultibodyBalance> multibody_balance_of(const RunRecord& record) {
  if (record.mb.empty()) return std::nullopt;
  const MbEnergies& first = record.mb.begin()->second.energy;
  const double start = first.held() - first.supplied();
  double worst = 0, peak = 0;
  for (const auto& [window, w] : record.mb) {
    peak = std::max(peak, w.energy.kinetic);
    worst = std::max(worst, std::abs(w.energy.held() - w.energy.supplied() - start));
  }
  constexpr double kLeast = 1;  // J; a body that stands has hardly any
  return MultibodyBalance{start, record.mb.rbegin()->second.energy,
                          100 * worst / std::max(peak, kLeast)};
}

CouplingQuality quality_of(const RunRecord& record) {
  CouplingQuality q;
  double worst = 0, balance = 0, peak = 0, iterations = 0;
  for (const auto& [window, a] : record.audit) {
    worst = std::max(worst, std::abs(a.drift));
    balance = std::max(balance, std::abs(a.balance_error));
    peak = std::max(peak, std::abs(a.total_energy));
    q.gap_mm = std::max(q.gap_mm, 1e3 * a.gap_position);
    q.owed_force = std::max(q.owed_force, a.owed_force);
    q.owed_moment = std::max(q.owed_moment, a.owed_moment);
    iterations += a.iterations;
  }
  const AuditWindow& last = record.audit.rbegin()->second;
  q.drift = last.drift;
  q.exchanged = last.exchanged;
  if (q.exchanged > 0) q.drift_percent = 100 * worst / q.exchanged;
  if (peak > 0) q.balance_percent = 100 * balance / peak;
  q.resends = last.resends;
  q.iterations = iterations / static_cast<double>(record.audit.size());
  return q;
}

std::vector<RegionPeak> tissue_of(const RunRecord& record, double t0) {
  std::vector<RegionPeak> peaks;
  const std::vector<std::string> names = run_names(record).regions;
  for (const auto& [t_ns, sample] : record.tissue) {
    for (std::size_t i = 0; i < sample.regions.size(); ++i) {
      if (i >= peaks.size()) {
        peaks.emplace_back();
        peaks[i].region = i < names.size() ? names[i] : "region " + std::to_string(i);
      }
      RegionPeak& p = peaks[i];
      const TissueSample::Region& r = sample.regions[i];
      if (r.mps_95 > p.mps_95) {
        p.mps_95 = r.mps_95;
        p.mps_95_time = 1e-9 * static_cast<double>(t_ns) - t0;
      }
      p.mps_max = std::max(p.mps_max, r.mps_max);
      p.mps_95_so_far = std::max(p.mps_95_so_far, r.mps_95_so_far);
      p.csdm_15 = std::max(p.csdm_15, r.csdm_15);
      p.csdm_25 = std::max(p.csdm_25, r.csdm_25);
      p.von_mises_95 = std::max(p.von_mises_95, r.von_mises_95);
      p.pressure_max = std::max(p.pressure_max, r.pressure_max);
      p.pressure_min = std::min(p.pressure_min, r.pressure_min);
      p.inside_out = std::max(p.inside_out, r.inside_out);
    }
  }
  return peaks;
}

Timing timing_of(const RunRecord& record) {
  Timing t;
  t.wall = 1e-6 * static_cast<double>(record.last_us - record.first_us);
  for (const auto& [window, w] : record.mb) t.mb += 1e-6 * w.work_us;
  for (const auto& [window, w] : record.fe) t.fe += 1e-6 * w.work_us;
  for (const auto& [window, a] : record.audit) t.windows += 1e-6 * a.wall_us;
  t.exchange = std::max(0.0, t.windows - t.mb - t.fe);
  return t;
}

void warn_limits(Summary& s) {
  const auto limit = [&s](const char* what, double value, double most) {
    if (value <= most) return;
    s.warnings.push_back(
        fmt::format("{} is {:.2f} %, above the limit of {:g} %", what, value, most));
  };
  if (s.mb) limit("multibody energy balance error", s.mb->balance_percent, kMultibodyLimitPercent);
  if (s.coupling && s.fe)
    limit("interface audit drift", s.coupling->drift_percent, kDriftLimitPercent);
  if (!s.fe) return;
  limit("finite-element energy balance error", s.fe->balance_percent, kBalanceLimitPercent);
  limit("hourglass energy", s.fe->hourglass_percent, kHourglassLimitPercent);
  if (s.fe->added_mass_percent)
    limit("added mass", *s.fe->added_mass_percent, kAddedMassLimitPercent);
  for (const RegionPeak& p : s.tissue)
    limit(("share of " + p.region + " with corners inside out").c_str(), 100 * p.inside_out,
          kInsideOutLimitPercent);
}

std::string outcome_of(const RunRecord& record) {
  if (record.abort_reason) return "aborted: " + *record.abort_reason;
  if (record.lost > 0) return fmt::format("{} numbered messages are missing", record.lost);
  if (!record.is_finished) return "the log ends before the run's end";
  return "complete";
}

/// Whether the run lasts until the head should have met the car; one that was asked to end before
/// says nothing about the head.
bool could_have_struck(const Summary& s, const ReferenceData& reference) {
  for (const Band& band : reference.bands) {
    if (band.quantity == "head_contact_time_ms") return 1e3 * (s.simulated - s.t0) > band.high;
  }
  return true;
}

/// A rating covers the common time only: said where the run ends well before a curve does.
void warn_short_rating(Summary& s, const RunChannels& channels, const ReferenceData& reference) {
  constexpr double kShare = 0.95;  // of the curve, that a run must cover without a word
  double curve_end = 0, run_end = 0;
  for (const ReferenceCurve& curve : reference.curves) {
    const Channel* channel = channels.find(curve.channel);
    if (channel == nullptr || channel->present().size() == 0) continue;
    curve_end = std::max(curve_end, curve.series.t.back());
    run_end = std::max(run_end, channel->present().t.back());
  }
  if (run_end >= kShare * curve_end) return;
  s.warnings.push_back(
      fmt::format("the run ends at {:.0f} ms, the curves of the test at {:.0f} ms: ratings cover "
                  "the common time only",
                  1e3 * run_end, 1e3 * curve_end));
}

void hold_against(Summary& s, const RunChannels& channels, const ReferenceData& reference) {
  for (const std::string& fault : reference.faults)
    s.warnings.push_back("a curve of the test is left out: " + fault);
  for (const ReferenceCurve& curve : reference.curves) {
    if (channels.find(curve.channel) == nullptr)
      s.warnings.push_back("a curve of the test is left out: the run has no channel '" +
                           curve.channel + "'");
  }
  const bool is_judged = s.head_contact || (s.is_complete && could_have_struck(s, reference));
  for (const Band& band : reference.bands) {
    if (s.manifest.has_head_alone()) break;  // the bands are those of whole pedestrians
    BandVerdict verdict{band, is_judged ? summary_quantity(s, band.quantity) : std::nullopt, false};
    if (verdict.value)
      verdict.is_inside = *verdict.value >= band.low && *verdict.value <= band.high;
    s.bands.push_back(verdict);
  }
  s.published = reference.scores;
  s.published_source = reference.scores_source;
  s.ratings = rate_against_curves(with_further_curves(rating_set({}), reference.curves),
                                  channels.channels, reference.curves);
  warn_short_rating(s, channels, reference);
}

void add_statements(Summary& s, const std::optional<ReferenceData>& reference) {
  if (!s.tissue.empty()) {
    s.statements.push_back(
        "Brain strains are those of a head model that misses several head experiments "
        "(docs/validation.md): MPS, CSDM and what follows from them must not be used.");
  }
  if (s.manifest.has_head_alone()) {
    s.statements.push_back(
        "A head alone, started or driven by the head of another run: what neck and body do while "
        "it is struck is left out, and no band of the whole test applies.");
  }
  s.statements.push_back(
      "Car profile, windshield and contact curves, body joints and tissue laws are engineering "
      "estimates where no published number exists; each is marked in its file under scenarios/.");
  if (!reference) {
    s.statements.push_back("No reference data is kept for this scenario: nothing was compared.");
  } else if (reference->curves.empty()) {
    s.statements.push_back(
        "No measured curve of this test is in the project: no CORA or ISO rating against the test. "
        "Put "
        "digitised curves into " +
        (reference->folder / "curves").string() + " to get one.");
  }
}

}  // namespace

Summary summarize(const RunRecord& record, const RunChannels& channels,
                  const std::optional<ReferenceData>& reference) {
  Summary s;
  if (record.manifest) s.manifest = *record.manifest;
  s.windows = static_cast<std::int64_t>(record.mb.size());
  if (!record.mb.empty()) s.simulated = 1e-9 * static_cast<double>(record.mb.rbegin()->second.t_ns);
  s.outcome = outcome_of(record);
  s.is_complete = s.outcome == "complete";
  s.messages = record.messages;
  s.doubled = record.doubled;
  s.lost = record.lost;
  s.t0 = channels.t0;
  s.has_first_contact = channels.has_first_contact;
  s.initial_buck_speed = channels.initial_buck_speed;
  s.head_contact = channels.head_contact;
  s.warnings = channels.warnings;
  try {
    s.card = score_card(channels.head);
  } catch (const SignalError& error) {
    s.warnings.push_back(std::string("no injury metrics: ") + error.what());
  }
  s.after = aftermath_of(record, channels);
  s.tissue = tissue_of(record, channels.t0);
  s.mb = multibody_balance_of(record);
  if (!record.fe.empty()) s.fe = balance_of(record);
  if (!record.audit.empty()) s.coupling = quality_of(record);
  s.timing = timing_of(record);
  if (!s.is_complete) s.warnings.push_back("the record is not complete: " + s.outcome);
  warn_limits(s);
  for (const Event& event : record.events) {
    const bool is_told = record.abort_reason && event.text == *record.abort_reason;
    if (event.level == EventLevel::Info || is_told) continue;
    s.warnings.push_back(fmt::format("{} at {:.2f} ms: {}", role_name(event.sender),
                                     1e-6 * static_cast<double>(event.t_ns) - 1e3 * s.t0,
                                     event.text));
  }
  if (reference) hold_against(s, channels, *reference);
  add_statements(s, reference);
  return s;
}

std::optional<double> summary_quantity(const Summary& s, const std::string& quantity) {
  if (s.head_contact) {
    const HeadContact& c = *s.head_contact;
    if (quantity == "head_contact_time_ms") return 1e3 * c.time;
    if (quantity == "head_contact_speed_relative_mps") return c.relative_speed;
    if (quantity == "head_contact_speed_ratio" && c.buck_speed > 0)
      return c.relative_speed / c.buck_speed;
    if (quantity == "wrap_around_distance_mm" && c.wrap_around_distance)
      return 1e3 * *c.wrap_around_distance;
  }
  if (s.after.thrown && s.after.thrown->rest_time && quantity == "throw_distance_m")
    return s.after.thrown->distance;
  if (s.after.head_on_road) {  // the bands speak of the car's blow
    if (quantity == "peak_g") return s.after.head_on_road->peak_g_before;
    if (quantity == "HIC15") return s.after.head_on_road->HIC15_before.value;
  }
  if (s.card.linear) {
    if (quantity == "peak_g") return s.card.linear->peak_g;
    if (quantity == "HIC15") return s.card.linear->HIC15.value;
  }
  if (s.card.rotation) {
    if (quantity == "BrIC") return s.card.rotation->BrIC.avg;
    if (quantity == "DAMAGE") return s.card.rotation->DAMAGE.value;
  }
  return std::nullopt;
}

}  // namespace crosswalk::recording
