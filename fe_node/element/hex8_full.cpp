#include "fe_node/element/hex8_full.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/element/dilation.h"
#include "fe_node/element/hex8_block.h"
#include "fe_node/element/hex8_points.h"
#include "fe_node/element/pack_history.h"
#include "fe_node/material/volume_law.h"

namespace crosswalk::fe {
namespace {

constexpr int kPoints = kHexPoints;

template <class N>
struct PointReference {
  Tensor<N> half_local;  ///< dxi/dX / 2, 1/m; see local_derivatives()
  N volume;              ///< m3
};

template <class N>
struct FullHexReference {
  PointReference<N> points[kPoints];
  N volume, inverse_volume, length;
};

/// What only the bound of the stiffness asks for.
template <class N>
struct BoundReference {
  N metric[kPoints][6];  ///< sum of grad N_I grad N_I^T at each point, 1/m2
  N mean_metric[6];      ///< of the mean gradients, for the dilation
};

/// Gradients of the trilinear shape functions at a point and dxi/dX, with det dX/dxi.
double point_gradients(const Vec3 (&x)[8], const Vec3& xi, Vec3 (&gradient)[8], Mat3& local_rate) {
  constexpr double kSign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  Mat3 jacobian = Mat3::Zero();
  Vec3 local[8];
  for (int n = 0; n < 8; ++n) {
    const double a = 1 + kSign[n][0] * xi[0], b = 1 + kSign[n][1] * xi[1],
                 c = 1 + kSign[n][2] * xi[2];
    local[n] = 0.125 * Vec3(kSign[n][0] * b * c, kSign[n][1] * a * c, kSign[n][2] * a * b);
    jacobian += x[n] * local[n].transpose();
  }
  local_rate = jacobian.inverse();
  for (int n = 0; n < 8; ++n) gradient[n] = local_rate.transpose() * local[n];
  return jacobian.determinant();
}

void set_metric(const Vec3 (&b)[8], double (&metric)[6]) {
  Mat3 sum = Mat3::Zero();
  for (const Vec3& g : b) sum += g * g.transpose();
  const double entries[6] = {sum(0, 0), sum(1, 1), sum(2, 2), sum(0, 1), sum(1, 2), sum(2, 0)};
  std::copy_n(entries, 6, metric);
}

void set_references(const Vec3 (&x)[8], FullHexReference<double>& ref,
                    BoundReference<double>& bound) {
  const double a = 1 / std::sqrt(3.0);
  Vec3 mean[8];
  for (Vec3& g : mean) g.setZero();
  ref.volume = 0;
  for (int q = 0; q < kPoints; ++q) {
    Vec3 b[8];
    Mat3 local_rate;
    const Vec3 xi(q & 1 ? a : -a, q & 2 ? a : -a, q & 4 ? a : -a);
    PointReference<double>& point = ref.points[q];
    point.volume = point_gradients(x, xi, b, local_rate);
    CW_ASSERT(point.volume > 0);  // the model builder refuses such elements with their place
    for (int c = 0; c < 8; ++c) mean[c] += point.volume * b[c];
    for (int k = 0; k < 9; ++k) point.half_local(k / 3, k % 3) = 0.5 * local_rate(k / 3, k % 3);
    set_metric(b, bound.metric[q]);
    ref.volume += point.volume;
  }
  for (Vec3& g : mean) g /= ref.volume;
  set_metric(mean, bound.mean_metric);
  ref.inverse_volume = 1 / ref.volume;
  ref.length = std::cbrt(ref.volume);
}

/// The bounds of the points add up: the deviator's and that of uneven dilation by the gradients at
/// each, the volume's by the mean ones, as the averaging of the dilation only lowers it. N/m.
template <class N>
N point_stiffness(const FullHexReference<N>& ref, const BoundReference<N>& bound, int q,
                  const Tensor<N>& F_inverse, const N& J, const N& bulk, const N& shear,
                  const N& uneven_bulk) {
  const N of_shear =
      hex_stiffness(bound.metric[q], F_inverse, J, N(shear * (2.0 / 3) + uneven_bulk), shear);
  const N of_volume = hex_stiffness(bound.mean_metric, F_inverse, J, bulk, constant<N>(0));
  return ref.points[q].volume * (of_shear + of_volume);
}

double stiffness_at_rest(const FullHexReference<double>& ref, const BoundReference<double>& bound,
                         double bulk, double shear, double uneven_bulk) {
  const Tensor<double> identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double sum = 0;
  for (int q = 0; q < kPoints; ++q)
    sum += point_stiffness(ref, bound, q, identity, 1.0, bulk, shear, uneven_bulk);
  return sum;
}

/// Bulk modulus against uneven dilation, see hex8_full.h. Pa.
template <class Law>
double uneven_bulk_of(const Law& law) {
  if constexpr (requires { Law::kIsochoricShear; })
    return bulk_from_poisson(law.shear_modulus(), 0.45);
  return 0;
}

template <class N, class Law>
class FullHexBlock final : public ElementBlock {
 public:
  FullHexBlock(const Mesh& mesh, int part, std::vector<int> elements, const Law& law,
               const ElementControls& controls)
      : ElementBlock(mesh, ElementKind::Hex8, part, std::move(elements), kGroupsPerPack<N>),
        law_(law),
        controls_(controls),
        uneven_bulk_(uneven_bulk_of(law)),
        kept_(history_size()) {
    set_packs(mesh);
  }

