#include "common/message_gate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace crosswalk {

namespace {

// Walks over the numbers of a message and remembers the first that is not believable.
class Gate {
 public:
  void count(std::string_view field, int n, int max) {
    if (!problem_ && (n < 0 || n > max))
      problem_ = fmt::format("{} = {} outside 0..{}", field, n, max);
  }
  void number(std::string_view field, double value, double limit) {
    if (problem_ || std::abs(value) <= limit) return;  // false for NaN
    problem_ = fmt::format("{} = {} (believable: up to {})", field, value, limit);
  }
  void energy(std::string_view field, double value) { number(field, value, kEnergy); }
  template <class T, std::size_t N>
  void array(std::string_view field, int body, const T (&values)[N], double limit,
             double limit_angular = 0) {
    for (std::size_t i = 0; i < N; ++i) {
      const double bound = limit_angular > 0 && i >= 3 ? limit_angular : limit;
      const double value = static_cast<double>(values[i]);
      if (!(std::abs(value) <= bound))
        number(fmt::format("body {} {}[{}]", body, field, i), value, bound);
    }
  }
  void rotation(int body, const double (&q)[4]) {
    const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!problem_ && !(std::abs(norm - 1) <= 1e-6)) {
      problem_ = fmt::format("body {} quaternion has norm {}", body, norm);
    }
  }
  void motion(int body, const msg::body_motion& m) {
    array("position", body, m.position, kPosition);
    rotation(body, m.quaternion);
    array("velocity", body, m.velocity, kSpeed);
    array("angular_velocity", body, m.angular_velocity, kSpin);
  }
  std::optional<std::string> result() const { return problem_; }

  static constexpr double kPosition = 1e4, kSpeed = 500, kSpin = 1e4, kForce = 1e7, kImpulse = 1e4,
                          kEnergy = 1e9, kMass = 1e4;

 private:
  std::optional<std::string> problem_;
};

template <class M>
void check_window(Gate& gate, const M& m) {
  constexpr int kMaxNs = 1'000'000;
  gate.number("window", static_cast<double>(m.window), 1e12);
  gate.number("window_ns", static_cast<double>(m.window_ns), kMaxNs);
  gate.count("offset_ns", m.offset_ns, kMaxNs);
  gate.count("part_ns", m.part_ns, kMaxNs);
  gate.count("phase", m.phase, 2);
}

}  // namespace

std::optional<std::string> problem_in(const msg::step_to_mb& m) {
  Gate gate;
  check_window(gate, m);
  gate.count("n_bodies", m.n_bodies, kMaxInterfaceBodies);
  for (int k = 0; k < std::min(m.n_bodies, kMaxInterfaceBodies); ++k) {
    gate.array("carry", k, m.carry[k], Gate::kImpulse);
    gate.array("bias", k, m.bias[k], Gate::kForce);
  }
  return gate.result();
}

std::optional<std::string> problem_in(const msg::mb_done& m) {
  Gate gate;
  gate.count("n_bodies", m.n_bodies, kMaxInterfaceBodies);
  gate.count("status", m.status, 2);
  gate.energy("kinetic", m.kinetic);
  gate.energy("gravity", m.gravity);
  gate.energy("joint_elastic", m.joint_elastic);
  gate.energy("contact_elastic", m.contact_elastic);
  gate.array("lost", 0, m.lost, Gate::kEnergy);
  gate.energy("car_work", m.car_work);
  gate.energy("interface_work", m.interface_work);
  gate.energy("stepping", m.stepping);
  for (int k = 0; k < std::min(m.n_bodies, kMaxInterfaceBodies); ++k) gate.motion(k, m.body[k]);
  return gate.result();
}

std::optional<std::string> problem_in(const msg::step_to_fe& m) {
  Gate gate;
  check_window(gate, m);
  gate.count("n_bodies", m.n_bodies, kMaxInterfaceBodies);
  for (int k = 0; k < std::min(m.n_bodies, kMaxInterfaceBodies); ++k) {
    gate.array("position", k, m.body[k].position, Gate::kPosition);
    gate.rotation(k, m.body[k].quaternion);
    gate.array("twist", k, m.body[k].twist, Gate::kSpeed, Gate::kSpin);
    gate.array("twist_change", k, m.body[k].twist_change, Gate::kSpeed, Gate::kSpin);
    gate.array("bias", k, m.body[k].bias, Gate::kForce);
  }
  return gate.result();
}

std::optional<std::string> problem_in(const msg::fe_done& m) {
  Gate gate;
  gate.count("n_bodies", m.n_bodies, kMaxInterfaceBodies);
  gate.count("status", m.status, 2);
  gate.energy("kinetic", m.kinetic);
  gate.energy("internal", m.internal);
  gate.energy("hourglass", m.hourglass);
  gate.energy("contact", m.contact);
  gate.energy("damping", m.damping);
  gate.energy("external_work", m.external_work);
  gate.energy("interface_work", m.interface_work);
  gate.number("added_mass", m.added_mass, Gate::kMass);
  gate.number("head_contact_force", m.head_contact_force, Gate::kForce);
  for (int k = 0; k < std::min(m.n_bodies, kMaxInterfaceBodies); ++k) {
    gate.array("impulse", k, m.load[k].impulse, Gate::kImpulse);
    gate.array("twist_end", k, m.load[k].twist_end, Gate::kSpeed, Gate::kSpin);
    gate.array("gap_position", k, m.load[k].gap_position, Gate::kPosition);
    gate.array("gap_rotation", k, m.load[k].gap_rotation, 7);
  }
  return gate.result();
}

std::optional<std::string> problem_in(const msg::mobility& m) {
  Gate gate;
  gate.count("n_bodies", m.n_bodies, kMaxAttachedBodies);
  gate.array("lower", 0, m.lower, 1e9);
  return gate.result();
}

std::optional<std::string> problem_in(const msg::boundary_motion& m) {
  Gate gate;
  gate.count("n_bodies", m.n_bodies, kMaxInterfaceBodies);
  for (int k = 0; k < std::min(m.n_bodies, kMaxInterfaceBodies); ++k) gate.motion(k, m.body[k]);
  return gate.result();
}

std::optional<std::string> problem_in(const msg::boundary_mass& m) {
  Gate gate;
  gate.count("n_bodies", m.n_bodies, kMaxInterfaceBodies);
  for (int k = 0; k < std::min(m.n_bodies, kMaxInterfaceBodies); ++k) {
    gate.number(fmt::format("body {} mass", k), m.block[k].mass, Gate::kMass);
    gate.array("com", k, m.block[k].com, Gate::kPosition);
    gate.array("about_com", k, m.block[k].about_com, Gate::kMass);
  }
  return gate.result();
}

}  // namespace crosswalk
