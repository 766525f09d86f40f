#include "fe_node/element/hex8_full.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "fe_node/element/dilation.h"
#include "fe_node/element/hex8_block.h"
#include "fe_node/element/hex8_points.h"

namespace crosswalk::fe {
namespace {

constexpr int kPoints = kHexPoints;

struct PointReference {
  Tensor<Lanes> half_local;  ///< dxi/dX / 2, 1/m; see local_derivatives()
  Lanes volume;              ///< m3
};

struct FullHexReference {
  PointReference points[kPoints];
  Lanes volume, inverse_volume, length;
};

/// What only the stable step asks for.
struct StepReference {
  Lanes metric[kPoints][6];  ///< sum of grad N_I grad N_I^T at each point, 1/m2
  Lanes mean_metric[6];      ///< of the mean gradients, for the dilation
  Lanes density;             ///< with added mass, kg/m3
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

void set_metric(const Vec3 (&b)[8], int lane, Lanes (&metric)[6]) {
  Mat3 sum = Mat3::Zero();
  for (const Vec3& g : b) sum += g * g.transpose();
  const double entries[6] = {sum(0, 0), sum(1, 1), sum(2, 2), sum(0, 1), sum(1, 2), sum(2, 0)};
  for (int k = 0; k < 6; ++k) metric[k][lane] = entries[k];
}

template <class Law>
class FullHexBlock final : public ElementBlock {
 public:
  FullHexBlock(const Mesh& mesh, int part, std::vector<int> elements, const Law& law,
               const ElementControls& controls)
      : ElementBlock(mesh, ElementKind::Hex8, part, std::move(elements)),
        law_(law),
        controls_(controls) {
    set_reference(mesh);
  }

  /// Scale of the last step per point, the element's life, then the points' own history.
  int history_per_group() const override {
    return (kPoints + 1 + kPoints * law_.history_size()) * kLanes;
  }
  void initialise(std::span<double> history) const override {
    for (int group = 0; group < group_count(); ++group) {
      Lanes* h = at(history, group);
      for (int k = 0; k <= kPoints; ++k) h[k] = Lanes::Ones();
      for (int q = 0; q < kPoints; ++q) law_.initialise(point_history(h, q));
    }
  }
  double corner_mass(int element) const override {
    return 0.125 * (law_.density + added_density_[element]) * element_volume(element);
  }
  double added_mass(int element) const override {
    return added_density_[element] * element_volume(element);
  }
  double element_volume(int element) const override {
    return groups_[element / kLanes].volume[element % kLanes];
  }
  double density() const override { return law_.density; }
  int points() const override { return kPoints; }
  bool is_alive(std::span<const double> history, int element) const override {
    const double* h = history.data() + std::size_t(history_per_group()) * (element / kLanes);
    return h[kPoints * kLanes + element % kLanes] > 0;
  }
  CW_FLATTEN void forces(const StepContext& step, std::span<double> history,
                         std::span<double> corner_forces, std::span<double> corner_moments,
                         int first, int last, BlockSums& sums) const override;
  double initial_stable_step(int element) const override {
    Tensor<Lanes> identity;
    for (int k = 0; k < 9; ++k) identity(k / 3, k % 3) = Lanes::Constant(k % 4 == 0 ? 1.0 : 0.0);
    const int group = element / kLanes;
    Bound bound(*this, group);
    for (int q = 0; q < kPoints; ++q)
      bound.add(q, identity, Lanes::Ones(), Lanes::Constant(law_.bulk_modulus()),
                Lanes::Constant(law_.shear_modulus()));
    return std::sqrt(bound.step_squared()[element % kLanes]);
  }
  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override;

 private:
  Lanes* at(std::span<double> history, int group) const {
    return reinterpret_cast<Lanes*>(history.data() + std::size_t(history_per_group()) * group);
  }
  Lanes* point_history(Lanes* h, int q) const { return h + kPoints + 1 + q * law_.history_size(); }

  /// Rayleigh's bound: omega^2 is at most the volume mean of the points' own bounds
  /// 8 J / rho0 (K tr g + 2 mu g_max), which the averaging of the dilation only lowers.
  class Bound {
   public:
    Bound(const FullHexBlock& block, int group)
        : ref_(block.groups_[group]), step_(block.steps_[group]) {}
    void add(int q, const Tensor<Lanes>& F_inverse, const Lanes& J, const Lanes& bulk,
             const Lanes& shear) {
      HexReference<Lanes> point;
      for (int k = 0; k < 6; ++k) point.metric[k] = step_.metric[q][k];
      point.density = step_.density;
      // the deviator alone at the point; the volume by the mean gradients, below
      const Lanes shear_part =
          hex_stable_step_squared(point, F_inverse, J, Lanes(shear * (2.0 / 3)), shear);
      sum_ += ref_.points[q].volume / shear_part;
      HexReference<Lanes> mean = point;
      for (int k = 0; k < 6; ++k) mean.metric[k] = step_.mean_metric[k];
      const Lanes volume_part =
          hex_stable_step_squared(mean, F_inverse, J, bulk, Lanes(Lanes::Zero()));
      sum_ += ref_.points[q].volume / volume_part;
    }
    Lanes step_squared() const { return ref_.volume / sum_; }

