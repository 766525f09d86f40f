#include "fe_node/material/hardening.h"

#include <algorithm>
#include <stdexcept>

namespace crosswalk::fe {

HardeningCurve::HardeningCurve(std::span<const double> plastic_strain,
                               std::span<const double> stress)
    : curve_(plastic_strain, stress, 0) {
  if (plastic_strain[0] != 0)
    throw std::invalid_argument("a hardening curve starts at plastic strain 0");
  for (double s : stress)
    if (!(s > 0)) throw std::invalid_argument("yield stress must be positive");
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
