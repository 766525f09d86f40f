#include "fe_node/energy.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {

double Energies::balance_error() const {
  const double scale = std::max({std::abs(total()), std::abs(supplied()), kinetic, internal});
  return scale > 0 ? (total() - supplied()) / scale : 0.0;
}

}  // namespace crosswalk::fe
