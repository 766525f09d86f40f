#include "coupler/lcm_link.h"

#include <fmt/format.h>

#include "common/message_gate.h"

namespace crosswalk::coupling {

namespace {

std::string window_text(const WindowId& id) {
  return fmt::format("window {} (t = {:.3f} ms)", id.window, 1e3 * id.begin_s());
}

// What both links share once the answer is there: it must be sound and successful.
template <class Done>
void require_sound(Hub& hub, Role role, const WindowId& id, const Done& done) {
  const std::string where = fmt::format("{}, {}", role_name(role), window_text(id));
  if (done.status == static_cast<int>(Status::Failed)) {
    hub.wait_for(
        {role}, window_text(id), [&] { return !hub.peer(role).last_error.empty(); }, [] {}, 1);
    throw ProtocolError(ExitCode::NumericalLimit,
                        fmt::format("{} failed in {}: {}", role_name(role), window_text(id),
                                    hub.peer(role).last_error));
  }
  if (const auto problem = problem_in(done)) {
    throw ProtocolError(ExitCode::NumericalLimit, fmt::format("{}: {}", where, *problem));
  }
}

}  // namespace

LcmMbLink::LcmMbLink(Hub& hub) : hub_(hub) {
  done_.h.seq = -1;
  mobility_.id = -1;
  hub.bus().subscribe<msg::mb_done>(Role::Mb, [this](const msg::mb_done& m) {
    if (hub_.is_from(hub_.peer(Role::Mb), m.h) && m.h.seq == seq_) done_ = m;
  });
  hub.bus().subscribe<msg::mobility>(Role::Mb, [this](const msg::mobility& m) {
    if (hub_.is_from(hub_.peer(Role::Mb), m.h) && m.id == seq_) mobility_ = m;
  });
}

MbReply LcmMbLink::advance(const MbGrant& grant) {
  const auto begin = Bus::Clock::now();
  ++seq_;
  const std::vector<std::byte> request = hub_.bus().publish(to_message(grant), seq_);
  hub_.wait_for(
      {Role::Mb}, window_text(grant.id),
      [&] { return done_.h.seq == seq_ && (!grant.want_mobility || mobility_.id == seq_); },
      [&] { hub_.bus().send(MessageKind::StepToMb, request); },
      time_.resend_after(hub_.patience()));
  time_.note(std::chrono::duration<double>(Bus::Clock::now() - begin).count());
  require_sound(hub_, Role::Mb, grant.id, done_);
  MbReply reply = from_message(done_);
  if (grant.want_mobility) {
    if (const auto problem = problem_in(mobility_)) {
      throw ProtocolError(ExitCode::NumericalLimit, fmt::format("mb_node, {}, mobility: {}",
                                                                window_text(grant.id), *problem));
    }
    reply.mobility = from_message(mobility_);
  }
  return reply;
}

void LcmMbLink::continue_from(std::int64_t last_seq, int mobility_id,
                              const Eigen::MatrixXd& mobility) {
  seq_ = last_seq;
  if (mobility.size() > 0) mobility_ = to_message(mobility);
  mobility_.id = mobility_id;
}

LcmFeLink::LcmFeLink(Hub& hub, const LcmMbLink& mb) : hub_(hub), mb_(mb) {
  done_.h.seq = -1;
  hub.bus().subscribe<msg::fe_done>(Role::Fe, [this](const msg::fe_done& m) {
    if (hub_.is_from(hub_.peer(Role::Fe), m.h) && m.h.seq == seq_) done_ = m;
  });
}

FeReply LcmFeLink::advance(const FeGrant& grant) {
  const auto begin = Bus::Clock::now();
  ++seq_;
  const int mobility_id = grant.mobility.size() > 0 ? mb_.mobility_id() : -1;
  const std::vector<std::byte> request = hub_.bus().publish(to_message(grant, mobility_id), seq_);
  hub_.wait_for(
      {Role::Fe}, window_text(grant.id), [&] { return done_.h.seq == seq_; },
      [&] {
        if (mobility_id >= 0) hub_.bus().publish(mb_.mobility(), mobility_id);
        hub_.bus().send(MessageKind::StepToFe, request);
      },
      time_.resend_after(hub_.patience()));
  time_.note(std::chrono::duration<double>(Bus::Clock::now() - begin).count());
  require_sound(hub_, Role::Fe, grant.id, done_);
  return from_message(done_);
}

void LcmFeLink::continue_from(std::int64_t last_seq) {
  seq_ = last_seq;
  if (mb_.mobility_id() >= 0) hub_.bus().publish(mb_.mobility(), mb_.mobility_id());
}

}  // namespace crosswalk::coupling
