#include "fe_node/element/tet4.h"

#include <algorithm>

#include "common/error.h"
#include "fe_node/element/dilation.h"
#include "fe_node/element/hex8_block.h"

namespace crosswalk::fe {
namespace {

struct TetReference {
  Lanes gradient[4][3];  ///< grad N_I, 1/m
  Lanes volume;
  Lanes metric[6];  ///< sum of grad N_I grad N_I^T, xx yy zz xy yz zx
  Lanes length;     ///< least altitude, m
};

struct TetNodes {
  Lanes x[4][3], v[4][3];
};

/// Per group in front of the law's history. The values of nodes (first J, then pressure) lie in
/// kNodal: there are never more nodes than element corners.
enum Slot {
  kScale,  ///< (Jbar / J)^(1/3) of the last step
  kAlive,
  kJ,
  kEnergy,
  kBulk,
  kShear,
  kPressure,  ///< tr tau / (3 Jbar)
  kTau,       ///< deviator, 6
  kNodal = kTau + 6,
  kSlots = kNodal + 4
};

template <class Law>
class Tet4Block final : public ElementBlock {
 public:
  Tet4Block(const Mesh& mesh, int part, std::vector<int> elements, const Law& law,
            const ElementControls& controls, TetPressure pressure)
      : ElementBlock(mesh, ElementKind::Tet4, part, std::move(elements)),
        law_(law),
        controls_(controls),
        pressure_(pressure) {
    set_reference(mesh);
    if (pressure_ == TetPressure::NodalMean) number_nodes(mesh);
  }

  int history_per_group() const override { return (kSlots + law_.history_size()) * kLanes; }
  void initialise(std::span<double> history) const override {
    for (int group = 0; group < group_count(); ++group) {
      Lanes* h = at(history, group);
      h[kScale] = h[kAlive] = Lanes::Ones();
      law_.initialise(h + kSlots);
    }
  }
  double corner_mass(int element) const override {
    return 0.25 * law_.density * element_volume(element);
  }
  double element_volume(int element) const override {
    return groups_[element / kLanes].volume[element % kLanes];
  }
  double density() const override { return law_.density; }
  bool is_near_fluid() const override { return fe::is_near_fluid(law_); }
  bool is_alive(std::span<const double> history, int element) const override {
    return at(history, element / kLanes)[kAlive][element % kLanes] > 0;
  }

  bool has_neighbours() const override { return pressure_ == TetPressure::NodalMean; }
  void prepare(const StepContext& step, std::span<double> history) const override;
  void forces(const StepContext& step, std::span<double> history, std::span<double> corner_forces,
              std::span<double> corner_moments, int first, int last,
              BlockSums& sums) const override;
  double initial_stiffness(int element) const override {
    const Lanes per_volume = hex_stiffness_at_rest(groups_[element / kLanes].metric,
                                                   law_.bulk_modulus(), law_.shear_modulus());
    return element_volume(element) * per_volume[element % kLanes];
  }
  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override;

 private:
  Lanes* at(std::span<double> history, int group) const {
    return reinterpret_cast<Lanes*>(history.data() + std::size_t(history_per_group()) * group);
  }
  const Lanes* at(std::span<const double> history, int group) const {
    return reinterpret_cast<const Lanes*>(history.data() +
                                          std::size_t(history_per_group()) * group);
  }
  double& nodal(std::span<double> history, int node) const {
    return at(history, node / (4 * kLanes))[kNodal + node / kLanes % 4].data()[node % kLanes];
  }
  void set_reference(const Mesh& mesh);
  void number_nodes(const Mesh& mesh);
  TetNodes load(const StepContext& step, int group) const;
  struct Deformation {
    Tensor<Lanes> F, F_rate;
  };
  /// None of an element that has failed.
  Deformation deformation(const StepContext& step, int group, const Lanes* h) const;
  /// Dilation of an element from that of its nodes; then the law's answer into the history.
  void update_law(const StepContext& step, int group, const Tensor<Lanes>& F,
                  const Tensor<Lanes>& F_rate, const Lanes& J, const Lanes& mean_J, Lanes* h) const;
  Lanes mean_of_nodes(std::span<double> history, int group) const;
  /// Volume-weighted mean over the live elements of each node of a slot, into kNodal.
  void average_at_nodes(std::span<double> history, int slot, double of_none, int threads) const;

