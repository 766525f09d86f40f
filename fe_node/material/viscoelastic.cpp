#include "fe_node/material/viscoelastic.h"

#include <cmath>

namespace crosswalk::fe {

Viscoelastic Viscoelastic::from_single_term(double density, double bulk_modulus, double shear_short,
                                            double shear_long, double decay) {
  Viscoelastic law;
  law.density = density;
  law.bulk = bulk_modulus;
  law.long_term_modulus = shear_long;
  law.terms[0] = {shear_short - shear_long, decay};
  law.term_count = 1;
  return law;
}

Viscoelastic Viscoelastic::for_step(double dt) const {
  Viscoelastic ready = *this;
  for (int i = 0; i < term_count; ++i) {
    ready.terms[i].step = dt;
    ready.terms[i].keep = std::exp(-terms[i].decay * dt);
  }
  return ready;
}

}  // namespace crosswalk::fe
