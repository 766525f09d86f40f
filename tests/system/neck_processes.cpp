#include "tests/system/neck_processes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace crosswalk::system_test {

using namespace coupling;

ToyScenario scenario_of(const NeckCase& c, int window_us, double end) {
  std::string tables = "scheme = \"mic\"\n[[interfaces]]\nbody = \"torso\"\n";
  if (c.has_clavicles)
    tables +=
        "[[interfaces]]\nbody = \"clavicle_left\"\n[[interfaces]]\nbody = \"clavicle_right\"\n";
  tables += fmt::format(
      "[multibody]\nmass_kg = {}\nstep_s = {}\npush_N = {}\nspin_x_rad_s = {}\nspin_y_rad_s = {}\n"
      "spin_z_rad_s = {}\n[fe]\nstep_s = {}\ndamping_ratio = {}\n",
      c.body_mass, c.mb_step, c.push, c.spin.x(), c.spin.y(), c.spin.z(), c.fe_step,
      c.damping_ratio);
  return {.tables = tables,
          .window_ns = 1000 * window_us,
          .windows = static_cast<int>(std::lround(1e6 * end / window_us))};
}

NeckOutcome neck_after(const NeckCase& c, const ToyOutcome& outcome) {
  CoupledNeck neck(c, Scheme::Mic);
  neck.mb().load_state(outcome.mb);
  neck.fe().load_state(outcome.fe);
  neck.state() = outcome.coupling;
  NeckOutcome out{.energy = outcome.books.total,
                  .peak_energy = outcome.books.peak,
                  .drift = outcome.books.work_mb + outcome.books.work_fe,
                  .gap = outcome.books.largest_gap_m};
  neck.note_now(out);
  return out;
}

void expect_near_whole(const std::vector<NeckCase>& cases, const std::vector<int>& windows_us) {
  constexpr double kEnd = 100e-3;
  const TemporaryFolder folder;
  std::vector<ToyScenario> scenarios;
  for (const NeckCase& c : cases)
    for (const int us : windows_us) scenarios.push_back(scenario_of(c, us, kEnd));
  const std::vector<ToyOutcome> outcomes = run_toys(folder.path(), scenarios);
  auto next = outcomes.begin();
  for (const NeckCase& c : cases) {
    const WholeNeck whole = run_whole(c, kEnd);
    std::string row = fmt::format("{} % damped, {} kg:", 100 * c.damping_ratio, c.body_mass);
    for (const int us : windows_us) {
      const NeckOutcome coupled = neck_after(c, *next++);
      const double off = (coupled.head - whole.head).norm();
      const double energy = (coupled.energy - whole.energy) / whole.peak_energy;
      row += fmt::format("  {} us {:.2f} % {:.1f} um", us, 100 * energy, 1e6 * off);
      EXPECT_LT(std::abs(energy), 0.005) << row;
      EXPECT_LT(std::abs(coupled.drift), 0.005 * whole.peak_energy) << row;
      EXPECT_LT(coupled.gap, 0.1e-3) << row;
      if (us >= 10 && us <= 50) {
        EXPECT_LT(off, 20e-6) << row;
      }
    }
    fmt::print("{}\n", row);
    std::fflush(stdout);
  }
}

}  // namespace crosswalk::system_test
