#include "coupler/coupler_config.h"

#include <cmath>

namespace crosswalk::coupling {

CouplerConfig read_coupling(ConfigDocument& document, const Scenario& scenario) {
  CouplerConfig config;
  CouplerSettings& s = config.settings;
  ConfigTable table =
      document.root().table("coupling", "how both solvers are coupled (docs/coupling.md)");

  const std::string scheme = table.choice_or("scheme", {"mic", "implicit", "staggered"}, "mic",
                                             "coupling scheme; staggered only for comparison");
  s.scheme.scheme = scheme == "implicit"    ? Scheme::Implicit
                    : scheme == "staggered" ? Scheme::Staggered
                                            : Scheme::Mic;
  const double window = table.quantity_or("window", Dimension::Time, {1e-6, 2e-4}, 20e-6,
                                          "length of a coupling window");
  s.window_ns = std::llround(1e9 * window);
  s.scheme.mobility_every = table.integer_or("mobility_every_windows", 1, 100000, 50,
                                             "windows between measurements of the mobility");
  s.scheme.tolerance =
      table.quantity_or("tolerance", Dimension::None, {1e-9, 1e-1}, 1e-4,
                        "implicit: relative change of the wrench at which a window is done");
  s.scheme.accepted_residual =
      table.quantity_or("accepted_residual", Dimension::None, {1e-9, 1}, 1e-3,
                        "implicit: residual still accepted, with a warning, after max_iterations");
  s.scheme.max_iterations = table.integer_or(
      "max_iterations", 2, 200, 20, "implicit: passes of the finite-element side per window");
  s.scheme.anderson_depth = table.integer_or(
      "anderson_depth", 0, 20, 5, "implicit: past iterates used by Anderson acceleration");
  s.limits.drift_warn = table.quantity_or("drift_warn", Dimension::None, {1e-6, 1}, 0.005,
                                          "interface energy error, of the peak energy, that warns");
  s.limits.drift_stop =
      table.quantity_or("drift_stop", Dimension::None, {1e-6, 10}, 0.02,
                        "interface energy error, of the peak energy, that ends the run");
  s.first_contact_ns =
      std::llround(1e9 * table.quantity_or("first_contact_before", Dimension::Time, kPositive, 0.15,
                                           "car and pedestrian must touch before this time"));
  const double checkpoint = table.quantity_or("checkpoint_every", Dimension::Time, kNonNegative,
                                              0.02, "simulated time between checkpoints; 0: none");
  const std::int64_t windows = std::llround(1e9 * checkpoint) / s.window_ns;
  config.checkpoint_every = (windows + kWindowsPerFlush - 1) / kWindowsPerFlush * kWindowsPerFlush;
  Patience& p = config.patience;
  p.silent_s = table.quantity_or("silent_after", Dimension::Time, {1, 1e6}, 15,
                                 "a node without heartbeat for so long ends the run");
  p.stalled_s =
      table.quantity_or("stalled_after", Dimension::Time, {1, 1e6}, 120,
                        "a node that is alive but does not advance for so long ends the run");
  s.duration_ns = scenario.duration_ns();
  s.has_fe = scenario.has_fe();
  return config;
}

}  // namespace crosswalk::coupling
