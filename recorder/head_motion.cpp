#include "recorder/head_motion.h"

#include <cmath>

#include "recorder/signal.h"

namespace crosswalk::recording {

namespace {

VectorSeries components(const std::vector<double>& t, const std::vector<Vec3>& v) {
  VectorSeries out;
  out.t = t;
  for (const Vec3& value : v) {
    out.x.push_back(value.x());
    out.y.push_back(value.y());
    out.z.push_back(value.z());
  }
  return out;
}

/// Head frame (forward, left, up) to SAE J211 (forward, right, down).
Vec3 j211(const Vec3& v_H) { return {v_H.x(), -v_H.y(), -v_H.z()}; }

Vec3 at_zero(const std::vector<double>& t, const std::vector<Vec3>& p) {
  if (t.front() >= 0) return p.front();
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] < 0) continue;
    const double share = -t[i - 1] / (t[i] - t[i - 1]);
    return p[i - 1] + share * (p[i] - p[i - 1]);
  }
  return p.back();
}

}  // namespace

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

HeadMotion::HeadMotion(const std::map<std::int64_t, HeadSample>& samples, double t0) {
  std::vector<double> t;
  for (const auto& [t_ns, sample] : samples) t.push_back(1e-9 * static_cast<double>(t_ns) - t0);
  is_resampled_ = !is_uniform(t);
  dt_ = is_resampled_ ? median_step(t) : (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  const auto n = static_cast<std::size_t>(std::llround((t.back() - t.front()) / dt_)) + 1;
  auto next = std::next(samples.begin());
  std::size_t k = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = is_resampled_ ? t.front() + static_cast<double>(i) * dt_ : t[i];
    while (k + 2 < t.size() && t[k + 1] < at) {
      ++k;
      ++next;
    }
    const HeadSample& a = std::prev(next)->second;
    const HeadSample& b = next->second;
    const double share = std::clamp((at - t[k]) / (t[k + 1] - t[k]), 0.0, 1.0);
    const auto mix = [share](const Vec3& from, const Vec3& to) -> Vec3 {
      return from + share * (to - from);
    };
    t_.push_back(at);
    position_.push_back(mix(a.X_WH.p, b.X_WH.p));
    velocity_.push_back(mix(a.V_WH.v, b.V_WH.v));
    angular_velocity_.push_back(mix(a.V_WH.w, b.V_WH.w));
    neck_force_.push_back(mix(a.neck.f, b.neck.f));
    neck_moment_.push_back(mix(a.neck.tau, b.neck.tau));
    attitude_.push_back(a.X_WH.q.slerp(share, b.X_WH.q));
  }
}

VectorSeries HeadMotion::displacement_mm() const {
  const Vec3 start = at_zero(t_, position_);
  std::vector<Vec3> d;
  for (const Vec3& p : position_) d.push_back(1e3 * (p - start));
  return components(t_, d);
}

VectorSeries HeadMotion::relative_displacement_mm(const BuckMotion& buck) const {
  VectorSeries d = displacement_mm();
  const std::vector<double> travel =
      resample(buck.position.t, buck.position.y, t_.front(), dt_, t_.size());
  for (std::size_t i = 0; i < travel.size(); ++i) d.y[i] -= 1e3 * travel[i];
  return d;
}

Series HeadMotion::relative_speed(const BuckMotion& buck) const {
  Series s;
  s.t = t_;
  const std::vector<double> buck_speed =
      resample(buck.velocity.t, buck.velocity.y, t_.front(), dt_, t_.size());
  for (std::size_t i = 0; i < t_.size(); ++i) {
    s.y.push_back((velocity_[i] - Vec3(0, buck_speed[i], 0)).norm());
  }
  return s;
}

VectorSeries HeadMotion::velocity() const { return components(t_, velocity_); }

std::vector<Vec3> HeadMotion::acceleration_W() const {
  const VectorSeries v = velocity();
  const std::vector<double> x = derivative(v.t, v.x);
  const std::vector<double> y = derivative(v.t, v.y);
  const std::vector<double> z = derivative(v.t, v.z);
  std::vector<Vec3> a;
  for (std::size_t i = 0; i < x.size(); ++i) a.emplace_back(x[i], y[i], z[i]);
  return a;
}

VectorSeries HeadMotion::in_head_axes(const std::vector<Vec3>& world) const {
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < world.size(); ++i)
    v.push_back(j211(attitude_[i].conjugate() * world[i]));
  return components(t_, v);
}

VectorSeries HeadMotion::filtered(VectorSeries v, double cfc) const {
  if (v.t.size() < 10) return v;  // too short to filter; metrics of such a record mean nothing
  v.x = cfc_filter(v.x, dt_, cfc);
  v.y = cfc_filter(v.y, dt_, cfc);
  v.z = cfc_filter(v.z, dt_, cfc);
  return v;
}

VectorSeries HeadMotion::acceleration() const { return in_head_axes(acceleration_W()); }

VectorSeries HeadMotion::acceleration_filtered() const { return filtered(acceleration(), 1000); }

VectorSeries HeadMotion::world_acceleration_filtered() const {
  return filtered(components(t_, acceleration_W()), 1000);
}

VectorSeries HeadMotion::angular_velocity_filtered() const {
  return filtered(in_head_axes(angular_velocity_), 60);
}

VectorSeries HeadMotion::angular_acceleration() const {
  const VectorSeries w = angular_velocity_filtered();
  return {w.t, derivative(w.t, w.x), derivative(w.t, w.y), derivative(w.t, w.z)};
}

bool HeadMotion::has_neck() const {
  const auto is_loaded = [](const Vec3& v) { return !v.isZero(0); };
  return std::any_of(neck_force_.begin(), neck_force_.end(), is_loaded) ||
         std::any_of(neck_moment_.begin(), neck_moment_.end(), is_loaded);
}

VectorSeries HeadMotion::neck_force_filtered() const {
  return filtered(in_head_axes(neck_force_), 1000);
}

VectorSeries HeadMotion::neck_moment_filtered() const {
  return filtered(in_head_axes(neck_moment_), 600);
}

HeadSignals head_signals(const std::vector<Channel>& channels) {
  const auto vector = [&channels](const std::string& stem) -> std::optional<VectorSeries> {
    const Channel* parts[3] = {nullptr, nullptr, nullptr};
    for (const Channel& c : channels) {
      if (c.name == stem + "_x") parts[0] = &c;
      if (c.name == stem + "_y") parts[1] = &c;
      if (c.name == stem + "_z") parts[2] = &c;
    }
    if (parts[0] == nullptr || parts[1] == nullptr || parts[2] == nullptr) return std::nullopt;
    const Series x = parts[0]->present();
    if (x.size() < 2) return std::nullopt;
    return VectorSeries{x.t, x.y, parts[1]->present().y, parts[2]->present().y};
  };
  HeadSignals signals;
  signals.acceleration = vector("head_acceleration");
  signals.angular_velocity = vector("head_angular_velocity");
  signals.angular_acceleration = vector("head_angular_acceleration");
  const std::optional<VectorSeries> force = vector("neck_force"), moment = vector("neck_moment");
  if (force && moment) {
    signals.neck = NeckLoads{force->t, force->x, force->z, moment->y};
    signals.neck_parameters.e_m = 0;  // the moment is that about the condyles
  }
  return signals;
}

}  // namespace crosswalk::recording