  /// Scale of the last step per point, the element's life, then the points' own history.
  int history_per_group() const override { return kept_.per_group(); }
  void initialise(std::span<double> history) const override {
    for (int pack = 0; pack < pack_count(); ++pack) {
      N* h = kept_.of(history, pack);
      for (int k = 0; k <= kPoints; ++k) h[k] = constant<N>(1);
      for (int q = 0; q < kPoints; ++q) law_.initialise(point_history(h, q));
    }
  }
  double corner_mass(int element) const override {
    return 0.125 * law_.density * element_volume(element);
  }
  double element_volume(int element) const override { return volume_[element]; }
  double density() const override { return law_.density; }
  bool is_near_fluid() const override { return fe::is_near_fluid(law_); }
  int points() const override { return kPoints; }
  bool is_alive(std::span<const double> history, int element) const override {
    return kept_.of(history, element / kWidth<N>)[kPoints][element % kWidth<N>] > 0;
  }
  CW_FLATTEN void forces(const StepContext& step, std::span<double> history,
                         std::span<double> corner_forces, std::span<double> corner_moments,
                         int first, int last, BlockSums& sums) const override;
  double initial_stiffness(int element) const override { return stiffness_[element]; }
  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override;

 private:
  int pack_count() const { return group_count() / kGroupsPerPack<N>; }
  int history_size() const { return kPoints + 1 + kPoints * law_.history_size(); }
  N* point_history(N* h, int q) const { return h + kPoints + 1 + q * law_.history_size(); }

  void set_packs(const Mesh& mesh);

