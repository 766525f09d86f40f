// Small participants with known answers, for tests of schemes and protocol.
//
// One interface body that moves along x. The multibody side is a rigid body of mass M (optionally
// on a spring to the ground), stepped semi-implicitly as a multibody engine would; the
// finite-element side is a point of mass m on a spring with damper tied to the block, stepped by
// leap-frog.
#pragma once

#include <cmath>

#include "common/byte_archive.h"
#include "common/exchange.h"
#include "common/protocol.h"

namespace crosswalk::toy {

inline std::vector<InterfaceBody> one_body() {
  std::vector<InterfaceBody> bodies(1);
  bodies[0].name = "block";
  bodies[0].is_attached = true;
  return bodies;
}

template <class T>
std::vector<std::byte> bytes_of(const T& state, double work) {
  ByteWriter out;
  out.value(state);
  out.value(work);
  return out.take();
}
template <class T>
void from_bytes(const std::vector<std::byte>& bytes, T& state, double& work) {
  ByteReader in(bytes);
  in.value(state);
  in.value(work);
}

struct MbBody {
  double mass = 1, x = 0, v = 0;
  double push = 0;  ///< N, constant external force
  double step = 10e-6;
};

class Mb : public MbParticipant {
 public:
  explicit Mb(MbBody body) : now_(body) {}
  std::vector<InterfaceBody> interface_bodies() const override {
    auto bodies = one_body();
    bodies[0].motion = motion();
    return bodies;
  }
  void attach(const std::vector<InterfaceBody>& bodies) override {
    now_.mass += bodies[0].block.mass;
  }
  MbReply advance(const MbGrant& grant, RecordSink&) override {
    if (grant.id.phase == Phase::Accept) return reply_;
    if (grant.id.phase == Phase::Evaluate) {
      if (grant.id.iteration == 0) saved_ = now_, saved_work_ = work_;
      now_ = saved_, work_ = saved_work_;
    }
    reply_ = {};
    if (grant.want_mobility) {
      reply_.mobility = Eigen::MatrixXd::Zero(6, 6);
      reply_.mobility(0, 0) = mobility_factor / now_.mass;
    }
    const double H = grant.id.length_s();
    const int n = std::max(1, static_cast<int>(std::lround(H / now_.step)));
    const double h = H / n;
    for (int i = 0; i < n; ++i) {
      const double force = grant.bias[0][0] + (i == 0 ? grant.carry[0][0] / h : 0.0);
      const double v_before = now_.v;
      now_.v += h * (force + now_.push) / now_.mass;
      now_.x += h * now_.v;
      work_ += h * force * (v_before + now_.v) / 2;
      pushed_ += h * now_.push * (v_before + now_.v) / 2;
    }
    ++steps_;
    reply_.substeps = n;
    reply_.first_contact = true;
    reply_.energy.kinetic = 0.5 * now_.mass * now_.v * now_.v;
    reply_.energy.car_work = pushed_;
    reply_.energy.interface_work = work_;
    reply_.bodies = {motion()};
    if (fail_at_window >= 0 && grant.id.window == fail_at_window) reply_.bodies[0].V_WB.v[1] = NAN;
    return reply_;
  }
  std::string description() const override { return R"({"bodies":["block"]})"; }
  std::int64_t progress() const override { return steps_; }
  std::vector<std::byte> save_state() const override { return bytes_of(now_, work_); }
  void load_state(const std::vector<std::byte>& bytes) override { from_bytes(bytes, now_, work_); }
  BodyMotion motion() const {
    return {{Quat::Identity(), {now_.x, 0, 0}}, {{now_.v, 0, 0}, Vec3::Zero()}};
  }
  const MbBody& now() const { return now_; }

  double mobility_factor = 1;
  std::int64_t fail_at_window = -1;

