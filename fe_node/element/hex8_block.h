// The block class behind make_hex8_block(), one instance per material law.
#pragma once

#include "fe_node/element/flatten.h"
#include "fe_node/element/hex8.h"
#include "fe_node/element/hex8_kernel.h"

namespace crosswalk::fe {

/// Law-independent part: the undeformed shapes and added masses of a block.
struct HexShapes {
  std::vector<HexReference<Lanes>, Eigen::aligned_allocator<HexReference<Lanes>>> groups;
  std::vector<double> added_density;  ///< kg/m3 per element, by mass scaling
};
HexShapes make_hex_shapes(const ElementBlock& block, const Mesh& mesh, double density,
                          double bulk_modulus, double shear_modulus, double minimum_step);
inline HexNodes<Lanes> load_hex_nodes(std::span<const NodeRecord> nodes, const int* index) {
  HexNodes<Lanes> out;
  for (int node = 0; node < 8; ++node) {
    load_positions(nodes, index + node * kLanes, out.x[node]);
    load_velocities(nodes, index + node * kLanes, out.v[node]);
  }
  return out;
}
/// Finds the inverted element of a group of which some lane of J is not positive.
void find_inverted(const Lanes& J, int first_element, int element_count, BlockSums& sums);

/// Sums of one group; padded lanes have mask 0.
inline void add_to_sums(const HexAnswer<Lanes>& answer, const Lanes& mask, const StepContext& step,
                        int group, int element_count, LaneSums& lanes, BlockSums& sums) {
  const Lanes live = mask * answer.alive;
  lanes.failed += mask - live;
  lanes.internal += answer.energy * mask;
  lanes.hourglass += answer.hourglass_stored * live;
  lanes.hourglass_dissipated += step.dt * (answer.hourglass_power * live);
  lanes.viscous_dissipated += step.dt * (answer.viscous_power * live);
  const Lanes J = where_less(constant<Lanes>(0), live, answer.J, constant<Lanes>(1));
  if (!all_positive(J)) find_inverted(J, group * kLanes, element_count, sums);
  if (step.wants_stable_step)
    lanes.limit_step(where_less(constant<Lanes>(0), live, answer.stable_step_squared,
                                constant<Lanes>(std::numeric_limits<double>::infinity())),
                     group);
}
inline void store_corner_forces(const HexAnswer<Lanes>& answer, double* corner_forces) {
  for (int node = 0; node < 8; ++node)
    store_corner(answer.force[node][0], answer.force[node][1], answer.force[node][2],
                 corner_forces + node * kLanes * kCornerStride);
}

template <class Law>
class Hex8Block final : public ElementBlock {
 public:
  Hex8Block(const Mesh& mesh, int part, std::vector<int> elements, const Law& law,
            const ElementControls& controls)
      : ElementBlock(mesh, ElementKind::Hex8, part, std::move(elements)),
        law_(law),
        controls_(controls),
        shapes_(make_hex_shapes(*this, mesh, law.density, law.bulk_modulus(), law.shear_modulus(),
                                controls.minimum_step)) {}

  int history_per_group() const override { return law_.history_size() * kLanes; }

  void initialise(std::span<double> history) const override {
    for (int group = 0; group < group_count(); ++group)
      law_.initialise(group_history(history, group));
  }

  double corner_mass(int element) const override {
    return (law_.density + shapes_.added_density[element]) * element_volume(element) / 8.0;
  }
  double added_mass(int element) const override {
    return shapes_.added_density[element] * element_volume(element);
  }
  double element_volume(int element) const override {
    return shapes_.groups[element / kLanes].volume[element % kLanes];
  }
  double density() const override { return law_.density; }

