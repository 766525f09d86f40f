#include "fe_node/material/hardening.h"

#include <algorithm>
#include <stdexcept>

namespace crosswalk::fe {

HardeningCurve::HardeningCurve(std::span<const double> plastic_strain,
                               std::span<const double> stress)
    : strain_(plastic_strain.begin(), plastic_strain.end()), stress_(stress.begin(), stress.end()) {
  if (strain_.empty() || strain_.size() != stress_.size())
    throw std::invalid_argument("a hardening curve needs as many stresses as plastic strains");
  if (strain_[0] != 0) throw std::invalid_argument("a hardening curve starts at plastic strain 0");
  for (std::size_t k = 0; k < strain_.size(); ++k) {
    if (!(stress_[k] > 0)) throw std::invalid_argument("yield stress must be positive");
    if (k > 0 && !(strain_[k] > strain_[k - 1]))
      throw std::invalid_argument("plastic strain of a hardening curve must rise");
  }
  for (std::size_t k = 0; k + 1 < strain_.size(); ++k)
    slope_.push_back((stress_[k + 1] - stress_[k]) / (strain_[k + 1] - strain_[k]));
  slope_.push_back(slope_.empty() ? 0 : std::max(slope_.back(), 0.0));
}

HardeningCurve HardeningCurve::linear(double yield_stress, double modulus) {
  const double strain[] = {0, 1}, stress[] = {yield_stress, yield_stress + modulus};
  return {strain, stress};
}

YieldStress::YieldStress(HardeningCurve curve) : rates_{0}, curves_{std::move(curve)} {}

YieldStress::YieldStress(std::vector<double> rates, std::vector<HardeningCurve> curves)
    : rates_(std::move(rates)), curves_(std::move(curves)) {
  if (curves_.empty() || rates_.size() != curves_.size())
    throw std::invalid_argument("a yield table needs one curve per strain rate");
  if (std::adjacent_find(rates_.begin(), rates_.end(), std::greater_equal<>{}) != rates_.end())
    throw std::invalid_argument("strain rates of a yield table must rise");
}

void YieldStress::set_cowper_symonds(double c, double p) {
  if (c < 0 || (c > 0 && !(p > 0)))
    throw std::invalid_argument("Cowper-Symonds needs C >= 0 and P > 0");
  cowper_c_ = c;
  cowper_p_ = p;
}

}  // namespace crosswalk::fe
