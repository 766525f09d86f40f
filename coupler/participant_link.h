// How the coupler reaches the two solvers: by messages in production (lcm_link.h), by direct calls
// in tests.
#pragma once

#include "common/exchange.h"

namespace crosswalk::coupling {

class MbLink {
 public:
  virtual ~MbLink() = default;
  /// Does the window. The reply's mobility is filled when the grant asks for it.
  virtual MbReply advance(const MbGrant& grant) = 0;
};

class FeLink {
 public:
  virtual ~FeLink() = default;
  virtual FeReply advance(const FeGrant& grant) = 0;
};

/// A participant in the same process, seen through the same rounding as over the wire.
class DirectMbLink : public MbLink {
 public:
  DirectMbLink(MbParticipant& participant, RecordSink& sink)
      : participant_(participant), sink_(sink) {}
  MbReply advance(const MbGrant& grant) override { return participant_.advance(grant, sink_); }

 private:
  MbParticipant& participant_;
  RecordSink& sink_;
};

class DirectFeLink : public FeLink {
 public:
  DirectFeLink(FeParticipant& participant, RecordSink& sink)
      : participant_(participant), sink_(sink) {}
  FeReply advance(const FeGrant& grant) override { return participant_.advance(grant, sink_); }

 private:
  FeParticipant& participant_;
  RecordSink& sink_;
};

}  // namespace crosswalk::coupling
