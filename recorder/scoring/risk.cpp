#include "recorder/scoring/risk.h"

#include <cmath>
#include <numbers>

namespace crosswalk::recording {

namespace {

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double weibull(double x, double scale, double shape) {
  return x > 0 ? -std::expm1(-std::pow(x / scale, shape)) : 0.0;
}

std::string ais(int level) { return "AIS" + std::to_string(level) + "+"; }

struct TwoParameters {
  int level;
  double a, b;
};

}  // namespace

RiskFamily risk_hic_lognormal(double hic15) {
  RiskFamily family{"hic_lognormal", "log-normal in HIC15, NHTSA", {}};
  for (const auto& [level, mu, sigma] :
       {TwoParameters{2, 6.96352, 0.84664}, {3, 7.45231, 0.73998}, {4, 7.65605, 0.60580}}) {
    const double p = hic15 > 0 ? normal_cdf((std::log(hic15) - mu) / sigma) : 0.0;
    family.risks.push_back({ais(level), p});
  }
  return family;
}

RiskFamily risk_hic_logistic(double hic15) {
  RiskFamily family{"hic_logistic", "logistic in HIC15, expanded Prasad-Mertz", {}};
  for (const auto& [level, c, k] : {TwoParameters{1, 1.54, 0.0065},
                                    {2, 2.49, 0.00483},
                                    {3, 3.39, 0.00372},
                                    {4, 4.90, 0.00351},
                                    {5, 7.82, 0.00429},
                                    {6, 12.24, 0.00565}}) {
    const double p = hic15 > 0 ? 1.0 / (1.0 + std::exp(c + 200.0 / hic15 - k * hic15)) : 0.0;
    family.risks.push_back({ais(level), p});
  }
  return family;
}

RiskFamily risk_bric_csdm(double bric_csdm) {
  RiskFamily family{"bric_csdm", "Weibull in BrIC (CSDM), Takhounts 2013", {}};
  for (const auto& [level, eta, shape] : {TwoParameters{1, 0.065, 1.8},
                                          {2, 0.324, 1.8},
                                          {3, 0.531, 1.8},
                                          {4, 0.647, 1.8},
                                          {5, 0.673, 1.8}}) {
    family.risks.push_back({ais(level), weibull(bric_csdm - 0.523, eta, shape)});
  }
  return family;
}

RiskFamily risk_bric_mps(double bric_mps) {
  RiskFamily family{"bric_mps", "Weibull in BrIC (MPS), Takhounts 2013", {}};
  for (const auto& [level, eta, shape] : {TwoParameters{1, 0.120, 2.84},
                                          {2, 0.602, 2.84},
                                          {3, 0.987, 2.84},
                                          {4, 1.204, 2.84},
                                          {5, 1.252, 2.84}}) {
    family.risks.push_back({ais(level), weibull(bric_mps, eta, shape)});
  }
  return family;
}

RiskFamily risk_damage(double damage) {
  // The inner line maps DAMAGE to the brain strain of one finite-element model.
  RiskFamily family{"damage", "Weibull in strain mapped from DAMAGE, as in UniversalPlotter", {}};
  const double strain = 0.957 * damage + 0.017;
  for (const auto& [level, scale, shape] :
       {TwoParameters{1, 0.394, 4.078}, {2, 0.459, 3.875}, {4, 0.646, 6.051}}) {
    family.risks.push_back({ais(level), weibull(strain, scale, shape)});
  }
  return family;
}

RiskFamily risk_nij(double nij) {
  RiskFamily family{"nij", "logistic in Nij, NHTSA", {}};
  for (const auto& [level, a, b] :
       {TwoParameters{2, 2.054, 1.195}, {3, 3.227, 1.969}, {4, 2.693, 1.195}, {5, 3.817, 1.195}}) {
    family.risks.push_back({ais(level), 1.0 / (1.0 + std::exp(a - b * nij))});
  }
  return family;
}

}  // namespace crosswalk::recording