 private:
  MbBody now_, saved_;
  double work_ = 0, saved_work_ = 0, pushed_ = 0;
  std::int64_t steps_ = 0;
  MbReply reply_;
};

struct FePoint {
  double mass = 1, stiffness = 1, damping = 0;
  double x = 0, v = 0;  ///< v at half steps
  double block_x = 0, block_v = 0;
  double step = 0.5e-6;
};

class Fe : public FeParticipant {
 public:
  explicit Fe(FePoint point, double block_mass = 0) : now_(point), block_mass_(block_mass) {}
  std::vector<InterfaceBody> interface_bodies() const override { return one_body(); }
  std::vector<InterfaceBody> place(std::vector<InterfaceBody> bodies) override {
    bodies[0].block.mass = block_mass_;
    now_.block_x = bodies[0].motion.X_WB.p[0];
    now_.block_v = bodies[0].motion.V_WB.v[0];
    return bodies;
  }
  FeReply advance(const FeGrant& grant, RecordSink& sink) override {
    if (grant.id.phase == Phase::Accept) return reply_;
    if (grant.id.phase == Phase::Evaluate) {
      if (grant.id.iteration == 0) saved_ = now_, saved_work_ = work_;
      now_ = saved_, work_ = saved_work_;
    }
    reply_ = {};
    const BodyDrive& drive = grant.drives[0];
    const double H = grant.id.length_s();
    const int n = std::max(1, static_cast<int>(std::ceil(H / now_.step - 1e-9)));
    const double d = H / n;
    const double gap = drive.X_WB.p[0] - now_.block_x;
    const double W = grant.mobility.size() > 0 ? grant.mobility(0, 0) : 0;
    double V = drive.V_WB.v[0], J = 0;
    for (int j = 0; j < n; ++j) {
      // F: spring and damper on the block.
      const double F = now_.stiffness * (now_.x - now_.block_x) + now_.damping * (now_.v - V);
      const double V_before = V;
      V += d * (drive.twist_change[0] / H + W * (F - drive.bias[0]));
      J += d * F;
      work_ -= d * F * (V_before + V) / 2;
      now_.v -= d * F / now_.mass;
      now_.x += d * now_.v;
      now_.block_x += d * (V + gap * gap_rate);
    }
    now_.block_v = V;
    ++steps_;
    sink.head({(grant.id.window + 1) * grant.id.window_ns,
               {Quat::Identity(), {now_.x, 0, 0}},
               {},
               {},
               {},
               {}});
    reply_.substeps = n;
    reply_.kinetic = 0.5 * now_.mass * now_.v * now_.v;
    reply_.internal = 0.5 * now_.stiffness * (now_.x - now_.block_x) * (now_.x - now_.block_x);
    reply_.interface_work = work_;
    reply_.state_hash = fnv1a({reinterpret_cast<const char*>(&now_), sizeof now_});
    BodyLoad load;
    load.impulse[0] = J;
    load.twist_end.v[0] = V;
    load.gap_position[0] = gap;
    reply_.loads = {load};
    return reply_;
  }
  std::string description() const override { return "{}"; }
  std::int64_t progress() const override { return steps_; }
  std::vector<std::byte> save_state() const override { return bytes_of(now_, work_); }
  void load_state(const std::vector<std::byte>& bytes) override { from_bytes(bytes, now_, work_); }
  const FePoint& now() const { return now_; }

  double gap_rate = 0;  ///< 1/s, of the gap correction

 private:
  FePoint now_, saved_;
  double block_mass_;
  double work_ = 0, saved_work_ = 0;
  std::int64_t steps_ = 0;
  FeReply reply_;
};

/// Of the spring of Fe at the end of a window, m and m/s.
struct Stretch {
  double u = 0, du = 0;
};

/// Remembers the stretch of every window; part of its state.
class WatchedFe : public Fe {
 public:
  using Fe::Fe;
  FeReply advance(const FeGrant& grant, RecordSink& sink) override {
    const FeReply reply = Fe::advance(grant, sink);
    if (grant.id.phase != Phase::Evaluate && grant.id.ends_window())
      stretches_.push_back({now().x - now().block_x, now().v - now().block_v});
    return reply;
  }
  std::vector<std::byte> save_state() const override {
    ByteWriter out;
    out.list(Fe::save_state());
    out.list(stretches_);
    return out.take();
  }
  void load_state(const std::vector<std::byte>& bytes) override {
    ByteReader in(bytes);
    std::vector<std::byte> own;
    in.list(own);
    in.list(stretches_);
    Fe::load_state(own);
  }
  const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  std::vector<Stretch> stretches_;
};

class NoRecords : public RecordSink {
 public:
  void head(const HeadSample&) override {}
  void body_states(std::int64_t, const std::vector<Pose>&) override {}
  void contact_forces(std::int64_t, const std::vector<Vec3>&) override {}
  void tissue(const TissueSample&) override {}
  void event(std::int64_t, EventLevel, const std::string&) override {}
};

}  // namespace crosswalk::toy
