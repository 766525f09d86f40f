// Yield stress over effective plastic strain, tabulated, with dependence on the strain rate: a
// table of curves (linear in the rate between them, held outside) or the factor of Cowper and
// Symonds, 1 + (rate / C)^(1/P). Evaluated without branches, all lanes at once.
#pragma once

#include <span>
#include <vector>

#include "fe_node/material/lane_curve.h"

namespace crosswalk::fe {

/// Piecewise linear, continued with its last slope where that is not negative, else held.
class HardeningCurve {
 public:
  HardeningCurve() = default;
  /// Plastic strain from zero, strictly rising; stress positive. Throws std::invalid_argument.
  HardeningCurve(std::span<const double> plastic_strain, std::span<const double> stress);
  static HardeningCurve linear(double yield_stress, double modulus);

  template <class N>
  void evaluate(const N& plastic_strain, N& stress, N& slope) const {
    curve_.evaluate(plastic_strain, stress, slope);
  }
  bool empty() const { return curve_.empty(); }
  double initial_stress() const { return curve_.y()[0]; }

 private:
  LaneCurve curve_;
};

class YieldStress {
 public:
  YieldStress() = default;
  explicit YieldStress(HardeningCurve curve);
  /// Rates strictly rising, 1/s.
  YieldStress(std::vector<double> rates, std::vector<HardeningCurve> curves);
  /// No effect when c is zero.
  void set_cowper_symonds(double c, double p);

  bool has_rates() const { return rates_.size() > 1 || cowper_c_ > 0; }
  double initial_stress() const { return curves_.front().initial_stress(); }

  template <class N>
  void evaluate(const N& plastic_strain, const N& rate, N& stress, N& slope) const {
    curves_[0].evaluate(plastic_strain, stress, slope);
    for (std::size_t k = 1; k < curves_.size(); ++k) {
      N above, above_slope;
      curves_[k].evaluate(plastic_strain, above, above_slope);
      const double width = rates_[k] - rates_[k - 1];
      const N share =
          smaller(larger(N((rate - rates_[k - 1]) * (1 / width)), constant<N>(0)), constant<N>(1));
      // share is 1 for every interval below the rate and 0 above it
      stress += share * (above - stress);
      slope += share * (above_slope - slope);
    }
    if (cowper_c_ > 0) {
      const N safe = larger(rate, constant<N>(1e-12 * cowper_c_));
      const N factor = 1.0 + exponential(N(logarithm(N(safe * (1 / cowper_c_))) * (1 / cowper_p_)));
      stress *= factor;
      slope *= factor;
    }
  }

 private:
  std::vector<double> rates_;
  std::vector<HardeningCurve> curves_;
  double cowper_c_ = 0, cowper_p_ = 1;
};

}  // namespace crosswalk::fe
