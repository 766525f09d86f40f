#include "coupler/coupler.h"

#include <chrono>

#include <fmt/format.h>

#include "common/error.h"

namespace crosswalk::coupling {

Coupler::Coupler(CouplerSettings settings, MbLink& mb, FeLink* fe, RecordStream* records,
                 CouplerHooks hooks)
    : settings_(std::move(settings)),
      mb_(mb),
      fe_(fe),
      records_(records),
      hooks_(std::move(hooks)),
      audit_(settings_.limits) {}

std::int64_t Coupler::run(const std::vector<InterfaceBody>& bodies) {
  if (state_.window == 0) state_ = start_state(bodies);
  while (advance()) {
  }
  return state_.window;
}

void Coupler::save(ByteWriter& out) const {
  coupling::save(state_, out);
  out.value(audit_.books());
  out.value(seen_);
}

void Coupler::load(ByteReader& in) {
  state_ = load_coupling_state(in);
  audit_.continue_from(in.take<EnergyAudit::Books>());
  in.value(seen_);
}

bool Coupler::advance() {
  hooks_.before_window(state_.window);
  const auto begin = std::chrono::steady_clock::now();
  const WindowResult result =
      fe_ != nullptr ? advance_window(settings_.scheme, state_, settings_.window_ns, mb_, *fe_)
                     : advance_multibody(state_, settings_.window_ns, mb_);
  audit_.book(result, state_);
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  note_events(result);  // first, so that a window's audit proves that its events exist
  publish_audit(wall_s);

  const std::int64_t now_ns = state_.window * settings_.window_ns;
  hooks_.progress(
      {state_.window - 1, now_ns, end_ns(), audit_.balance_percent(), seen_.head_contact});
  hooks_.after_window(state_.window);
  return now_ns < end_ns();
}

std::int64_t Coupler::end_ns() const {
  const std::int64_t start =
      seen_.contact_ns >= 0 ? seen_.contact_ns : state_.window * settings_.window_ns;
  return start + settings_.duration_ns;
}

void Coupler::publish_audit(double wall_s) {
  if (records_ == nullptr) return;
  msg::coupling_audit m = audit_.message();
  m.resends = hooks_.resends();
  m.wall_us = static_cast<int>(1e6 * wall_s);
  records_->publish(m);
}

void Coupler::note_events(const WindowResult& result) {
  const std::int64_t t_ns = (result.id.window + 1) * settings_.window_ns;
  const auto tell = [&](EventLevel level, const std::string& text) {
    if (records_ != nullptr) records_->event(t_ns, level, text);
    hooks_.tell(level, text);
  };
  if (seen_.contact_ns < 0 && result.mb.first_contact) {
    seen_.contact_ns = t_ns;
    tell(EventLevel::Info, fmt::format("first contact of car and pedestrian at t = {:.3f} ms",
                                       1e-6 * static_cast<double>(t_ns)));
  }
  if (seen_.contact_ns < 0 && t_ns > settings_.first_contact_ns) {
    throw NumericalError(
        1e-9 * static_cast<double>(t_ns),
        "car and pedestrian have not touched; check posture, speed and the start gap of [vehicle]");
  }
  // 10 N, the threshold of the first contact as well.
  if (!seen_.head_contact && result.fe.head_contact_force > 10) {
    seen_.head_contact = true;
    tell(EventLevel::Info, fmt::format("the head touches the car at t = {:.3f} ms",
                                       1e-6 * static_cast<double>(t_ns)));
  }
  if (result.parts > 1 && ++seen_.in_parts == 1) {
    tell(EventLevel::Warning, fmt::format("the implicit iteration did not converge on window {}; "
                                          "it was done in {} parts",
                                          result.id.window, result.parts));
  }
  if (!result.converged && ++seen_.not_converged == 1) {
    tell(EventLevel::Warning,
         fmt::format("the implicit iteration of window {} stopped at a residual of {:.1e}",
                     result.id.window, result.residual));
  }
  while (const auto warning = audit_.new_warning()) tell(EventLevel::Warning, *warning);
}

}  // namespace crosswalk::coupling