  Law law_;
  ElementControls controls_;
  TetPressure pressure_;
  std::vector<TetReference, Eigen::aligned_allocator<TetReference>> groups_;
  int node_count_ = 0;
  std::vector<int> local_;                 ///< node of a corner, numbered within the block
  std::vector<int> begin_, element_list_;  ///< elements of each node
};

template <class Law>
void Tet4Block<Law>::set_reference(const Mesh& mesh) {
  groups_.resize(group_count());
  for (int group = 0; group < group_count(); ++group) {
    TetReference& ref = groups_[group];
    for (int lane = 0; lane < kLanes; ++lane) {
      Vec3 x[4];
      for (int c = 0; c < 4; ++c) x[c] = mesh.position[node(group, c, lane)];
      const double volume = tet4_volume(x[0], x[1], x[2], x[3]);
      CW_ASSERT(volume > 0);  // the model builder refuses such elements with their place
      Mat3 edges;
      for (int k = 0; k < 3; ++k) edges.row(k) = (x[k + 1] - x[0]).transpose();
      const Mat3 inverse = edges.inverse();
      Vec3 b[4];
      b[0].setZero();
      for (int k = 0; k < 3; ++k) {
        b[k + 1] = inverse.col(k);
        b[0] -= b[k + 1];
      }
      Mat3 metric = Mat3::Zero();
      double steepest = 0;
      for (int c = 0; c < 4; ++c) {
        metric += b[c] * b[c].transpose();
        steepest = std::max(steepest, b[c].norm());
        for (int i = 0; i < 3; ++i) ref.gradient[c][i].set(lane, b[c][i]);
      }
      ref.volume.set(lane, volume);
      ref.length.set(lane, 1 / steepest);
      const double entries[6] = {metric(0, 0), metric(1, 1), metric(2, 2),
                                 metric(0, 1), metric(1, 2), metric(2, 0)};
      for (int k = 0; k < 6; ++k) ref.metric[k].set(lane, entries[k]);
    }
  }
}

template <class Law>
void Tet4Block<Law>::number_nodes(const Mesh& mesh) {
  std::vector<int> number(mesh.node_count(), -1);
  local_.resize(static_cast<std::size_t>(group_count()) * 4 * kLanes);
  for (int group = 0; group < group_count(); ++group)
    for (int c = 0; c < 4; ++c)
      for (int lane = 0; lane < kLanes; ++lane) {
        int& n = number[node(group, c, lane)];
        if (n < 0) n = node_count_++;
        local_[(static_cast<std::size_t>(group) * 4 + c) * kLanes + lane] = n;
      }
  const auto each_corner = [&](auto&& visit) {
    for (int e = 0; e < element_count(); ++e)
      for (int c = 0; c < 4; ++c)
        visit(local_[(static_cast<std::size_t>(e / kLanes) * 4 + c) * kLanes + e % kLanes], e);
  };
  begin_.assign(node_count_ + 1, 0);
  each_corner([&](int n, int) { ++begin_[n + 1]; });
  for (int n = 0; n < node_count_; ++n) begin_[n + 1] += begin_[n];
  element_list_.resize(begin_.back());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  each_corner([&](int n, int e) { element_list_[next[n]++] = e; });
}

template <class Law>
TetNodes Tet4Block<Law>::load(const StepContext& step, int group) const {
  TetNodes out;
  load_corners(step.nodes, group_nodes(group), out.x, out.v);
  return out;
}

template <class Law>
Lanes Tet4Block<Law>::mean_of_nodes(std::span<double> history, int group) const {
  Lanes sum = Lanes::Zero();
  const int* local = local_.data() + static_cast<std::size_t>(group) * 4 * kLanes;
  for (int c = 0; c < 4; ++c)
    for (int lane = 0; lane < kLanes; ++lane)
      sum.data()[lane] += 0.25 * nodal(history, local[c * kLanes + lane]);
  return sum;
}

template <class Law>
void Tet4Block<Law>::average_at_nodes(std::span<double> history, int slot, double of_none,
                                      int threads) const {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int n = 0; n < node_count_; ++n) {
    double sum = 0, weight = 0;
    for (int k = begin_[n]; k < begin_[n + 1]; ++k) {
      const int e = element_list_[k];
      const Lanes* h = at(std::span<const double>(history), e / kLanes);
      const double w = element_volume(e) * h[kAlive][e % kLanes];
      sum += w * h[slot][e % kLanes];
      weight += w;
    }
    nodal(history, n) = weight > 0 ? sum / weight : of_none;
  }
}

template <class Law>
auto Tet4Block<Law>::deformation(const StepContext& step, int group, const Lanes* h) const
    -> Deformation {
  const TetNodes nodes = load(step, group);
  Deformation now{field_gradient(nodes.x, groups_[group].gradient),
                  field_gradient(nodes.v, groups_[group].gradient)};
  rest_where_failed(h[kAlive], now.F, now.F_rate);
  return now;
}

template <class Law>
void Tet4Block<Law>::update_law(const StepContext& step, int group, const Tensor<Lanes>& F,
                                const Tensor<Lanes>& F_rate, const Lanes& J, const Lanes& mean_J,
                                Lanes* h) const {
  const Dilation<Lanes> now = dilation(Lanes(J / mean_J));
  const SolidStep<Lanes> bar =
      dilated_step(F, F_rate, inverse(F, J), mean_J, now, h[kScale], step.dt);
  const SolidAnswer<Lanes> material = law_.update(bar, h + kSlots);
  Symmetric<Lanes> tau = kirchhoff_stress(material.P, bar.F);
  const Lanes third = trace(tau) * (1.0 / 3.0);
  add_pressure(tau, Lanes(-third));
  if (step.dt > 0) h[kScale] = now.scale;
  h[kAlive] = material.alive;
  h[kPressure] = third / bar.J * material.alive;
  h[kEnergy] = material.energy * groups_[group].volume;
  h[kBulk] = material.bulk_modulus;
  h[kShear] = material.shear_modulus;
  const Lanes* parts[6] = {&tau.xx, &tau.yy, &tau.zz, &tau.xy, &tau.yz, &tau.zx};
  for (int k = 0; k < 6; ++k) h[kTau + k] = *parts[k];
}

template <class Law>
void Tet4Block<Law>::prepare(const StepContext& step, std::span<double> history) const {
#pragma omp parallel for schedule(static) num_threads(step.threads)
  for (int group = 0; group < group_count(); ++group)
    at(history, group)[kJ] = determinant(deformation(step, group, at(history, group)).F);
  average_at_nodes(history, kJ, 1.0, step.threads);
#pragma omp parallel for schedule(static) num_threads(step.threads)
  for (int group = 0; group < group_count(); ++group) {
    Lanes* h = at(history, group);
    const Deformation now = deformation(step, group, h);
    update_law(step, group, now.F, now.F_rate, h[kJ], mean_of_nodes(history, group), h);
  }
  average_at_nodes(history, kPressure, 0.0, step.threads);
}

template <class Law>
void Tet4Block<Law>::forces(const StepContext& step, std::span<double> history,
                            std::span<double> corner_forces, std::span<double> /*moments*/,
                            int first, int last, BlockSums& sums) const {
  LaneSums<Lanes> lanes;
  for (int group = first; group < last; ++group) {
    const TetReference& ref = groups_[group];
    Lanes* h = at(history, group);
    const auto [F, F_rate] = deformation(step, group, h);
    HexAnswer<Lanes> answer;  // for the sums
    answer.J = determinant(F);
    const Tensor<Lanes> F_inverse = inverse(F, answer.J);
    if (pressure_ == TetPressure::Own) update_law(step, group, F, F_rate, answer.J, answer.J, h);
    const Lanes pressure =
        pressure_ == TetPressure::Own ? h[kPressure] : mean_of_nodes(history, group);

    // Bulk viscosity as of the brick.
    const Lanes wave_speed =
        square_root(Lanes((h[kBulk] + 4.0 / 3.0 * h[kShear]) * answer.J / law_.density));
    const Lanes compression =
        larger(Lanes(-expansion_rate(F_rate, F_inverse)), constant<Lanes>(0)) * ref.length;
    const Lanes viscous_speed =
        controls_.quadratic_bulk * compression + controls_.linear_bulk * wave_speed;
    const Lanes q = law_.density * viscous_speed * compression;
    Symmetric<Lanes> tau{h[kTau], h[kTau + 1], h[kTau + 2], h[kTau + 3], h[kTau + 4], h[kTau + 5]};
    add_pressure(tau, Lanes(pressure * answer.J - q));
    const Tensor<Lanes> P = pulled_back(tau, F_inverse);
    answer.stiffness = Lanes::Zero();
    if (step.wants_stable_step)
      answer.stiffness = h[kAlive] * ref.volume *
                         hex_stiffness(ref.metric, F_inverse, answer.J, h[kBulk], h[kShear]) *
                         stiffening_by_viscosity(compression, viscous_speed, wave_speed);
    const Lanes factor = -ref.volume * h[kAlive];
    for (int c = 0; c < 4; ++c) {
      Lanes f[3];
      for (int i = 0; i < 3; ++i)
        f[i] = factor * (P(i, 0) * ref.gradient[c][0] + P(i, 1) * ref.gradient[c][1] +
                         P(i, 2) * ref.gradient[c][2]);
      store_corner(f[0], f[1], f[2], answer.stiffness,
                   corner_forces.data() + corner_slot(group - first, c, 0), 0);
    }
    answer.alive = h[kAlive];
    answer.energy = h[kEnergy];
    answer.hourglass_stored = answer.hourglass_power = Lanes::Zero();
    answer.viscous_power = q * compression / ref.length * ref.volume;
    add_to_sums(answer, Lanes((0.25 * law_.density) * ref.volume), lane_mask<Lanes>(group), step,
                group, element_count(), lanes, sums);
  }
  lanes.book(sums);
}

template <class Law>
ElementSample Tet4Block<Law>::sample(const StepContext& step, std::span<const double> history,
                                     int element) const {
  const int group = element / kLanes, lane = element % kLanes;
  const TetNodes nodes = load(step, group);
  const Lanes* h = at(history, group);
  const Tensor<Lanes> F = field_gradient(nodes.x, groups_[group].gradient);
  const double J = determinant(F)[lane];
  ElementSample out;
  out.volume = element_volume(element);
  out.energy = h[kEnergy][lane];
  out.is_alive = h[kAlive][lane] > 0;
  out.centre = centre(step.nodes, element);
  for (int k = 0; k < 9; ++k) out.deformation(k / 3, k % 3) = F(k / 3, k % 3)[lane];
  const double p = h[kPressure][lane];
  out.stress << h[kTau][lane], h[kTau + 3][lane], h[kTau + 5][lane], h[kTau + 3][lane],
      h[kTau + 1][lane], h[kTau + 4][lane], h[kTau + 5][lane], h[kTau + 4][lane], h[kTau + 2][lane];
  out.stress = out.stress / J + p * Mat3::Identity();
  if constexpr (requires { Law::kPlasticStrain; })
    out.plastic_strain = h[kSlots + Law::kPlasticStrain][lane];
  return out;
}

}  // namespace

double tet4_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6;
}

std::unique_ptr<ElementBlock> make_tet4_block(const Mesh& mesh, int part, std::vector<int> elements,
                                              const SolidLaw& law, const ElementControls& controls,
                                              TetPressure pressure) {
  return std::visit(
      [&](const auto& l) -> std::unique_ptr<ElementBlock> {
        using Law = std::decay_t<decltype(l)>;
        return std::make_unique<Tet4Block<Law>>(mesh, part, std::move(elements), l, controls,
                                                pressure);
      },
      law);
}

}  // namespace crosswalk::fe
