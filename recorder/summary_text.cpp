// summary.txt: the table a newcomer reads at the end of a run.
#include <algorithm>

#include <fmt/format.h>

#include "recorder/summary.h"

namespace crosswalk::recording {

namespace {

constexpr std::size_t kWidth = 96;

class Table {
 public:
  void title(const std::string& text) { out_ += text + "\n" + std::string(kWidth, '-') + "\n"; }
  void row(const std::string& what, const std::string& value, const std::string& remark = {}) {
    std::string line = fmt::format("  {:<34}{:>14}   {}", what, value, remark);
    this->line(line);
  }
  void line(std::string text) {
    while (!text.empty() && text.back() == ' ') text.pop_back();
    out_ += text + "\n";
  }
  void text(const std::string& mark, const std::string& words) {
    std::string line = "  " + mark;
    std::size_t from = 0;
    while (from < words.size()) {
      const std::size_t to = std::min(words.find(' ', from), words.size());
      if (line.size() + to - from + 1 > kWidth && line.size() > mark.size() + 2) {
        out_ += line + "\n";
        line = std::string(mark.size() + 2, ' ');
      }
      line += " " + words.substr(from, to - from);
      from = to + 1;
    }
    out_ += line + "\n";
  }
  void gap() { out_ += "\n"; }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

void head_rows(Table& t, const Summary& s) {
  t.title("Head");
  if (s.head_contact) {
    const HeadContact& c = *s.head_contact;
    t.row("first contact with the car", fmt::format("{:.1f} ms", 1e3 * c.time),
          "after leg contact; against: " + c.partner);
    t.row("speed relative to the buck", fmt::format("{:.2f} m/s", c.relative_speed),
          c.buck_speed > 0 ? fmt::format("{:.2f} of buck speed, just before contact",
                                         c.relative_speed / c.buck_speed)
                           : "");
    if (c.wrap_around_distance) {
      t.row("wrap-around distance", fmt::format("{:.0f} mm", 1e3 * *c.wrap_around_distance));
    }
    t.row("peak contact force", fmt::format("{:.2f} kN", 1e-3 * c.peak_force));
  } else {
    t.row("contact with the car", "none", "no head force above 50 N");
  }
  if (s.card.linear) {
    const LinearScores& l = *s.card.linear;
    t.row("peak acceleration", fmt::format("{:.1f} g", l.peak_g), "resultant, CFC 1000");
    t.row("HIC15", fmt::format("{:.0f}", l.HIC15.value),
          l.HIC15.t1 ? fmt::format("{:.1f} .. {:.1f} ms; limit 700 (FMVSS 208)", 1e3 * *l.HIC15.t1,
                                   1e3 * *l.HIC15.t2)
                     : "");
    if (l.clip_single)
      t.row("3 ms acceleration", fmt::format("{:.1f} g", l.clip_single->value), "limit 80 g");
  }
  if (s.card.rotation) {
    const RotationScores& r = *s.card.rotation;
    t.row("BrIC", fmt::format("{:.2f}", r.BrIC.avg),
          fmt::format("peak angular velocity {:.1f} rad/s", r.peak_w));
    t.row("DAMAGE", fmt::format("{:.2f}", r.DAMAGE.value), "Euro NCAP band 0.42 .. 0.47");
  }
  t.gap();
}

constexpr double kThrowShown = 0.5;  // s: no pedestrian is at rest before

void aftermath_rows(Table& t, const Summary& s) {
  const auto& [road, thrown] = s.after;
  const bool is_long = thrown && thrown->end_time > kThrowShown;
  if (!road && !is_long) return;
  t.title("After the car");
  if (is_long) {
    t.row("throw distance", fmt::format("{:.2f} m", thrown->distance),
          thrown->rest_time
              ? fmt::format("centre of mass, along the car's travel; at rest after {:.0f} ms",
                            1e3 * *thrown->rest_time)
              : fmt::format("so far: the body still moves at {:.2f} m/s", thrown->end_speed));
    t.row("highest centre of mass", fmt::format("{:.2f} m", thrown->highest));
  }
  if (road) {
    t.row("head on the road", fmt::format("{:.0f} ms", 1e3 * road->time),
          fmt::format("peak force {:.2f} kN, peak acceleration {:.0f} g", 1e-3 * road->peak_force,
                      road->peak_g));
    t.row("HIC15 on the road", fmt::format("{:.0f}", road->HIC15.value),
          fmt::format("{:.0f} before it, from the car", road->HIC15_before.value));
  } else {
    t.row("head on the road", "no", "no force above 50 N");
  }
  t.gap();
}

void tissue_rows(Table& t, const Summary& s) {
  if (s.tissue.empty()) return;
  t.title("Brain tissue (first principal Green strain)");
  for (const RegionPeak& p : s.tissue) {
    t.row(p.region + " MPS95", fmt::format("{:.3f}", p.mps_95_so_far),
          fmt::format("CSDM 0.15: {:.2f}, CSDM 0.25: {:.2f}", p.csdm_15, p.csdm_25));
  }
  t.gap();
}

void energy_table(Table& t, const Summary& s) {
  if (!s.mb) return;
  t.title("Energy of the bodies at the end, J");
  std::string line;
  std::vector<std::pair<std::string, double>> rows = energy_rows(s.mb->end);
  rows.emplace(rows.begin(), "held at the start", s.mb->start);
  for (auto& [name, energy] : rows) {
    std::replace(name.begin(), name.end(), '_', ' ');
    line += fmt::format("  {:<30}{:>10.1f}", name, energy);
    if (line.size() < 50) {
      line += "    ";
      continue;
    }
    t.line(line);
    line.clear();
  }
  if (!line.empty()) t.line(line);
  t.gap();
}

void quality_rows(Table& t, const Summary& s) {
  t.title("Quality of the run");
  if (s.mb) {
    t.row("multibody energy balance", fmt::format("{:.2f} %", s.mb->balance_percent),
          "of the peak kinetic energy, all laws; limit 1 %");
  }
  if (s.fe) {
    t.row("finite-element energy balance", fmt::format("{:.2f} %", s.fe->balance_percent),
          "limit 2 %");
    t.row("hourglass energy", fmt::format("{:.2f} %", s.fe->hourglass_percent),
          "of internal energy, limit 10 %");
    if (!s.tissue.empty())
      t.row(s.tissue.front().region + " inside out",
            fmt::format("{:.2f} %", 100 * s.tissue.front().inside_out),
            fmt::format("largest share of bricks with a corner so, limit {:g} %",
                        kInsideOutLimitPercent));
    t.row("added mass", fmt::format("{:.1f} g", 1e3 * s.fe->added_mass),
          s.fe->added_mass_percent ? fmt::format("{:.2f} %, limit 2 %", *s.fe->added_mass_percent)
                                   : "");
  }
  if (s.coupling) {
    if (s.fe) {
      t.row("interface audit drift", fmt::format("{:.3f} %", s.coupling->drift_percent),
            fmt::format("of {:.3g} J exchanged, limit 1 %", s.coupling->exchanged));
      t.row("coupling error",
            fmt::format("{:.3g} N, {:.2g} mm", s.coupling->owed_force, s.coupling->gap_mm),
            fmt::format("largest force one window late, largest gap; {:.2g} J lost or gained",
                        s.coupling->drift));
    }
    t.row("energy balance of both sides", fmt::format("{:.2f} %", s.coupling->balance_percent),
          "of the peak energy");
    t.row("messages sent again", fmt::format("{}", s.coupling->resends));
  }
  t.row("record", s.is_complete ? "complete" : "INCOMPLETE",
        s.is_complete ? fmt::format("{} messages", s.messages) : "see the warnings below");
  t.row("wall time", fmt::format("{:.1f} s", s.timing.wall),
        fmt::format("multibody {:.1f} s, finite elements {:.1f} s", s.timing.mb, s.timing.fe));
  if (s.timing.wall > 0)
    t.row("coupling overhead", fmt::format("{:.1f} %", 100 * s.timing.exchange / s.timing.wall),
          fmt::format("of the wall time, {:.1f} s in which neither side computed",
                      s.timing.exchange));
  t.gap();
}

void band_rows(Table& t, const Summary& s) {
  if (s.bands.empty()) return;
  t.title("Against what is known of the test");
  for (const BandVerdict& v : s.bands) {
    const std::string range =
        fmt::format("{:g} .. {:g} ({})", v.band.low, v.band.high, v.band.status);
    t.row(v.band.quantity, v.value ? fmt::format("{:.4g}", *v.value) : "-",
          fmt::format("{:<10}{}", v.value ? (v.is_inside ? "inside" : "OUTSIDE") : "no value",
                      range));
  }
  t.gap();
}

void rating_rows(Table& t, const Summary& s) {
  if (s.ratings.empty()) return;
  t.title("Ratings against your curves (CORA defaults, whole common interval)");
  for (const SignalRating& r : s.ratings) {
    if (!r.fault.empty()) {
      t.row(r.signal.label, "-", r.fault);
      continue;
    }
    t.row(r.signal.label, fmt::format("C {:.3f}", r.cora->C),
          fmt::format("C1 {:.3f}, V {:.3f}, G {:.3f}, P {:.3f}; ISO 18571 R {:.3f} ({})",
                      r.cora->C1, r.cora->V, r.cora->G, r.cora->P, r.iso ? r.iso->R : 0.0,
                      r.iso ? r.iso->grade : "-"));
  }
  t.gap();
}

}  // namespace

std::string to_text(const Summary& s) {
  Table t;
  t.title(fmt::format("{} · {} · {:.1f} ms simulated in {} windows of {:g} us", s.manifest.scenario,
                      s.manifest.mode(), 1e3 * s.simulated, s.windows,
                      1e-3 * static_cast<double>(s.manifest.window_ns)));
  if (s.initial_buck_speed) {
    t.row("buck speed", fmt::format("{:.1f} km/h", 3.6 * *s.initial_buck_speed));
  }
  t.row("first contact of car and leg",
        s.has_first_contact ? fmt::format("{:.2f} ms", 1e3 * s.t0) : "none",
        s.has_first_contact ? "of simulated time; zero of all times below" : "");
  t.gap();
  head_rows(t, s);
  aftermath_rows(t, s);
  tissue_rows(t, s);
  energy_table(t, s);
  quality_rows(t, s);
  band_rows(t, s);
  rating_rows(t, s);
  if (!s.warnings.empty()) {
    t.title(fmt::format("Warnings ({})", s.warnings.size()));
    for (const std::string& warning : s.warnings) t.text("!", warning);
    t.gap();
  }
  for (const std::string& statement : s.statements) t.text("*", statement);
  return t.take();
}

}  // namespace crosswalk::recording
