// The solver nodes at the other end of the bus: a numbered request, sent again while unanswered.
#pragma once

#include "coupler/hub.h"

namespace crosswalk::coupling {

/// Smoothed time a node takes to answer, for the resend time-out.
class AnswerTime {
 public:
  void note(double seconds) { smoothed_ = 0.9 * smoothed_ + 0.1 * seconds; }
  double resend_after(const Patience& patience) const {
    return std::clamp(3 * smoothed_, patience.first_resend_s, patience.longest_resend_s);
  }

 private:
  double smoothed_ = 0;
};

class LcmMbLink : public MbLink {
 public:
  explicit LcmMbLink(Hub& hub);
  MbReply advance(const MbGrant& grant) override;
  /// Number of the mobility last received, to name it to fe; -1 before the first.
  int mobility_id() const { return mobility_.id; }
  const msg::mobility& mobility() const { return mobility_; }
  /// Numbers to save and to continue from; the mobility is the one in use.
  std::int64_t last_seq() const { return seq_; }
  void continue_from(std::int64_t last_seq, int mobility_id, const Eigen::MatrixXd& mobility);

 private:
  Hub& hub_;
  std::int64_t seq_ = -1;
  msg::mb_done done_{};
  msg::mobility mobility_{};
  AnswerTime time_;
};

class LcmFeLink : public FeLink {
 public:
  LcmFeLink(Hub& hub, const LcmMbLink& mb);
  FeReply advance(const FeGrant& grant) override;
  std::int64_t last_seq() const { return seq_; }
  /// Tells fe_node the mobility anew, as it may have started afresh.
  void continue_from(std::int64_t last_seq);

 private:
  Hub& hub_;
  const LcmMbLink& mb_;
  std::int64_t seq_ = -1;
  msg::fe_done done_{};
  AnswerTime time_;
};

}  // namespace crosswalk::coupling
