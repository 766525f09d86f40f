// Strain metrics of brain tissue. MPS: first principal Green-Lagrange strain at the element's
// point; CSDM(x): volume share of elements whose MPS ever exceeded x; pressure is -tr sigma / 3.
// One-point bricks can turn a corner inside out and show no sign of it at their point, so their
// share is told as well: strains of a region that has many are not to be trusted.
#pragma once

#include <string>
#include <vector>

#include "common/exchange.h"
#include "fe_node/model.h"
#include "fe_node/state.h"

namespace crosswalk::fe {

struct TissueRegion {
  std::string name;
  std::vector<int> parts;  ///< indices into Mesh::parts
};

/// The largest MPS of every observed element so far: part of a saved run.
using StrainPeaks = std::vector<double>;

class TissueMetrics {
 public:
  TissueMetrics() = default;
  TissueMetrics(const Model& model, const std::vector<TissueRegion>& regions);

  StrainPeaks no_peaks() const { return StrainPeaks(elements_.size(), 0.0); }
  /// Samples all observed elements, raises the peaks and tells the present values.
  TissueSample sample(const Model& model, const State& state, std::int64_t t_ns, StrainPeaks& peaks,
                      int threads = 1) const;
  const std::vector<std::string>& names() const { return names_; }

 private:
  struct Observed {
    int block = 0, element = 0;
    double volume = 0;
  };
  std::vector<std::string> names_;
  std::vector<Observed> elements_;
  std::vector<std::vector<int>> members_;  ///< per region, indices into elements_
};

/// Whether the edges at some corner of a brick span a negative volume.
bool has_corner_inside_out(const Vec3 (&x)[8]);
/// Largest principal Green-Lagrange strain of F.
double first_principal_strain(const Mat3& F);
/// Value below which the volume share q lies, 0 < q <= 1.
double volume_quantile(std::vector<std::pair<double, double>> value_and_volume, double q);

}  // namespace crosswalk::fe
