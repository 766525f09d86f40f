#include "fe_node/output/tissue_metrics.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace crosswalk::fe {

double first_principal_strain(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(0.5 * (F.transpose() * F - Mat3::Identity()),
                                                   Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

bool has_corner_inside_out(const Vec3 (&x)[8]) {
  for (int face = 0; face < 8; face += 4)
    for (int c = 0; c < 4; ++c) {
      const Vec3 &here = x[face + c], &next = x[face + (c + 1) % 4], &last = x[face + (c + 3) % 4],
                 &across = x[(face + c + 4) % 8];
      const double spanned = (next - here).cross(last - here).dot(across - here);
      if ((face == 0 ? spanned : -spanned) < 0) return true;
    }
  return false;
}

double volume_quantile(std::vector<std::pair<double, double>> value_and_volume, double q) {
  if (value_and_volume.empty()) return 0;
  std::sort(value_and_volume.begin(), value_and_volume.end());
  double total = 0;
  for (const auto& [value, volume] : value_and_volume) total += volume;
  double below = 0;
  for (const auto& [value, volume] : value_and_volume) {
    below += volume;
    if (below >= q * total) return value;
  }
  return value_and_volume.back().first;
}

TissueMetrics::TissueMetrics(const Model& model, const std::vector<TissueRegion>& regions) {
  std::vector<std::vector<int>> of_part(model.mesh.parts.size());
  for (int b = 0; b < static_cast<int>(model.blocks.size()); ++b) {
    const ElementBlock& block = *model.blocks[b];
    const bool is_observed = std::any_of(regions.begin(), regions.end(), [&](const auto& region) {
      return std::find(region.parts.begin(), region.parts.end(), block.part()) !=
             region.parts.end();
    });
    if (!is_observed || block.kind() != ElementKind::Hex8) continue;
    for (int e = 0; e < block.element_count(); ++e) {
      of_part[block.part()].push_back(static_cast<int>(elements_.size()));
      elements_.push_back({b, e, block.element_volume(e)});
    }
  }
  for (const TissueRegion& region : regions) {
    names_.push_back(region.name);
    members_.emplace_back();
    for (int part : region.parts)
      members_.back().insert(members_.back().end(), of_part[part].begin(), of_part[part].end());
  }
}

TissueSample TissueMetrics::sample(const Model& model, const State& state, std::int64_t t_ns,
                                   StrainPeaks& peaks, int threads) const {
  const StepContext context{state.nodes, state.spin, state.time, 0, false};
  struct Value {
    double strain, pressure, von_mises;
    bool is_inside_out;
  };
  const int count = static_cast<int>(elements_.size());
  std::vector<Value> values(count);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int i = 0; i < count; ++i) {
    const Observed& o = elements_[i];
    const ElementBlock& block = *model.blocks[o.block];
    const ElementSample s = block.sample(context, state.history[o.block], o.element);
    const Mat3 deviator = s.stress - s.stress.trace() / 3 * Mat3::Identity();
    Vec3 x[8];
    for (int c = 0; c < 8; ++c)
      x[c] = state.nodes[block.node(o.element / kLanes, c, o.element % kLanes)].position();
    values[i] = {first_principal_strain(s.deformation), -s.stress.trace() / 3,
                 std::sqrt(1.5) * deviator.norm(), has_corner_inside_out(x)};
    peaks[i] = std::max(peaks[i], values[i].strain);
  }
  TissueSample sample;
  sample.t_ns = t_ns;
  for (const std::vector<int>& members : members_) {
    TissueSample::Region region;
    std::vector<std::pair<double, double>> strain, peak, stress;
    double total = 0, above_15 = 0, above_25 = 0, inside_out = 0;
    if (!members.empty())
      region.pressure_min = region.pressure_max = values[members.front()].pressure;
    for (int i : members) {
      const double volume = elements_[i].volume;
      strain.emplace_back(values[i].strain, volume);
      peak.emplace_back(peaks[i], volume);
      stress.emplace_back(values[i].von_mises, volume);
      region.mps_max = std::max(region.mps_max, values[i].strain);
      region.pressure_min = std::min(region.pressure_min, values[i].pressure);
      region.pressure_max = std::max(region.pressure_max, values[i].pressure);
      total += volume;
      if (peaks[i] > 0.15) above_15 += volume;
      if (peaks[i] > 0.25) above_25 += volume;
      if (values[i].is_inside_out) inside_out += volume;
    }
    region.mps_95 = volume_quantile(std::move(strain), 0.95);
    region.mps_95_so_far = volume_quantile(std::move(peak), 0.95);
    region.von_mises_95 = volume_quantile(std::move(stress), 0.95);
    if (total > 0) {
      region.csdm_15 = above_15 / total;
      region.csdm_25 = above_25 / total;
      region.inside_out = inside_out / total;
    }
    sample.regions.push_back(region);
  }
  return sample;
}

}  // namespace crosswalk::fe