   private:
    const FullHexReference& ref_;
    const StepReference& step_;
    Lanes sum_ = Lanes::Zero();
  };

  void set_reference(const Mesh& mesh);

  Law law_;
  ElementControls controls_;
  std::vector<FullHexReference, Eigen::aligned_allocator<FullHexReference>> groups_;
  std::vector<StepReference, Eigen::aligned_allocator<StepReference>> steps_;
  std::vector<double> added_density_;
};

template <class Law>
void FullHexBlock<Law>::set_reference(const Mesh& mesh) {
  groups_.resize(group_count());
  steps_.resize(group_count());
  added_density_.assign(element_count(), 0.0);
  const double a = 1 / std::sqrt(3.0);
  for (int group = 0; group < group_count(); ++group) {
    FullHexReference& ref = groups_[group];
    StepReference& step = steps_[group];
    for (int lane = 0; lane < kLanes; ++lane) {
      Vec3 x[8], mean[8];
      for (int c = 0; c < 8; ++c) {
        x[c] = mesh.position[node(group, c, lane)];
        mean[c].setZero();
      }
      double volume = 0;
      for (int q = 0; q < kPoints; ++q) {
        Vec3 b[8];
        Mat3 local_rate;
        const Vec3 xi(q & 1 ? a : -a, q & 2 ? a : -a, q & 4 ? a : -a);
        const double v = point_gradients(x, xi, b, local_rate);
        CW_ASSERT(v > 0);  // the model builder refuses such elements with their place
        PointReference& point = ref.points[q];
        for (int c = 0; c < 8; ++c) mean[c] += v * b[c];
        for (int k = 0; k < 9; ++k)
          point.half_local(k / 3, k % 3)[lane] = 0.5 * local_rate(k / 3, k % 3);
        point.volume[lane] = v;
        set_metric(b, lane, step.metric[q]);
        volume += v;
      }
      for (Vec3& g : mean) g /= volume;
      set_metric(mean, lane, step.mean_metric);
      ref.volume[lane] = volume;
      ref.inverse_volume[lane] = 1 / volume;
      ref.length[lane] = std::cbrt(volume);
      step.density[lane] = law_.density;
    }
  }
  for (int e = 0; e < element_count(); ++e) {
    const double lacking = controls_.minimum_step / initial_stable_step(e);
    if (lacking > 1) added_density_[e] = law_.density * (lacking * lacking - 1);
  }
  for (int e = 0; e < element_count(); ++e)
    steps_[e / kLanes].density[e % kLanes] += added_density_[e];
}

template <class Law>
void FullHexBlock<Law>::forces(const StepContext& step, std::span<double> history,
                               std::span<double> corner_forces, std::span<double> /*moments*/,
                               int first, int last, BlockSums& sums) const {
  LaneSums lanes;
  decltype(auto) law = ready_law(law_, step.dt);
  for (int group = first; group < last; ++group) {
    const FullHexReference& ref = groups_[group];
    const HexNodes<Lanes> nodes = load_hex_nodes(step.nodes, group_nodes(group));
    Lanes* h = at(history, group);
    Tensor<Lanes> F[kPoints], F_rate[kPoints], F_inverse[kPoints];
    local_derivatives(nodes.x, F);
    local_derivatives(nodes.v, F_rate);
    Lanes J[kPoints], mean_J = Lanes::Zero(), growth = Lanes::Zero();
    HexAnswer<Lanes> answer;
    answer.J = Lanes::Constant(1e300);
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

    Symmetric<Lanes> tau[kPoints];
    Lanes mean_p = Lanes::Zero(), alive = h[kPoints], bulk = Lanes::Zero(), shear = Lanes::Zero();
    answer.energy = Lanes::Zero();
    Bound bound(*this, group);
    for (int q = 0; q < kPoints; ++q) {
      const Lanes scale = dilation_scale(mean_J, J[q]);
      const SolidStep<Lanes> bar = dilated_step(F[q], F_rate[q], J[q], scale, h[q], step.dt);
      if (step.dt > 0) h[q] = scale;
      const SolidAnswer<Lanes> material = law.update(bar, point_history(h, q));
      tau[q] = kirchhoff_stress(material.P, bar.F);
      const Lanes third = trace(tau[q]) * (1.0 / 3.0);
      add_pressure(tau[q], Lanes(-third));
      mean_p += ref.points[q].volume * third;
      alive = smaller(alive, material.alive);
      answer.energy += ref.points[q].volume * material.energy;
      bulk = larger(bulk, material.bulk_modulus);
      shear = larger(shear, material.shear_modulus);
      if (step.wants_stable_step)
        bound.add(q, F_inverse[q], J[q], material.bulk_modulus, material.shear_modulus);
    }
    mean_p *= ref.inverse_volume / mean_J;
    h[kPoints] = alive;

    // Bulk viscosity as of the one-point brick, on the mean rate.
    const Lanes wave_speed = square_root(Lanes((bulk + 4.0 / 3.0 * shear) * mean_J / law_.density));
    const Lanes compression = larger(Lanes(-growth), constant<Lanes>(0)) * ref.length;
    const Lanes viscous_speed =
        controls_.quadratic_bulk * compression + controls_.linear_bulk * wave_speed;
    const Lanes q_mean = law_.density * viscous_speed * compression;
    for (auto& corner : answer.force)
      for (Lanes& f : corner) f = Lanes::Zero();
    for (int q = 0; q < kPoints; ++q) {
      const PointReference& point = ref.points[q];
      add_pressure(tau[q], Lanes((mean_p - q_mean / mean_J) * J[q]));
      const Tensor<Lanes> P = pulled_back(tau[q], F_inverse[q]);
      const Lanes factor = point.volume * alive;
      Tensor<Lanes>& conjugate = F[q];  // to the local derivatives; F has done its work
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          conjugate(i, k) =
              factor * (P(i, 0) * point.half_local(k, 0) + P(i, 1) * point.half_local(k, 1) +
                        P(i, 2) * point.half_local(k, 2));
    }
    subtract_loads(F, answer.force);
    answer.alive = alive;
    answer.hourglass_stored = answer.hourglass_power = Lanes::Zero();
    answer.viscous_power = q_mean * compression / ref.length * ref.volume;
    const Lanes ratio = where_less(constant<Lanes>(0), compression,
                                   Lanes(viscous_speed / wave_speed), constant<Lanes>(0));
    const Lanes shorten = square_root(Lanes(1.0 + ratio * ratio)) - ratio;
    answer.stable_step_squared = bound.step_squared() * shorten * shorten;
    store_corner_forces(answer, corner_forces.data() + corner_slot(group - first, 0, 0));
    add_to_sums(answer, lane_mask(group), step, group, element_count(), lanes, sums);
  }
  lanes.book(sums);
}

template <class Law>
ElementSample FullHexBlock<Law>::sample(const StepContext& step, std::span<const double> history,
                                        int element) const {
  const int group = element / kLanes, lane = element % kLanes;
  const FullHexReference& ref = groups_[group];
  const HexNodes<Lanes> nodes = load_hex_nodes(step.nodes, group_nodes(group));
  std::vector<Lanes, Eigen::aligned_allocator<Lanes>> copy(history_per_group() / kLanes + 1);
  std::copy_n(history.data() + std::size_t(history_per_group()) * group, history_per_group(),
              copy.front().data());
  ElementSample out;
  out.deformation.setZero();
  out.volume = element_volume(element);
  out.is_alive = copy[kPoints][lane] > 0;
  Tensor<Lanes> F[kPoints];
  local_derivatives(nodes.x, F);
  Lanes J[kPoints], mean_J = Lanes::Zero();
  for (int q = 0; q < kPoints; ++q) {
    F[q] = product(F[q], ref.points[q].half_local);
    J[q] = determinant(F[q]);
    mean_J += ref.points[q].volume * J[q] * ref.inverse_volume;
  }
  Tensor<Lanes> none;
  for (int k = 0; k < 9; ++k) none(k / 3, k % 3) = Lanes::Zero();
  for (int q = 0; q < kPoints; ++q) {
    const Lanes scale = dilation_scale(mean_J, J[q]);
    const SolidStep<Lanes> still = dilated_step(F[q], none, J[q], scale, scale, 0);
    Lanes* h = point_history(copy.data(), q);
    const SolidAnswer<Lanes> material = law_.update(still, h);
    const Symmetric<Lanes> s = cauchy_stress(material.P, still.F, still.J);
    const double share = ref.points[q].volume[lane] / out.volume;
    Mat3 stress;
    stress << s.xx[lane], s.xy[lane], s.zx[lane], s.xy[lane], s.yy[lane], s.yz[lane], s.zx[lane],
        s.yz[lane], s.zz[lane];
    out.stress += share * stress;
    out.energy += ref.points[q].volume[lane] * material.energy[lane];
    for (int k = 0; k < 9; ++k) out.deformation(k / 3, k % 3) += share * F[q](k / 3, k % 3)[lane];
    if constexpr (requires { Law::kPlasticStrain; })
      out.plastic_strain = std::max(out.plastic_strain, h[Law::kPlasticStrain][lane]);
  }
  for (int c = 0; c < 8; ++c)
    for (int i = 0; i < 3; ++i) out.centre[i] += 0.125 * nodes.x[c][i][lane];
  return out;
}

}  // namespace

std::unique_ptr<ElementBlock> make_full_hex8_block(const Mesh& mesh, int part,
                                                   std::vector<int> elements, const SolidLaw& law,
                                                   const ElementControls& controls) {
  return std::visit(
      [&](const auto& l) -> std::unique_ptr<ElementBlock> {
        using Law = std::decay_t<decltype(l)>;
        return std::make_unique<FullHexBlock<Law>>(mesh, part, std::move(elements), l, controls);
      },
      law);
}

}  // namespace crosswalk::fe
