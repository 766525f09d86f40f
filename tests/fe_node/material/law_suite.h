// The list of properties that every solid law must have; see material.h.
#pragma once

#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "common/spatial.h"
#include "fe_node/material/material.h"

namespace crosswalk::fe {

/// A material point of a law, driven along F(t) in straight steps.
template <class Law>
class MaterialPoint {
 public:
  explicit MaterialPoint(const Law& law) : law_(law), history_(law.history_size() + 1) {
    law_.initialise(history_.data());
  }
  /// To F in one step of dt; dt = 0 asks for the stress at F.
  const SolidAnswer<double>& move_to(const Mat3& F, double dt) {
    SolidStep<double> step;
    const Mat3 inverse = F.inverse();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        step.F(i, j) = F(i, j);
        step.F_inverse(i, j) = inverse(i, j);
        step.F_rate(i, j) = dt > 0 ? (F(i, j) - F_(i, j)) / dt : 0.0;
      }
    step.J = F.determinant();
    step.dt = dt;
    answer_ = law_.update(step, history_.data());
    F_ = F;
    return answer_;
  }
  /// In `steps` equal steps.
  void go_to(const Mat3& F, double duration, int steps) {
    const Mat3 start = F_;
    for (int i = 1; i <= steps; ++i)
      move_to(start + (F - start) * (static_cast<double>(i) / steps), duration / steps);
  }
  /// Uniaxial stress along x at the stretch given: the lateral stretch is found by secant steps.
  double pull_to(double stretch, double dt) {
    const std::vector<double> kept = history_;
    const Mat3 start = F_;
    auto lateral_stress = [&](double lateral) {
      history_ = kept;
      F_ = start;
      move_to(Vec3(stretch, lateral, lateral).asDiagonal(), dt);
      return answer_.P(1, 1);
    };
    double a = start(1, 1), b = a - 1e-4, fa = lateral_stress(a), fb = lateral_stress(b);
    for (int i = 0; i < 60 && fb != fa && std::abs(b - a) > 1e-15; ++i) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb, b = c, fb = lateral_stress(c);
    }
    return answer_.P(0, 0);
  }
  Mat3 nominal() const { return to_matrix(answer_.P); }
  Mat3 cauchy() const { return nominal() * F_.transpose() / F_.determinant(); }
  const SolidAnswer<double>& answer() const { return answer_; }
  const Mat3& F() const { return F_; }
  double history(int i) const { return history_[i]; }

 private:
  static Mat3 to_matrix(const Tensor<double>& t) {
    Mat3 m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = t(i, j);
    return m;
  }
  Law law_;
  std::vector<double> history_;
  Mat3 F_ = Mat3::Identity();
  SolidAnswer<double> answer_{};
};

inline Mat3 some_deformation() {
  Mat3 F;
  F << 1.02, 0.03, -0.01, 0.01, 0.97, 0.02, -0.02, 0.015, 1.01;
  return F;
}

struct LawTraits {
  bool has_energy = true;  ///< stress is the slope of an energy when the step is fast
  double fast = 1e-9;      ///< s, a step in which nothing relaxes or flows viscously
  double size = 1;         ///< scale of the deformation tried
};

template <class Law>
void expect_zero_at_rest(const Law& law) {
  MaterialPoint<Law> point(law);
  point.move_to(Mat3::Identity(), 0);
  EXPECT_LT(point.nominal().norm(), 1e-12 * (law.bulk_modulus() + law.shear_modulus()));
  EXPECT_NEAR(point.answer().energy, 0, 1e-12 * law.bulk_modulus());
  const Mat3 R = exp_rotation({0.5, -1, 0.3}).toRotationMatrix();
  MaterialPoint<Law> turned(law);
  turned.move_to(R, 0);
  EXPECT_LT(turned.nominal().norm(), 1e-12 * (law.bulk_modulus() + law.shear_modulus()));
}

/// The same history seen from a frame that turns: P turns with it.
template <class Law>
void expect_objective(const Law& law, const LawTraits& traits) {
  MaterialPoint<Law> still(law), turning(law);
  const int steps = 400;
  const double duration = traits.fast * steps;
  Mat3 R = Mat3::Identity();
  for (int i = 1; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    const Mat3 F = Mat3::Identity() + traits.size * s * (some_deformation() - Mat3::Identity());
    R = exp_rotation(s * Vec3(0.7, -0.4, 1.1)).toRotationMatrix();
    still.move_to(F, duration / steps);
    turning.move_to(R * F, duration / steps);
  }
  EXPECT_LT((turning.nominal() - R * still.nominal()).norm(), 2e-5 * still.nominal().norm());
  EXPECT_NEAR(turning.answer().energy, still.answer().energy, 1e-4 * still.answer().energy);
}

/// P : dF = dW by central differences, each leg from rest in one fast step.
template <class Law>
void expect_stress_is_energy_slope(const Law& law, const LawTraits& traits) {
  const Mat3 F = Mat3::Identity() + traits.size * (some_deformation() - Mat3::Identity());
  auto energy = [&](const Mat3& at) {
    MaterialPoint<Law> point(law);
    return point.move_to(at, traits.fast).energy;
  };
  MaterialPoint<Law> point(law);
  point.move_to(F, traits.fast);
  const Mat3 P = point.nominal();
  const double h = 1e-5;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Mat3 up = F, down = F;
      up(i, j) += h;
      down(i, j) -= h;
      EXPECT_NEAR(P(i, j), (energy(up) - energy(down)) / (2 * h), 2e-5 * P.norm());
    }
}