  // Flattened: the compiler otherwise leaves lane arithmetic of so large a function in calls.
  CW_FLATTEN void forces(const StepContext& step, std::span<double> history,
                         std::span<double> corner_forces, std::span<double> /*corner_moments*/,
                         int first, int last, BlockSums& sums) const override {
    LaneSums lanes;
    decltype(auto) law = ready_law(law_, step.dt);
    lanes.step_squared = Lanes::Constant(sums.stable_step * sums.stable_step);
    for (int group = first; group < last; ++group) {
      if (group + 1 < group_count()) fetch_ahead(group + 1);
      const HexNodes<Lanes> nodes = load_hex_nodes(step.nodes, group_nodes(group));
      const HexAnswer<Lanes> answer = hex8_forces(
          shapes_.groups[group], nodes, law, controls_, step.dt, group_history(history, group),
          step.wants_stable_step ? smallest(lanes.step_squared) : 0.0);
      store_corner_forces(answer, corner_forces.data() + corner_slot(group - first, 0, 0));
      add_to_sums(answer, lane_mask(group), step, group, element_count(), lanes, sums);
    }
    lanes.book(sums);
  }

  bool is_alive(std::span<const double> history, int element) const override {
    const double* group = history.data() + std::size_t(history_per_group()) * (element / kLanes);
    if constexpr (requires { Law::kAlive; })
      return group[Law::kAlive * kLanes + element % kLanes] > 0;
    return true;
  }

  double initial_stable_step(int element) const override {
    const HexReference<Lanes>& ref = shapes_.groups[element / kLanes];
    Tensor<Lanes> identity;
    for (int k = 0; k < 9; ++k) identity(k / 3, k % 3) = Lanes::Constant(k % 4 == 0 ? 1.0 : 0.0);
    const Lanes squared = hex_stable_step_squared(ref, identity, constant<Lanes>(1),
                                                  constant<Lanes>(law_.bulk_modulus()),
                                                  constant<Lanes>(law_.shear_modulus()));
    return std::sqrt(squared[element % kLanes]);
  }

  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override {
    const int group = element / kLanes, lane = element % kLanes;
    const HexNodes<Lanes> nodes = load_hex_nodes(step.nodes, group_nodes(group));
    const HexReference<Lanes>& ref = shapes_.groups[group];
    std::vector<Lanes, Eigen::aligned_allocator<Lanes>> copy(law_.history_size() + 1);
    std::copy_n(history.data() + std::size_t(history_per_group()) * group, history_per_group(),
                copy.front().data());
    SolidStep<Lanes> still;
    still.F = gradient_of(ref, nodes.x);
    still.F_rate = gradient_of(ref, nodes.v);
    still.J = determinant(still.F);
    still.F_inverse = inverse(still.F, still.J);
    const SolidAnswer<Lanes> material = law_.update(still, copy.data());
    const Symmetric<Lanes> sigma = cauchy_stress(material.P, still.F, still.J);

    ElementSample out;
    out.volume = ref.volume[lane];
    out.energy = material.energy[lane] * out.volume;
    out.is_alive = material.alive[lane] > 0;
    if constexpr (requires { Law::kPlasticStrain; })
      out.plastic_strain = copy[Law::kPlasticStrain][lane];
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 3; ++i) out.centre[i] += 0.125 * nodes.x[node][i][lane];
    for (int k = 0; k < 9; ++k) out.deformation(k / 3, k % 3) = still.F(k / 3, k % 3)[lane];
    out.stress << sigma.xx[lane], sigma.xy[lane], sigma.zx[lane], sigma.xy[lane], sigma.yy[lane],
        sigma.yz[lane], sigma.zx[lane], sigma.yz[lane], sigma.zz[lane];
    return out;
  }

 private:
  /// Shapes cross pages, where the processor's own prefetching stops.
  void fetch_ahead(int group) const {
    const auto* shape = reinterpret_cast<const char*>(&shapes_.groups[group]);
    for (std::size_t i = 0; i < sizeof(HexReference<Lanes>); i += 64) __builtin_prefetch(shape + i);
  }
  Lanes* group_history(std::span<double> history, int group) const {
    return reinterpret_cast<Lanes*>(history.data() + std::size_t(history_per_group()) * group);
  }

  Law law_;
  ElementControls controls_;
  HexShapes shapes_;
};

}  // namespace crosswalk::fe
