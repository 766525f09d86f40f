// The lockstep clients: they turn grants into calls of a participant's verbs, exactly once each.
//
// A grant with the next number is executed and its answer kept; the same number again gets the kept
// answer; an older one is ignored. So lost, doubled and reordered messages cannot change a result.
#pragma once

#include <map>

#include "common/exchange.h"
#include "common/node_session.h"

namespace crosswalk {

/// Number of the last grant executed and the encoded answers to it.
class GrantLedger {
 public:
  enum class Verdict { Execute, Repeat, Ignore };
  /// Throws ProtocolError when `seq` skips a grant.
  Verdict judge(std::int64_t seq) const;
  void executed(std::int64_t seq, std::vector<std::byte> answer);
  std::int64_t last() const { return last_; }
  /// Continues the numbering of a checkpoint.
  void continue_from(std::int64_t last_seq);
  /// All answers kept, by number: the recorder may have missed any of them.
  const std::vector<std::byte>* answer(std::int64_t seq) const;

 private:
  std::int64_t last_ = -1;
  std::int64_t before_ = 0;  ///< number of the first answer kept
  std::vector<std::vector<std::byte>> answers_;
};

/// Calls a participant so that only windows done for good reach the records.
class PhasedRecords {
 public:
  explicit PhasedRecords(RecordStream& records) : records_(records) {}
  template <class Participant, class Grant>
  auto advance(Participant& participant, const Grant& grant) {
    if (grant.id.phase == Phase::Advance) return participant.advance(grant, records_);
    if (grant.id.phase == Phase::Evaluate) deferred_.clear();
    auto reply = participant.advance(grant, deferred_);
    if (grant.id.phase == Phase::Accept) deferred_.replay(records_);
    return reply;
  }

 private:
  RecordStream& records_;
  DeferredRecords deferred_;
};

class MbSession : public NodeSession {
 public:
  MbSession(Bus& bus, MbParticipant& participant, NodeIdentity identity, Limits limits,
            std::filesystem::path checkpoints = {});

 private:
  void on_manifest(const msg::run_manifest& manifest) override;
  void on_control(const msg::run_control& control) override;
  void on_resend(const msg::resend_request& request) override;
  std::int64_t progress() const override { return participant_.progress(); }
  void take_masses(const msg::boundary_mass& m);
  void on_grant(const msg::step_to_mb& m);
  void execute(const msg::step_to_mb& m);

  MbParticipant& participant_;
  GrantLedger ledger_;
  PhasedRecords phased_;
  std::vector<InterfaceBody> bodies_;
  bool has_masses_ = false;
  std::vector<std::byte> mobility_;  ///< measured for the last grant, or empty
};

class FeSession : public NodeSession {
 public:
  FeSession(Bus& bus, FeParticipant& participant, NodeIdentity identity, Limits limits,
            std::filesystem::path checkpoints = {});

 private:
  void on_manifest(const msg::run_manifest&) override {}
  void on_control(const msg::run_control& control) override;
  void on_resend(const msg::resend_request& request) override;
  std::int64_t progress() const override { return participant_.progress(); }
  void take_motion(const msg::boundary_motion& m);
  void take_mobility(const msg::mobility& m);
  void on_grant(const msg::step_to_fe& m);
  void execute(const msg::step_to_fe& m);

  FeParticipant& participant_;
  GrantLedger ledger_;
  PhasedRecords phased_;
  std::vector<InterfaceBody> bodies_;
  bool is_placed_ = false;
  std::map<int, Eigen::MatrixXd> mobilities_;     ///< the latest few, by id
  std::optional<msg::step_to_fe> waiting_grant_;  ///< its mobility has not arrived yet
};

}  // namespace crosswalk
