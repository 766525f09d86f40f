// The numbered record messages of one process, kept so that a listener can ask for what it missed.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/exchange.h"
#include "crosswalk/msg/head_kinematics.hpp"

namespace crosswalk {

class RecordStream : public RecordSink {
 public:
  explicit RecordStream(Bus& bus) : bus_(bus) {}

  void head(const HeadSample& sample) override;  ///< batched by six; see flush()
  void body_states(std::int64_t t_ns, const std::vector<Pose>& X_WB) override;
  void contact_forces(std::int64_t t_ns, const std::vector<Vec3>& forces) override;
  void tissue(const TissueSample& sample) override;
  void event(std::int64_t t_ns, EventLevel level, const std::string& text) override;
  /// Sends a JSON text in pieces.
  void describe(const std::string& json);
  /// Sends head samples that wait for their batch to fill.
  void flush();

  template <class M>
  void publish(M message) {
    kept_.push_back({kKindOf<M>, bus_.publish(std::move(message), count())});
    count_.fetch_add(1, std::memory_order_release);
  }

  /// Continues the numbering of a checkpoint; what came before is in the recorder's log.
  void continue_from(std::int64_t n_records) {
    before_ = n_records;
    count_ = n_records;
  }

  /// Records published so far; they are numbered 0 .. count() - 1. Any thread.
  std::int64_t count() const { return count_.load(std::memory_order_acquire); }
  /// Sends the records first .. last (those that exist) again, at most 256 of them.
  void resend(std::int64_t first, std::int64_t last);

 private:
  struct Kept {
    MessageKind kind;
    std::vector<std::byte> bytes;
  };
  Bus& bus_;
  msg::head_kinematics batch_{};
  std::deque<Kept> kept_;
  std::int64_t before_ = 0;  ///< number of the first one kept
  std::atomic<std::int64_t> count_{0};
};

/// Holds the records of a window that may be done again; the accepted pass is replayed.
class DeferredRecords : public RecordSink {
 public:
  void head(const HeadSample& sample) override {
    keep([=](RecordSink& sink) { sink.head(sample); });
  }
  void body_states(std::int64_t t_ns, const std::vector<Pose>& X_WB) override {
    keep([=](RecordSink& sink) { sink.body_states(t_ns, X_WB); });
  }
  void contact_forces(std::int64_t t_ns, const std::vector<Vec3>& forces) override {
    keep([=](RecordSink& sink) { sink.contact_forces(t_ns, forces); });
  }
  void tissue(const TissueSample& sample) override {
    keep([=](RecordSink& sink) { sink.tissue(sample); });
  }
  void event(std::int64_t t_ns, EventLevel level, const std::string& text) override {
    keep([=](RecordSink& sink) { sink.event(t_ns, level, text); });
  }
  void clear() { kept_.clear(); }
  void replay(RecordSink& sink) {
    for (const auto& record : kept_) record(sink);
    clear();
  }

 private:
  void keep(std::function<void(RecordSink&)> record) { kept_.push_back(std::move(record)); }
  std::vector<std::function<void(RecordSink&)>> kept_;
};

}  // namespace crosswalk
