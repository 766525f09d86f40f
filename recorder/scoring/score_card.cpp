#include "recorder/scoring/score_card.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/units.h"

namespace crosswalk::recording {

namespace {

void require_valid(const VectorSeries& v, const std::string& name) {
  recording::require_valid(v.t, v.x, name + " x");
  recording::require_valid(v.t, v.y, name + " y");
  recording::require_valid(v.t, v.z, name + " z");
}

double peak(const std::vector<double>& x) { return *std::max_element(x.begin(), x.end()); }

/// Uniform time base of a record: kept when it is uniform, else the median step.
struct Grid {
  double t0 = 0, dt = 0;
  std::size_t n = 0;
  bool is_kept = true;
};

Grid uniform_grid(const std::vector<double>& t) {
  Grid g;
  g.t0 = t.front();
  g.n = t.size();
  g.is_kept = is_uniform(t);
  g.dt = g.is_kept ? (t.back() - t.front()) / static_cast<double>(t.size() - 1) : median_step(t);
  if (!g.is_kept) g.n = sample_count(t.front(), t.back(), g.dt);
  return g;
}

std::vector<double> grid_times(std::vector<double> t, const Grid& g) {
  if (g.is_kept) return t;
  t.resize(g.n);
  for (std::size_t i = 0; i < g.n; ++i) t[i] = g.t0 + static_cast<double>(i) * g.dt;
  return t;
}

/// What a reader of the result must know about the sampling of a filtered signal.
void note_sampling(std::vector<std::string>& notes, const char* name, const std::vector<double>& t,
                   double cfc) {
  const Grid g = uniform_grid(t);
  if (!g.is_kept) {
    notes.push_back(
        fmt::format("{}: samples are irregular, resampled to one per {:.6g} ms", name, 1e3 * g.dt));
  }
  if (!is_sampled_for_cfc(cfc, g.dt)) {
    notes.push_back(fmt::format("{}: {:.0f} samples per second, CFC {:g} asks for {:g}", name,
                                1 / g.dt, cfc, 10 * cfc));
  }
}

std::vector<double> filtered(const std::vector<double>& t, const std::vector<double>& y,
                             const Grid& g, double cfc, FilterForm form) {
  return cfc_filter(g.is_kept ? y : resample(t, y, g.t0, g.dt, g.n), g.dt, cfc, form);
}

VectorSeries filtered(const VectorSeries& v, double cfc, FilterForm form) {
  const Grid g = uniform_grid(v.t);
  VectorSeries out;
  out.t = grid_times(v.t, g);
  out.x = filtered(v.t, v.x, g, cfc, form);
  out.y = filtered(v.t, v.y, g, cfc, form);
  out.z = filtered(v.t, v.z, g, cfc, form);
  return out;
}

NeckLoads filtered(const NeckLoads& n, FilterForm form, std::vector<std::string>& notes) {
  recording::require_valid(n.t, n.fx, "neck force x");
  recording::require_valid(n.t, n.fz, "neck force z");
  recording::require_valid(n.t, n.my, "neck moment y");
  note_sampling(notes, "neck loads", n.t, 1000);
  const Grid g = uniform_grid(n.t);
  return {grid_times(n.t, g), filtered(n.t, n.fx, g, 1000, form),
          filtered(n.t, n.fz, g, 1000, form), filtered(n.t, n.my, g, 600, form)};
}

VectorSeries derivative(const VectorSeries& v) {
  return {v.t, recording::derivative(v.t, v.x), recording::derivative(v.t, v.y),
          recording::derivative(v.t, v.z)};
}

LinearScores linear_scores(const Series& a) {
  LinearScores s;
  s.peak_g = peak(a.y) / kStandardGravity;
  s.HIC15 = hic(a, 0.015);
  s.HIC36 = hic(a, 0.036);
  s.GSI = severity_index(a);
  try {
    s.clip_single = clip_3ms_single(a);
    s.clip_cumulative = clip_3ms_cumulative(a);
  } catch (const SignalError& error) {
    if (error.fault() != SignalFault::TooShort) throw;  // a record under 3 ms has no clip
  }
  return s;
}

RotationScores rotation_scores(const VectorSeries& w, const VectorSeries& alpha) {
  RotationScores s;
  s.peak_w = peak(w.magnitude());
  const std::vector<double> size = alpha.magnitude();
  s.peak_alpha = peak(size);
  s.BrIC = bric(w);
  s.UBrIC_p2p = ubric(w, alpha, UbricPeak::PeakToPeak);
  s.UBrIC_max = ubric(w, alpha, UbricPeak::Maximum);
  s.DAMAGE = damage(alpha);
  s.RIC15 = window_criterion(alpha.t, size, 0.015).value;
  s.RIC36 = window_criterion(alpha.t, size, 0.036).value;
  return s;
}

CombinedScores combined_scores(const VectorSeries& a, const VectorSeries& alpha,
                               const LinearScores& linear, const RotationScores& rotation) {
  CombinedScores s;
  const std::vector<double> linear_size = a.magnitude();
  const std::vector<double> angular_size = alpha.magnitude();
  s.GAMBIT_2 = gambit(linear_size, angular_size, GambitForm::Power2);
  s.GAMBIT_2p5 = gambit(linear_size, angular_size, GambitForm::Power25);
  const HeadImpactPower power = head_impact_power(a, alpha);
  s.HIP_W = power.peak;
  s.PRHIC15 = window_criterion(a.t, power.rotational, 0.015).value;
  s.PRHIC36 = window_criterion(a.t, power.rotational, 0.036).value;
  s.KLC = kleiven_combination(rotation.peak_w, linear.HIC36.value);
  s.HARM = harm(linear.HIC15.value, rotation.DAMAGE.value);
  return s;
}

void add_risks(ScoreCard& card) {
  if (card.linear) {
    card.risks.push_back(risk_hic_lognormal(card.linear->HIC15.value));
    card.risks.push_back(risk_hic_logistic(card.linear->HIC15.value));
  }
  if (card.rotation) {
    card.risks.push_back(risk_bric_csdm(card.rotation->BrIC.csdm));
    card.risks.push_back(risk_bric_mps(card.rotation->BrIC.mps));
    card.risks.push_back(risk_damage(card.rotation->DAMAGE.value));
  }
  if (card.neck) card.risks.push_back(risk_nij(card.neck->Nij));
}

}  // namespace

HeadSignals filtered(const HeadSignals& signals, FilterForm form) {
  HeadSignals out = signals;
  if (signals.acceleration) {
    require_valid(*signals.acceleration, "acceleration");
    note_sampling(out.notes, "acceleration", signals.acceleration->t, 1000);
    out.acceleration = filtered(*signals.acceleration, 1000, form);
  }
  if (signals.angular_velocity) {
    require_valid(*signals.angular_velocity, "angular velocity");
    note_sampling(out.notes, "angular velocity", signals.angular_velocity->t, 60);
    out.angular_velocity = filtered(*signals.angular_velocity, 60, form);
    out.angular_acceleration = derivative(*out.angular_velocity);
    out.notes.push_back(
        signals.angular_acceleration
            ? "the given angular acceleration is not used: the derivative of the filtered "
              "angular velocity stands for it"
            : "angular acceleration is the derivative of the filtered angular velocity");
  } else if (signals.angular_acceleration) {
    require_valid(*signals.angular_acceleration, "angular acceleration");
    note_sampling(out.notes, "angular acceleration", signals.angular_acceleration->t, 60);
    out.angular_acceleration = filtered(*signals.angular_acceleration, 60, form);
  }
  if (signals.neck) out.neck = filtered(*signals.neck, form, out.notes);
  return out;
}

ScoreCard score_card(const HeadSignals& signals) {
  ScoreCard card;
  card.notes = signals.notes;
  if (signals.acceleration) {
    require_valid(*signals.acceleration, "acceleration");
    card.linear = linear_scores({signals.acceleration->t, signals.acceleration->magnitude()});
  }
  std::optional<VectorSeries> alpha = signals.angular_acceleration;
  if (alpha) require_valid(*alpha, "angular acceleration");
  if (signals.angular_velocity) {
    require_valid(*signals.angular_velocity, "angular velocity");
    if (!alpha) {
      alpha = derivative(*signals.angular_velocity);
      card.notes.push_back("angular acceleration is the derivative of the angular velocity");
    }
    card.rotation = rotation_scores(*signals.angular_velocity, *alpha);
  } else if (alpha) {
    card.notes.push_back("no angular velocity: no rotational metric is computed");
  }
  if (card.linear && card.rotation && alpha->t == signals.acceleration->t) {
    card.combined = combined_scores(*signals.acceleration, *alpha, *card.linear, *card.rotation);
  }
  if (card.linear && card.rotation && !card.combined) {
    card.notes.push_back(
        "linear and angular signals differ in time: no metric of both (GAMBIT, HIP, KLC, HARM)");
  }
  if (signals.neck) card.neck = neck_injury(*signals.neck, signals.neck_parameters);
  add_risks(card);
  return card;
}

}  // namespace crosswalk::recording
