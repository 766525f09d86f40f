// The multibody side of a head alone: head and car move as another run had them, whatever acts on
// them (an infinitely heavy partner: its mobility is zero).
#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "common/exchange.h"
#include "mb_node/mb_config.h"

namespace crosswalk::mb {

/// Rows of a motion file (recorder/export_motion.h): positions and attitudes linear between rows.
class MotionTable {
 public:
  /// Throws UserError naming file, line and what is wrong.
  explicit MotionTable(const std::filesystem::path& file);
  double end() const { return time_.back(); }
  BodyMotion head(double t) const { return at(head_, t); }
  BodyMotion car(double t) const { return at(car_, t); }

 private:
  BodyMotion at(const std::vector<BodyMotion>& rows, double t) const;
  std::vector<double> time_;
  std::vector<BodyMotion> head_, car_;
};

class PlayedMotion final : public MbParticipant {
 public:
  /// Throws UserError when the motion is shorter than the run.
  PlayedMotion(const MbConfig& config, const Scenario& scenario);
  std::vector<InterfaceBody> interface_bodies() const override;
  void attach(const std::vector<InterfaceBody>&) override {}
  MbReply advance(const MbGrant& grant, RecordSink& sink) override;
  std::string description() const override;
  std::int64_t progress() const override { return progress_; }
  std::vector<std::byte> save_state() const override;
  void load_state(const std::vector<std::byte>& bytes) override;

 private:
  std::vector<BodyMotion> motions(double t) const;

  MotionTable table_;
  std::vector<InterfaceSpec> interfaces_;
  Vehicle vehicle_;
  double work_ = 0, before_ = 0;  ///< J, of the finite-element side on the bodies
  MbReply reply_;
  std::atomic<std::int64_t> progress_{0};
};

}  // namespace crosswalk::mb
