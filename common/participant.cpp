#include "common/participant.h"

#include <fmt/format.h>

#include "common/message_gate.h"

namespace crosswalk {

GrantLedger::Verdict GrantLedger::judge(std::int64_t seq) const {
  if (seq == last_ + 1) return Verdict::Execute;
  if (seq == last_) return Verdict::Repeat;
  if (seq < last_) return Verdict::Ignore;
  throw ProtocolError(
      ExitCode::NodeFailed,
      fmt::format("grant {} arrived but {} was next: a grant was skipped", seq, last_ + 1));
}

void GrantLedger::executed(std::int64_t seq, std::vector<std::byte> answer) {
  last_ = seq;
  answers_.push_back(std::move(answer));
}

void GrantLedger::continue_from(std::int64_t last_seq) {
  last_ = last_seq;
  before_ = last_seq + 1;
  answers_.clear();
}

const std::vector<std::byte>* GrantLedger::answer(std::int64_t seq) const {
  if (seq < before_ || seq > last_) return nullptr;
  return &answers_[static_cast<std::size_t>(seq - before_)];
}

namespace {

// A number from a peer that cannot be true ends the run here, before any solver sees it.
template <class M>
void require_plausible(const M& m, const std::string& what) {
  if (const auto problem = problem_in(m)) {
    throw ProtocolError(ExitCode::NumericalLimit, fmt::format("{}: {}", what, *problem));
  }
}

void resend_answers(Bus& bus, MessageKind kind, const GrantLedger& ledger,
                    const msg::resend_request& request) {
  if (request.kind != static_cast<int>(kind)) return;
  const std::int64_t first = std::max<std::int64_t>(request.first, 0);
  for (std::int64_t seq = first; seq <= std::min(request.last, first + 255); ++seq) {
    const std::vector<std::byte>* answer = ledger.answer(seq);
    if (answer == nullptr) return;
    bus.send(kind, *answer);
  }
}

// After the usual set-up, back to the state of the checkpoint.
template <class Participant>
void continue_run(Participant& participant, GrantLedger& ledger, RecordStream& records,
                  const std::optional<CheckpointPart>& part) {
  if (!part) return;
  participant.load_state(part->state);
  ledger.continue_from(part->last_seq);
  records.continue_from(part->n_records);
}

std::string window_text(std::int64_t window, std::int64_t window_ns) {
  return fmt::format("window {} (t = {:.3f} ms)", window,
                     1e-6 * static_cast<double>(window * window_ns));
}

int elapsed_us(Bus::Clock::time_point since) {
  return static_cast<int>(
      std::chrono::duration_cast<std::chrono::microseconds>(Bus::Clock::now() - since).count());
}

// The node's own failure in a window: told as an event and as an answer, then raised.
template <class Reply, class M>
[[noreturn]] void fail(Bus& bus, RecordStream& records, const M& grant,
                       const NumericalError& error) {
  const std::int64_t t_ns = grant.window * grant.window_ns;
  records.flush();
  records.event(t_ns, EventLevel::Error, error.what());
  Reply reply;
  reply.status = Status::Failed;
  auto done = to_message(WindowId{grant.window, grant.window_ns, grant.iteration}, reply);
  done.n_records = records.count();
  bus.publish(done, grant.h.seq);
  throw error;
}

}  // namespace

MbSession::MbSession(Bus& bus, MbParticipant& participant, NodeIdentity identity, Limits limits,
                     std::filesystem::path checkpoints)
    : NodeSession(bus, std::move(identity), limits, std::move(checkpoints)),
      participant_(participant),
      phased_(records()),
      bodies_(participant.interface_bodies()) {
  bus.subscribe<msg::boundary_mass>(Role::Coupler,
                                    [this](const msg::boundary_mass& m) { take_masses(m); });
  bus.subscribe<msg::step_to_mb>(Role::Coupler, [this](const msg::step_to_mb& m) { on_grant(m); });
}

void MbSession::on_manifest(const msg::run_manifest& manifest) {
  if (records().count() == 0) {
    records().describe(participant_.description());
    if (manifest.has_fe == 0)
      continue_run(participant_, ledger_, records(), part_to_continue_from());
  }
  bus_.publish(motion_message(bodies_), 0);
}

void MbSession::on_control(const msg::run_control& control) {
  if (control.command == static_cast<int>(Command::Checkpoint)) {
    write_checkpoint({control.window, ledger_.last(), 0, participant_.save_state()});
  }
}

void MbSession::on_resend(const msg::resend_request& request) {
  resend_answers(bus_, MessageKind::MbDone, ledger_, request);
}

void MbSession::take_masses(const msg::boundary_mass& m) {
  if (!is_from_my_coupler(m.h) || m.n_bodies != static_cast<int>(bodies_.size())) return;
  require_plausible(m, "block masses from fe_node");
  if (!has_masses_) {
    read_mass(m, bodies_);
    participant_.attach(bodies_);
    continue_run(participant_, ledger_, records(), part_to_continue_from());
    has_masses_ = true;
    set_state(NodeState::Waiting, -1);
  }
  heard_coupler();
  bus_.publish(mass_message(bodies_), 0);
}

void MbSession::on_grant(const msg::step_to_mb& m) {
  if (!is_from_my_coupler(m.h)) return;
  heard_coupler();
  switch (ledger_.judge(m.h.seq)) {
    case GrantLedger::Verdict::Execute:
      execute(m);
      break;
    case GrantLedger::Verdict::Repeat:
      if (!mobility_.empty()) bus_.send(MessageKind::Mobility, mobility_);
      bus_.send(MessageKind::MbDone, *ledger_.answer(m.h.seq));
      break;
    case GrantLedger::Verdict::Ignore:
      break;
  }
  heard_coupler();
}

void MbSession::execute(const msg::step_to_mb& m) {
  require_plausible(m, "grant of " + window_text(m.window, m.window_ns));
  set_state(NodeState::Solving, m.window);
  const auto begin = Bus::Clock::now();
  const MbGrant grant = from_message(m);
  try {
    const MbReply reply = phased_.advance(participant_, grant);
    if ((m.window + 1) % kWindowsPerFlush == 0) records().flush();
    mobility_.clear();
    if (reply.mobility.size() > 0) {
      msg::mobility mobility = to_message(reply.mobility);
      mobility.id = static_cast<int>(m.h.seq);
      mobility.window = m.window;
      mobility_ = bus_.publish(mobility, m.h.seq);
    }
    msg::mb_done done = to_message(grant.id, reply);
    done.n_records = records().count();
    done.work_us = elapsed_us(begin);
    ledger_.executed(m.h.seq, bus_.publish(done, m.h.seq));
  } catch (const NumericalError& error) {
    fail<MbReply>(bus_, records(), m, error);
  }
  set_state(NodeState::Waiting, m.window);
}

FeSession::FeSession(Bus& bus, FeParticipant& participant, NodeIdentity identity, Limits limits,
                     std::filesystem::path checkpoints)
    : NodeSession(bus, std::move(identity), limits, std::move(checkpoints)),
      participant_(participant),
      phased_(records()),
      bodies_(participant.interface_bodies()) {
  bus.subscribe<msg::boundary_motion>(Role::Coupler,
                                      [this](const msg::boundary_motion& m) { take_motion(m); });
  bus.subscribe<msg::step_to_fe>(Role::Coupler, [this](const msg::step_to_fe& m) { on_grant(m); });
  for (const Role sender : {Role::Mb, Role::Coupler}) {
    bus.subscribe<msg::mobility>(sender, [this](const msg::mobility& m) { take_mobility(m); });
  }
}

void FeSession::on_control(const msg::run_control& control) {
  if (control.command == static_cast<int>(Command::Checkpoint)) {
    write_checkpoint({control.window, ledger_.last(), 0, participant_.save_state()});
  }
}

void FeSession::on_resend(const msg::resend_request& request) {
  resend_answers(bus_, MessageKind::FeDone, ledger_, request);
}

void FeSession::take_motion(const msg::boundary_motion& m) {
  if (!is_from_my_coupler(m.h) || m.n_bodies != static_cast<int>(bodies_.size())) return;
  require_plausible(m, "initial motion from mb_node");
  if (!is_placed_) {
    read_motion(m, bodies_);
    bodies_ = participant_.place(std::move(bodies_));
    records().describe(participant_.description());
    continue_run(participant_, ledger_, records(), part_to_continue_from());
    is_placed_ = true;
    set_state(NodeState::Waiting, -1);
  }
  heard_coupler();
  bus_.publish(mass_message(bodies_), 0);
}

void FeSession::take_mobility(const msg::mobility& m) {
  // Every mobility of the run is kept by its id until newer ones have replaced it in use.
  constexpr std::size_t kKept = 8;
  if (problem_in(m) || mobilities_.contains(m.id)) return;
  mobilities_[m.id] = from_message(m);
  while (mobilities_.size() > kKept) mobilities_.erase(mobilities_.begin());
  if (waiting_grant_ && waiting_grant_->mobility_id == m.id) {
    const msg::step_to_fe grant = *waiting_grant_;
    waiting_grant_.reset();
    on_grant(grant);
  }
}

void FeSession::on_grant(const msg::step_to_fe& m) {
  if (!is_from_my_coupler(m.h)) return;
  heard_coupler();
  switch (ledger_.judge(m.h.seq)) {
    case GrantLedger::Verdict::Execute:
      if (m.mobility_id >= 0 && !mobilities_.contains(m.mobility_id)) {
        waiting_grant_ = m;
      } else {
        execute(m);
      }
      break;
    case GrantLedger::Verdict::Repeat:
      bus_.send(MessageKind::FeDone, *ledger_.answer(m.h.seq));
      break;
    case GrantLedger::Verdict::Ignore:
      break;
  }
  heard_coupler();
}

void FeSession::execute(const msg::step_to_fe& m) {
  require_plausible(m, "grant of " + window_text(m.window, m.window_ns));
  set_state(NodeState::Solving, m.window);
  const auto begin = Bus::Clock::now();
  FeGrant grant = from_message(m);
  if (m.mobility_id >= 0) grant.mobility = mobilities_.at(m.mobility_id);
  try {
    const FeReply reply = phased_.advance(participant_, grant);
    if ((m.window + 1) % kWindowsPerFlush == 0) records().flush();
    msg::fe_done done = to_message(grant.id, reply);
    done.n_records = records().count();
    done.work_us = elapsed_us(begin);
    ledger_.executed(m.h.seq, bus_.publish(done, m.h.seq));
  } catch (const NumericalError& error) {
    fail<FeReply>(bus_, records(), m, error);
  }
  set_state(NodeState::Waiting, m.window);
}

}  // namespace crosswalk
