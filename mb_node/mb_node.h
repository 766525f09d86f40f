// The multibody participant: model, engine and state behind the verbs of common/exchange.h.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "common/exchange.h"
#include "mb_node/dynamics.h"
#include "mb_node/model.h"

namespace crosswalk::mb {

/// A measured mobility is handed out this much larger: the coupling is stable for W too large by a
/// quarter, but not for W too small.
inline constexpr double kMobilitySafety = 1.05;

class MbNode final : public MbParticipant {
 public:
  explicit MbNode(MbConfig config);
  ~MbNode() override;

  std::vector<InterfaceBody> interface_bodies() const override;
  void attach(const std::vector<InterfaceBody>& bodies) override;
  MbReply advance(const MbGrant& grant, RecordSink& sink) override;
  std::string description() const override;
  std::int64_t progress() const override { return progress_; }
  std::vector<std::byte> save_state() const override;
  void load_state(const std::vector<std::byte>& bytes) override;

  // For studies and tests.
  const MbModel& model() const { return *model_; }
  const MbState& state() const { return state_; }
  const Dynamics& dynamics() const { return *dynamics_; }
  const OdeWorld& world() const { return *world_; }
  MbEnergies energies() const;
  /// What energies() holds less what was supplied, relative to the start: the error of steps and
  /// laws.
  double energy_balance(const MbEnergies& e) const;

 private:
  struct Records;
  void rebuild(const std::vector<Inertia>& blocks);
  void run_substeps(const MbGrant& grant, Records& records);
  std::vector<ExternalLoad> external_loads(const MbGrant& grant, double substep,
                                           bool is_first) const;
  MbReply reply(const MbGrant& grant, Eigen::MatrixXd mobility, std::uint64_t contacts_before,
                std::vector<char> bones_before) const;
  BodyMotion motion_of(const std::string& body) const;
  Eigen::MatrixXd mobility(double substep) const;
  std::vector<Pose> poses() const;
  std::vector<Vec3> forces() const;
  std::uint64_t state_hash() const;
  MbState snapshot() const;
  void restore(const MbState& state);

  std::unique_ptr<MbModel> model_;
  std::unique_ptr<OdeWorld> world_;
  std::unique_ptr<Dynamics> dynamics_;
  MbState state_;
  double start_motion_ = 0;  ///< J, kinetic and gravity at the start
  double start_energy_ = 0;  ///< and stored
  std::atomic<std::int64_t> progress_{0};
  std::unique_ptr<MbState> window_start_;  ///< of an iterated window
  std::unique_ptr<Records> pending_;       ///< of its last evaluation
  MbReply last_reply_;
};

}  // namespace crosswalk::mb
