// Every scheme at every window on the lattice neck, as the tables of docs/coupling.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/coupler/neck_run.h"

namespace crosswalk::coupling {
namespace {

constexpr double kEnd = 50e-3;
constexpr std::array<std::int64_t, 7> kWindowsUs = {1, 2, 5, 10, 20, 50, 100};

std::string cell(const NeckOutcome& o, const Vec3& head, double energy, double peak) {
  if (!o.is_stable) return "X";
  return fmt::format("{:.2f} / {:.1f}", 100 * (o.energy - energy) / peak,
                     1e6 * (o.head - head).norm());
}

TEST(WindowScan, MicIsStableAtEveryWindowWithAndWithoutDamping) {
  for (const double damping : {0.05, 0.0}) {
    for (const double mass : {15.0, 1.0, 0.3, 0.1}) {
      const NeckCase c = pushed_neck(mass, damping);
      const WholeNeck whole = run_whole(c, kEnd);
      for (const Scheme scheme : {Scheme::Mic, Scheme::Implicit, Scheme::Staggered}) {
        std::string row =
            fmt::format("| {} % | {} kg | {} |", 100 * damping, mass, scheme_name(scheme));
        for (const std::int64_t us : kWindowsUs) {
          const NeckOutcome o = CoupledNeck(c, scheme).run(1000 * us, kEnd);
          row += " " + cell(o, whole.head, whole.energy, whole.peak_energy) + " |";
          if (scheme != Scheme::Mic) continue;
          EXPECT_TRUE(o.is_stable) << row;
          EXPECT_NEAR(o.energy, whole.energy, 0.005 * whole.peak_energy) << row;
        }
        fmt::print("{}\n", row);
        std::fflush(stdout);
      }
    }
  }
}

TEST(WindowScan, ThreeBodiesOnJoints) {
  for (const bool has_wall : {false, true}) {
    NeckCase fine{.has_clavicles = true, .has_wall = has_wall, .push = 4000, .mb_step = 0.5e-6};
    const NeckOutcome reference = CoupledNeck(fine, Scheme::Mic).run(500, kEnd);
    NeckCase c = fine;
    c.mb_step = 10e-6;
    for (const Scheme scheme : {Scheme::Mic, Scheme::Implicit, Scheme::Staggered}) {
      std::string row = fmt::format("| {} | {} |", has_wall ? "wall" : "free", scheme_name(scheme));
      for (const std::int64_t us : kWindowsUs) {
        const NeckOutcome o = CoupledNeck(c, scheme).run(1000 * us, kEnd);
        row += " " + cell(o, reference.head, reference.energy, reference.peak_energy) + " |";
        EXPECT_TRUE(o.is_stable || scheme != Scheme::Mic) << row;
      }
      fmt::print("{}\n", row);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace crosswalk::coupling
