// The finite-element participant: head and neck between the multibody torso and what they strike.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>

#include "fe_node/last_sound.h"
#include "fe_node/node_model.h"
#include "fe_node/output/head_motion.h"
#include "fe_node/output/section_force.h"
#include "fe_node/output/tissue_metrics.h"

namespace crosswalk::fe {

class FieldWriter;

class FeNode : public FeParticipant {
 public:
  /// `folder`: of the run; the generated deck and the fields go there; empty: nothing is written.
  FeNode(FeConfig config, int threads, std::filesystem::path folder);
  ~FeNode() override;

  std::vector<InterfaceBody> interface_bodies() const override;
  std::vector<InterfaceBody> place(std::vector<InterfaceBody> bodies) override;
  FeReply advance(const FeGrant& grant, RecordSink& sink) override;
  std::string description() const override;
  std::int64_t progress() const override { return progress_; }
  std::vector<std::byte> save_state() const override;
  void load_state(const std::vector<std::byte>& bytes) override;

  const BuiltModel& built() const { return node_.built; }
  const State& state() const { return run_.state; }

 private:
  /// Everything that a checkpoint holds.
  struct Run {
    State state;
    Twist head_twist;
    StrainPeaks peaks;
    std::int64_t next_tissue_ns = 0, next_strain_ns = 0, next_field_ns = 0;
  };

  void compare_with_multibody_head() const;
  void cut_neck(const std::vector<int>& head_parts);
  FeReply run_window(const FeGrant& grant);
  void tell_short_step();
  void publish(const WindowId& id, RecordSink& sink);
  void start_motion_log(const Pose& X_WD, const Twist& V_WD);

  FeConfig config_;
  int threads_;
  std::filesystem::path folder_;
  NodeModel node_;
  HeadMotion head_;
  std::optional<SectionForce> neck_;  ///< none for a head alone
  Vec3 condyles_ = Vec3::Zero();      ///< in the head's frame H
  TissueMetrics tissue_;
  std::optional<Scratch> scratch_;
  ExplosionWatch watch_{kExplosionFloor};
  LastSound sound_;
  std::int64_t next_sound_ns_ = 0;
  std::unique_ptr<FieldWriter> fields_;
  std::optional<BlockMotionLog> motion_log_;
  WindowLoads last_window_;
  Run run_, saved_;
  FeReply last_reply_;
  std::atomic<std::int64_t> progress_{0};
  double told_step_ = 0;  ///< s, the stable step last told
};

}  // namespace crosswalk::fe