  Law law_;
  ElementControls controls_;
  double uneven_bulk_;  ///< Pa
  PackHistory<N> kept_;
  std::vector<FullHexReference<N>, Eigen::aligned_allocator<FullHexReference<N>>> packs_;
  std::vector<BoundReference<N>, Eigen::aligned_allocator<BoundReference<N>>> bounds_;
  std::vector<double> volume_, stiffness_;
};

template <class N, class Law>
void FullHexBlock<N, Law>::set_packs(const Mesh& mesh) {
  packs_.resize(pack_count());
  bounds_.resize(pack_count());
  volume_.assign(element_count(), 0.0);
  stiffness_.assign(element_count(), 0.0);
  for (int slot = 0; slot < group_count() * kLanes; ++slot) {
    Vec3 x[8];
    for (int c = 0; c < 8; ++c) x[c] = mesh.position[node(slot / kLanes, c, slot % kLanes)];
    FullHexReference<double> ref;
    BoundReference<double> bound;
    set_references(x, ref, bound);
    if (slot < element_count()) {
      volume_[slot] = ref.volume;
      stiffness_[slot] =
          stiffness_at_rest(ref, bound, law_.bulk_modulus(), law_.shear_modulus(), uneven_bulk_);
    }
    set_lane(ref, slot % kWidth<N>, packs_[slot / kWidth<N>]);
    set_lane(bound, slot % kWidth<N>, bounds_[slot / kWidth<N>]);
  }
}

template <class N, class Law>
void FullHexBlock<N, Law>::forces(const StepContext& step, std::span<double> history,
                                  std::span<double> corner_forces, std::span<double> /*moments*/,
                                  int first, int last, BlockSums& sums) const {
  LaneSums<N> lanes;
  decltype(auto) law = ready_law(law_, step.dt);
  for (int group = first; group < last; group += kGroupsPerPack<N>) {
    const int pack = group / kGroupsPerPack<N>;
    const FullHexReference<N>& ref = packs_[pack];
    HexNodes<N> nodes;
    load_corners(step.nodes, group_nodes(group), nodes.x, nodes.v);
    N* h = kept_.of(history, pack);
    Tensor<N> F[kPoints], F_rate[kPoints], F_inverse[kPoints];
    local_derivatives(nodes.x, F);
    local_derivatives(nodes.v, F_rate);
    N J[kPoints], mean_J = constant<N>(0), growth = constant<N>(0);
    HexAnswer<N> answer;
    answer.J = constant<N>(std::numeric_limits<double>::infinity());
    for (int q = 0; q < kPoints; ++q) {
      F[q] = product(F[q], ref.points[q].half_local);
      F_rate[q] = product(F_rate[q], ref.points[q].half_local);
      if constexpr (requires { Law::kAlive; }) rest_where_failed(h[kPoints], F[q], F_rate[q]);
      J[q] = determinant(F[q]);
      F_inverse[q] = inverse(F[q], J[q]);
      mean_J += ref.points[q].volume * J[q];
      growth += ref.points[q].volume * J[q] * expansion_rate(F_rate[q], F_inverse[q]);
      answer.J = smaller_or_nan(answer.J, J[q]);
    }
    growth /= mean_J;
    mean_J *= ref.inverse_volume;

    // With the law's P of Fbar = s F the Kirchhoff stress is tau = s P F^T; its own third of the
    // trace gives way to the mean pressure: P of F is s P + (p - tr tau / 3) F^-T.
    const N inverse_mean_J = 1.0 / mean_J;
    Tensor<N> scaled_P[kPoints];
    N mean_p = constant<N>(0), alive = h[kPoints], bulk = constant<N>(0), shear = constant<N>(0);
    N own_p[kPoints];
    answer.energy = answer.stiffness = constant<N>(0);
    for (int q = 0; q < kPoints; ++q) {
      const N unevenness = J[q] * inverse_mean_J;
      const Dilation<N> now = dilation(unevenness);
      const SolidStep<N> bar =
          dilated_step(F[q], F_rate[q], F_inverse[q], mean_J, now, h[q], step.dt);
      if (step.dt > 0) h[q] = now.scale;
      const SolidAnswer<N> material = law.update(bar, point_history(h, q));
      N trace = constant<N>(0);
      for (int k = 0; k < 9; ++k) {
        N& entry = scaled_P[q](k / 3, k % 3);
        entry = now.scale * material.P(k / 3, k % 3);
        trace += entry * F[q](k / 3, k % 3);
      }
      own_p[q] = trace * (1.0 / 3.0) - (0.5 * uneven_bulk_) * (unevenness * unevenness - 1.0);
      mean_p += ref.points[q].volume * own_p[q];
      alive = smaller(alive, material.alive);
      answer.energy += ref.points[q].volume *
                       (material.energy + (0.5 * uneven_bulk_) * volume_energy(unevenness));
      bulk = larger(bulk, material.bulk_modulus);
      shear = larger(shear, material.shear_modulus);
      if (step.wants_stable_step)
        answer.stiffness +=
            point_stiffness(ref, bounds_[pack], q, F_inverse[q], J[q], material.bulk_modulus,
                            material.shear_modulus,
                            N((0.5 * uneven_bulk_) * (1.0 + unevenness * unevenness) / J[q]));
    }
    mean_p *= ref.inverse_volume * inverse_mean_J;
    h[kPoints] = alive;

    // Bulk viscosity as of the one-point brick, on the mean rate.
    const N wave_speed = square_root(N((bulk + 4.0 / 3.0 * shear) * mean_J / law_.density));
    const N compression = larger(N(-growth), constant<N>(0)) * ref.length;
    const N viscous_speed =
        controls_.quadratic_bulk * compression + controls_.linear_bulk * wave_speed;
    const N q_mean = law_.density * viscous_speed * compression;
    for (auto& corner : answer.force)
      for (N& f : corner) f = constant<N>(0);
    for (int q = 0; q < kPoints; ++q) {
      const PointReference<N>& point = ref.points[q];
      const N p = (mean_p - q_mean * inverse_mean_J) * J[q] - own_p[q];
      Tensor<N>& P = scaled_P[q];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) P(i, j) += p * F_inverse[q](j, i);
      const N factor = point.volume * alive;
      Tensor<N>& conjugate = F[q];  // to the local derivatives; F has done its work
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          conjugate(i, k) =
              factor * (P(i, 0) * point.half_local(k, 0) + P(i, 1) * point.half_local(k, 1) +
                        P(i, 2) * point.half_local(k, 2));
    }
    subtract_loads(F, answer.force);
    answer.alive = alive;
    answer.hourglass_stored = answer.hourglass_power = constant<N>(0);
    answer.viscous_power = q_mean * compression / ref.length * ref.volume;
    answer.stiffness *= alive * stiffening_by_viscosity(compression, viscous_speed, wave_speed);
    store_corner_forces(answer, corner_forces.data() + corner_slot(group - first, 0, 0));
    add_to_sums(answer, N((0.125 * law_.density) * ref.volume), lane_mask<N>(pack), step, pack,
                element_count(), lanes, sums);
  }
  lanes.book(sums);
}

// Outputs ask for one element at a time: its own numbers alone, not those of its pack.
template <class N, class Law>
ElementSample FullHexBlock<N, Law>::sample(const StepContext& step, std::span<const double> history,
                                           int element) const {
  const int pack = element / kWidth<N>, lane = element % kWidth<N>;
  const FullHexReference<double> ref = lane_of(packs_[pack], lane);
  const N* kept = kept_.of(history, pack);
  std::vector<double> h(history_size());
  for (int k = 0; k < history_size(); ++k) h[k] = kept[k][lane];
  double x[8][3];
  for (int c = 0; c < 8; ++c) {
    const Vec3 p = step.nodes[node(element / kLanes, c, element % kLanes)].position();
    for (int axis = 0; axis < 3; ++axis) x[c][axis] = p[axis];
  }
  ElementSample out;
  out.deformation.setZero();
  out.volume = element_volume(element);
  out.is_alive = h[kPoints] > 0;
  Tensor<double> F[kPoints];
  local_derivatives(x, F);
  double J[kPoints], mean_J = 0;
  for (int q = 0; q < kPoints; ++q) {
    F[q] = product(F[q], ref.points[q].half_local);
    J[q] = determinant(F[q]);
    mean_J += ref.points[q].volume * J[q] * ref.inverse_volume;
  }
  for (int q = 0; q < kPoints; ++q) {
    const double volume = ref.points[q].volume, share = volume / out.volume;
    const Dilation<double> now = dilation(J[q] / mean_J);
    const SolidStep<double> still =
        dilated_step(F[q], Tensor<double>{}, inverse(F[q], J[q]), mean_J, now, now.scale, 0);
    double* own = h.data() + kPoints + 1 + q * law_.history_size();
    const SolidAnswer<double> material = law_.update(still, own);
    const Symmetric<double> s = cauchy_stress(material.P, still.F, still.J);
    Mat3 stress;
    stress << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz;
    out.stress += share * stress;
    out.energy += volume * (material.energy + 0.5 * uneven_bulk_ * volume_energy(J[q] / mean_J));
    for (int k = 0; k < 9; ++k) out.deformation(k / 3, k % 3) += share * F[q](k / 3, k % 3);
    if constexpr (requires { Law::kPlasticStrain; })
      out.plastic_strain = std::max(out.plastic_strain, own[Law::kPlasticStrain]);
  }
  out.centre = centre(step.nodes, element);
  return out;
}

}  // namespace

std::unique_ptr<ElementBlock> make_full_hex8_block(const Mesh& mesh, int part,
                                                   std::vector<int> elements, const SolidLaw& law,
                                                   const ElementControls& controls) {
  return std::visit(
      [&](const auto& l) -> std::unique_ptr<ElementBlock> {
        using Law = std::decay_t<decltype(l)>;
        if (controls.precision == Precision::Single)
          return std::make_unique<FullHexBlock<SingleLanes, Law>>(mesh, part, std::move(elements),
                                                                  l, controls);
        return std::make_unique<FullHexBlock<Lanes, Law>>(mesh, part, std::move(elements), l,
                                                          controls);
      },
      law);
}

}  // namespace crosswalk::fe
