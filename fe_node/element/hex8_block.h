// The block class behind make_hex8_block(), one instance per material law.
#pragma once

#include "fe_node/element/flatten.h"
#include "fe_node/element/hex8.h"
#include "fe_node/element/hex8_kernel.h"
#include "fe_node/element/pack_history.h"

namespace crosswalk::fe {

/// Law-independent part: the undeformed shapes of a block.
template <class N>
struct HexShapes {
  std::vector<HexReference<N>, Eigen::aligned_allocator<HexReference<N>>> packs;
  std::vector<HexMetric<N>, Eigen::aligned_allocator<HexMetric<N>>> metrics;
  std::vector<double> volume;  ///< m3 per element
};
template <class N>
HexShapes<N> make_hex_shapes(const ElementBlock& block, const Mesh& mesh);

/// Finds the inverted element of a pack of which some lane of J is not positive.
template <class N>
void find_inverted(const N& J, int first_element, int element_count, BlockSums& sums) {
  if (sums.inverted_element >= 0) return;
  for (int lane = kWidth<N> - 1; lane >= 0; --lane)
    if (!(J[lane] > 0)) {
      sums.inverted_element = std::min(first_element + lane, element_count - 1);
      sums.inverted_jacobian = J[lane];
    }
}

/// Sums of one pack; padded lanes have mask 0. `corner_mass`: kg.
template <class N>
void add_to_sums(const HexAnswer<N>& answer, const N& corner_mass, const N& mask,
                 const StepContext& step, int pack, int element_count, LaneSums<N>& lanes,
                 BlockSums& sums) {
  const N live = mask * answer.alive;
  lanes.failed += mask - live;
  lanes.internal += answer.energy * mask;
  lanes.hourglass += answer.hourglass_stored * live;
  lanes.hourglass_dissipated += step.dt * (answer.hourglass_power * live);
  lanes.viscous_dissipated += step.dt * (answer.viscous_power * live);
  const N J = where_less(constant<N>(0), live, answer.J, constant<N>(1));
  if (!all_positive(J)) find_inverted(J, pack * kWidth<N>, element_count, sums);
  if (step.wants_stable_step) lanes.look_for_stiffest(live * answer.stiffness, corner_mass, pack);
}

template <class N>
void store_corner_forces(const HexAnswer<N>& answer, double* corner_forces) {
  constexpr std::size_t kCorner = std::size_t{kLanes} * kCornerStride;
  for (int node = 0; node < 8; ++node)
    store_corner(answer.force[node][0], answer.force[node][1], answer.force[node][2],
                 answer.stiffness, corner_forces + node * kCorner, 8 * kCorner);
}

template <class N, class Law>
class Hex8Block final : public ElementBlock {
 public:
  Hex8Block(const Mesh& mesh, int part, std::vector<int> elements, const Law& law,
            const ElementControls& controls)
      : ElementBlock(mesh, ElementKind::Hex8, part, std::move(elements), kGroupsPerPack<N>),
        law_(law),
        controls_(controls),
        kept_(law.history_size()),
        shapes_(make_hex_shapes<N>(*this, mesh)) {}

  int history_per_group() const override { return kept_.per_group(); }

  void initialise(std::span<double> history) const override {
    for (int pack = 0; pack < pack_count(); ++pack) law_.initialise(kept_.of(history, pack));
  }

  double corner_mass(int element) const override {
    return law_.density * element_volume(element) / 8.0;
  }
  double element_volume(int element) const override { return shapes_.volume[element]; }
  double density() const override { return law_.density; }
  bool is_near_fluid() const override { return fe::is_near_fluid(law_); }

  // Flattened: the compiler otherwise leaves lane arithmetic of so large a function in calls.
  CW_FLATTEN void forces(const StepContext& step, std::span<double> history,
                         std::span<double> corner_forces, std::span<double> /*corner_moments*/,
                         int first, int last, BlockSums& sums) const override {
    LaneSums<N> lanes;
    decltype(auto) law = ready_law(law_, step.dt);
    for (int group = first; group < last; group += kGroupsPerPack<N>) {
      const int pack = group / kGroupsPerPack<N>;
      HexNodes<N> nodes;
      load_corners(step.nodes, group_nodes(group), nodes.x, nodes.v);
      const HexReference<N>& shape = shapes_.packs[pack];
      const HexAnswer<N> answer =
          hex8_forces(shape, shapes_.metrics[pack], nodes, law, controls_, step.dt,
                      kept_.of(history, pack), step.wants_stable_step);
      store_corner_forces(answer, corner_forces.data() + corner_slot(group - first, 0, 0));
      add_to_sums(answer, N((law_.density / 8.0) * shape.volume), lane_mask<N>(pack), step, pack,
                  element_count(), lanes, sums);
    }
    lanes.book(sums);
  }

  bool is_alive(std::span<const double> history, int element) const override {
    if constexpr (requires { Law::kAlive; })
      return kept_.of(history, element / kWidth<N>)[Law::kAlive][element % kWidth<N>] > 0;
    return true;
  }

  double initial_stiffness(int element) const override {
    const N per_volume = hex_stiffness_at_rest(shapes_.metrics[element / kWidth<N>].entries,
                                               law_.bulk_modulus(), law_.shear_modulus());
    return element_volume(element) * per_volume[element % kWidth<N>];
  }

  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override {
    const int pack = element / kWidth<N>, lane = element % kWidth<N>;
    HexNodes<N> nodes;
    load_corners(step.nodes, group_nodes(pack * kGroupsPerPack<N>), nodes.x, nodes.v);
    const HexReference<N>& ref = shapes_.packs[pack];
    const N* own = kept_.of(history, pack);
    std::vector<N, Eigen::aligned_allocator<N>> copy(own, own + law_.history_size());
    SolidStep<N> still;
    still.F = gradient_of(ref, nodes.x);
    still.F_rate = gradient_of(ref, nodes.v);
    still.J = determinant(still.F);
    still.F_inverse = inverse(still.F, still.J);
    const SolidAnswer<N> material = law_.update(still, copy.data());
    const Symmetric<N> sigma = cauchy_stress(material.P, still.F, still.J);

    ElementSample out;
    out.volume = element_volume(element);
    out.energy = material.energy[lane] * out.volume;
    out.is_alive = material.alive[lane] > 0;
    if constexpr (requires { Law::kPlasticStrain; })
      out.plastic_strain = copy[Law::kPlasticStrain][lane];
    out.centre = centre(step.nodes, element);
    for (int k = 0; k < 9; ++k) out.deformation(k / 3, k % 3) = still.F(k / 3, k % 3)[lane];
    out.stress << sigma.xx[lane], sigma.xy[lane], sigma.zx[lane], sigma.xy[lane], sigma.yy[lane],
        sigma.yz[lane], sigma.zx[lane], sigma.yz[lane], sigma.zz[lane];
    return out;
  }

 private:
  int pack_count() const { return group_count() / kGroupsPerPack<N>; }

  Law law_;
  ElementControls controls_;
  PackHistory<N> kept_;
  HexShapes<N> shapes_;
};

}  // namespace crosswalk::fe
