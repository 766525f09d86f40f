#include "fe_node/material/elastic.h"

namespace crosswalk::fe {

Elastic Elastic::from_young(double density, double youngs_modulus, double poisson_ratio) {
  const double mu = 0.5 * youngs_modulus / (1 + poisson_ratio);
  return {density, 2 * mu * poisson_ratio / (1 - 2 * poisson_ratio), mu};
}

Elastic Elastic::from_bulk(double density, double bulk_modulus, double shear_modulus) {
  return {density, bulk_modulus - 2.0 / 3.0 * shear_modulus, shear_modulus};
}

}  // namespace crosswalk::fe