/// The work done along a path, sum of mean P : dF, is the energy the law reports.
template <class Law>
void expect_energy_is_work(const Law& law, const LawTraits& traits) {
  MaterialPoint<Law> point(law);
  const Mat3 target = Mat3::Identity() + traits.size * (some_deformation() - Mat3::Identity());
  double work = 0, largest = 0;
  const int steps = 2000;
  for (int leg = 0; leg < 3; ++leg) {
    const Mat3 start = point.F(), end = leg == 1 ? Mat3(Mat3::Identity()) : target;
    for (int i = 1; i <= steps; ++i) {
      const Mat3 P = point.nominal(), F = point.F();
      point.move_to(start + (end - start) * (static_cast<double>(i) / steps), traits.fast * 100);
      work += 0.5 * (P + point.nominal()).cwiseProduct(point.F() - F).sum();
      largest = std::max(largest, std::abs(work));
    }
  }
  EXPECT_NEAR(point.answer().energy, work, 2e-3 * largest);
}

/// The moduli reported bound the acoustic tensor of the instantaneous response: waves in any
/// direction n are no faster than the step assumes.
template <class Law>
void expect_wave_speed_bound(const Law& law, const LawTraits& traits) {
  const Mat3 F = Mat3::Identity() + traits.size * (some_deformation() - Mat3::Identity());
  auto nominal = [&](const Mat3& at) {
    MaterialPoint<Law> point(law);
    point.move_to(at, traits.fast);
    return point.nominal();
  };
  MaterialPoint<Law> point(law);
  const SolidAnswer<double> answer = point.move_to(F, traits.fast);
  const double bound = (answer.bulk_modulus + 4.0 / 3 * answer.shear_modulus);
  const double h = 1e-6;
  for (const Vec3& n :
       {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0.0, 0.8), Vec3(0.36, 0.48, 0.8)}) {
    // in the spatial direction n: dF = a (F^T n)^T, traction dP F^T n / J
    Mat3 acoustic;
    const Vec3 N = F.transpose() * n;
    for (int k = 0; k < 3; ++k) {
      const Mat3 change = h * Vec3::Unit(k) * N.transpose();
      acoustic.col(k) = (nominal(F + change) - nominal(F - change)) / (2 * h) * N / F.determinant();
    }
    const Mat3 symmetric = 0.5 * (acoustic + acoustic.transpose());
    const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(symmetric).eigenvalues().maxCoeff();
    EXPECT_LE(largest, 1.05 * bound + 1e-6 * law.bulk_modulus());
  }
}

template <class N, class Law>
void expect_lanes_equal_doubles(const Law& law, const LawTraits& traits) {
  std::vector<N, Eigen::aligned_allocator<N>> history(law.history_size() + 1);
  law.initialise(history.data());
  std::vector<MaterialPoint<Law>> points(kWidth<N>, MaterialPoint<Law>(law));
  std::vector<Mat3> before(kWidth<N>, Mat3::Identity());
  for (int s = 1; s <= 10; ++s) {
    SolidStep<N> step;
    step.dt = traits.fast * 10;
    for (int lane = 0; lane < kWidth<N>; ++lane) {
      const Mat3 F = Mat3::Identity() + 0.1 * s * (0.2 + 0.1 * lane) * traits.size *
                                            (some_deformation() - Mat3::Identity());
      const Mat3 inverse = F.inverse();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          step.F(i, j).set(lane, F(i, j));
          step.F_inverse(i, j).set(lane, inverse(i, j));
          step.F_rate(i, j).set(lane, (F(i, j) - before[lane](i, j)) / step.dt);
        }
      step.J.set(lane, F.determinant());
      before[lane] = F;
      points[lane].move_to(F, step.dt);
    }
    const SolidAnswer<N> answer = law.update(step, history.data());
    for (int lane = 0; lane < kWidth<N>; ++lane)
      EXPECT_NEAR(answer.P(0, 1)[lane], points[lane].nominal()(0, 1),
                  std::max(1e-9, 8 * kRoundOff<N>) * (law.bulk_modulus() + law.shear_modulus()));
  }
}

/// dt = 0 gives the present stress and changes nothing.
template <class Law>
void expect_idle_step_changes_nothing(const Law& law, const LawTraits& traits) {
  MaterialPoint<Law> point(law);
  const Mat3 F = Mat3::Identity() + traits.size * (some_deformation() - Mat3::Identity());
  point.go_to(F, traits.fast * 100, 100);
  const double energy = point.answer().energy;
  point.move_to(F, 0);
  const Mat3 first = point.nominal();
  for (int i = 0; i < 3; ++i) point.move_to(F, 0);
  EXPECT_LT((point.nominal() - first).norm(), 1e-12 * first.norm());
  EXPECT_NEAR(point.answer().energy, energy, 1e-9 * std::abs(energy));
}

template <class Law>
void expect_law(const Law& law, const LawTraits& traits = {}) {
  expect_zero_at_rest(law);
  expect_objective(law, traits);
  expect_energy_is_work(law, traits);
  expect_lanes_equal_doubles<Lanes>(law, traits);
  expect_lanes_equal_doubles<SingleLanes>(law, traits);
  expect_idle_step_changes_nothing(law, traits);
  expect_wave_speed_bound(law, traits);
  if (traits.has_energy) expect_stress_is_energy_slope(law, traits);
}

}  // namespace crosswalk::fe
