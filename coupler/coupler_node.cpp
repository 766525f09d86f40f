#include "coupler/coupler_node.h"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/interrupt.h"
#include "common/log.h"
#include "common/node_session.h"
#include "common/version.h"
#include "coupler/coupler_part.h"

namespace crosswalk::coupling {

namespace {

void tell(EventLevel level, const std::string& text) {
  constexpr const char* kNames[] = {"info", "warning", "error"};
  const char* name = kNames[std::clamp(static_cast<int>(level), 0, 2)];
  fmt::print("@event {} {}\n", name, wire_text(text));
  std::fflush(stdout);
  log_text(level == EventLevel::Info      ? LogLevel::Info
           : level == EventLevel::Warning ? LogLevel::Warning
                                          : LogLevel::Error,
           text);
}

// At most ten lines a second, and the last window's.
class ProgressLine {
 public:
  void show(const Progress& p) {
    const auto now = Bus::Clock::now();
    if (now - shown_ < std::chrono::milliseconds(100) && p.t_ns < p.end_ns) return;
    shown_ = now;
    fmt::print("@progress {:.3f} {:.3f} {:.4f} {}\n", 1e-6 * static_cast<double>(p.t_ns),
               1e-6 * static_cast<double>(p.end_ns), p.balance_percent, p.head_contact ? 1 : 0);
    std::fflush(stdout);
  }

 private:
  Bus::Clock::time_point shown_{};
};

std::string description(const CouplerSettings& s, const std::vector<InterfaceBody>& bodies) {
  nlohmann::ordered_json out;
  out["scheme"] = scheme_name(s.scheme.scheme);
  out["window_us"] = 1e-3 * static_cast<double>(s.window_ns);
  out["duration_ms"] = 1e-6 * static_cast<double>(s.duration_ns);
  out["limits"] = {{"drift_warn", s.limits.drift_warn}, {"drift_stop", s.limits.drift_stop}};
  for (const InterfaceBody& body : bodies) {
    out["interfaces"].push_back(
        {{"body", body.name}, {"attached", body.is_attached}, {"block_mass_kg", body.block.mass}});
  }
  return out.dump();
}

}  // namespace

ExitCode run_coupler(RunContext& context) {
  CouplerConfig config = read_coupling(context.document, context.scenario);
  context.document.finish();
  CouplerSettings& settings = config.settings;
  config.patience.join_s = context.wait_s;
  if (settings.has_fe && settings.scheme.scheme == Scheme::Staggered) {
    tell(EventLevel::Warning,
         "scheme = \"staggered\" lags the force by one window and can gain energy; "
         "it is for comparison only");
  }

  const std::filesystem::path checkpoints = context.directory.checkpoints();
  const std::int64_t first_window = context.resume ? checkpoint_to_resume(checkpoints) : 0;
  Bus bus(open_transport(context.url), context.run_id, Role::Coupler,
          BusFaults::from_environment());
  Hub hub(bus,
          {.scenario_name = context.scenario.name,
           .scenario_digest = static_cast<std::int64_t>(context.scenario.digest),
           .version = version_text(),
           .has_fe = settings.has_fe,
           .scheme = static_cast<int>(settings.scheme.scheme),
           .window_ns = settings.window_ns,
           .duration_ns = settings.duration_ns,
           .first_window = first_window},
          config.patience, interrupt_flag(), tell);
  hub.claim();
  // Out here, for the nodes' answers may still come while abort() tells them to leave.
  LcmMbLink mb(hub);
  LcmFeLink fe(hub, mb);
  std::int64_t window = 0;
  try {
    const std::vector<InterfaceBody> bodies = hub.gather();
    const Heartbeat heartbeat(bus, [&hub] { return hub.status(); });
    settings.scheme.n_attached = hub.n_attached();
    hub.records().describe(description(settings, bodies));
    ProgressLine line;
    Coupler coupler(settings, mb, settings.has_fe ? &fe : nullptr, &hub.records(),
                    {.before_window =
                         [&](std::int64_t n) {
                           window = n;
                           hub.set_window(n);
                           set_log_time(1e-9 * static_cast<double>(n * settings.window_ns));
                           hub.follow_recorder(n);
                         },
                     .after_window =
                         [&](std::int64_t next) {
                           if (config.checkpoint_every == 0 || next % config.checkpoint_every != 0)
                             return;
                           hub.checkpoint(next);
                           save_part(checkpoints, next, coupler, mb, fe, hub);
                         },
                     .progress = [&](const Progress& p) { line.show(p); },
                     .tell = tell,
                     .resends = [&hub] { return hub.resends(); }});
    hub.start();
    if (first_window > 0) {
      load_part(read_part(checkpoints, Role::Coupler, first_window), coupler, mb, fe, hub);
      tell(EventLevel::Info,
           fmt::format("continues from the checkpoint of window {}", first_window));
    }
    const std::int64_t windows = coupler.run(bodies);
    log_info("{} windows done, interface energy error {:.3g} J, balance {:.3f} %", windows,
             coupler.audit().drift(), coupler.audit().balance_percent());
    return hub.finish(windows - 1) ? ExitCode::Done : ExitCode::RecordIncomplete;
  } catch (const std::exception& error) {
    hub.abort(window, error.what());
    throw;
  }
}

}  // namespace crosswalk::coupling
