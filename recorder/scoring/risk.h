// Injury probability curves, each with its author; arguments <= 0 of the log-normal, logistic HIC
// and BrIC families give 0. Families of the same metric disagree strongly: always print the
// family's name.
#pragma once

#include <string>
#include <vector>

namespace crosswalk::recording {

struct Risk {
  std::string level;  ///< "AIS2+"
  double probability = 0;
};

struct RiskFamily {
  std::string key;  ///< "hic_lognormal", "hic_logistic", "bric_csdm", "bric_mps", "damage", "nij"
  std::string author;  ///< citation as printed
  std::vector<Risk> risks;
};

/// Log-normal in HIC15, NHTSA [eppinger1999].
RiskFamily risk_hic_lognormal(double hic15);
/// Expanded Prasad-Mertz logistic curves in HIC15.
RiskFamily risk_hic_logistic(double hic15);
RiskFamily risk_bric_csdm(double bric_csdm);
RiskFamily risk_bric_mps(double bric_mps);
RiskFamily risk_damage(double damage);
/// Positive at Nij = 0 by construction of the published curves.
RiskFamily risk_nij(double nij);

}  // namespace crosswalk::recording
