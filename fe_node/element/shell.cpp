#include "fe_node/element/shell.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "common/error.h"
#include "fe_node/element/flatten.h"
#include "fe_node/element/pack_history.h"
#include "fe_node/element/shell_full.h"
#include "fe_node/element/shell_one_point.h"

namespace crosswalk::fe {

ShellMatter::ShellMatter(const ShellSection& of_section, const ElementControls& with_controls)
    : section(of_section),
      controls(with_controls),
      density(of_section.density()),
      mean_youngs(of_section.youngs_modulus()) {
  for (const ShellLayer& layer : section.layers)
    std::visit(
        [this](const auto& law) {
          if (law.youngs_modulus / (1 - law.poisson_ratio) > youngs / (1 - poisson)) {
            youngs = law.youngs_modulus;
            poisson = law.poisson_ratio;
          }
        },
        layer.law);
  for (const ShellLayer& layer : section.layers)
    for (const ShellPoint& point : layer.points) off_middle -= point.weight * point.position;
  if (std::abs(off_middle) < 1e-9) off_middle = 0;  // of rules that sum to nought in rounding
}

namespace {

/// Per pack in front of the element's history.
enum Header { kEnergy, kHourglassEnergy, kThickness, kAlive, kHeader };

template <class N, int kCorners>
struct ShellGeometry {
  Lanes3<N> x[kCorners], v[kCorners], spin[kCorners];
};

/// An element that has failed counts as a square at rest: its nodes go on without it and may fold
/// it to nothing.
template <class N, int kCorners>
void rest_where_failed(const N& alive, ShellGeometry<N, kCorners>& g) {
  constexpr double kSquare[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto rest = [&alive](Lanes3<N>& a, const double(&b)[3]) {
    N* of[] = {&a.x, &a.y, &a.z};
    for (int k = 0; k < 3; ++k)
      *of[k] = where_less(constant<N>(0), alive, *of[k], constant<N>(b[k]));
  };
  for (int corner = 0; corner < kCorners; ++corner) {
    rest(g.x[corner], kSquare[corner]);
    rest(g.v[corner], kSquare[0]);
    rest(g.spin[corner], kSquare[0]);
  }
}

template <class N, template <class> class ElementOf>
class ShellBlock final : public ElementBlock {
 public:
  using Element = ElementOf<N>;
  static constexpr int kCorners = Element::kCorners;

  ShellBlock(const Mesh& mesh, ElementKind kind, int part, std::vector<int> elements,
             const ShellSection& section, const ElementControls& controls,
             std::span<const double> thickness);

  int points() const override { return Element::kPoints; }
  bool has_moments() const override { return matter_.is_bending(); }
  int history_per_group() const override { return kept_.per_group(); }
  void initialise(std::span<double> history) const override;
  double corner_mass(int element) const override {
    return matter_.density * element_volume(element) / kCorners;
  }
  double corner_inertia(int element) const override {
    return corner_mass(element) * gyration_[element];
  }
  double element_volume(int element) const override { return area_[element] * thickness_[element]; }
  double density() const override { return matter_.density; }
  void forces(const StepContext& step, std::span<double> history, std::span<double> corner_forces,
              std::span<double> corner_moments, int first, int last,
              BlockSums& sums) const override;
  double initial_stiffness(int element) const override { return stiffness_[element]; }
  bool is_alive(std::span<const double> history, int element) const override {
    return kept_.of(history, element / kWidth<N>)[kAlive][element % kWidth<N>] > 0.5;
  }
  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override;

 private:
  /// Of a pack: mass, kg, and squared gyration, m2.
  struct Weight {
    N mass, gyration;
  };

  int pack_count() const { return group_count() / kGroupsPerPack<N>; }
  ShellGeometry<N, kCorners> load(const StepContext& step, int pack) const;
  ShellMotion<N, kCorners> motion(const ShellGeometry<N, kCorners>& g, double dt) const;
  /// Sets what belongs to one element, from its undeformed corners.
  void set_element(int element, const Lanes3<double> (&x)[kCorners]);
  void find_inverted(const N& area, int pack, BlockSums& sums) const;

  ShellMatter matter_;
  Element element_;
  PackHistory<N> kept_;
  std::vector<Weight, Eigen::aligned_allocator<Weight>> weights_;
  /// Per element, the padding's included: m, m2, m2, N/m.
  std::vector<double> thickness_, area_, gyration_, stiffness_;
};

/// Bound of the stiffness at each corner, N/m; times the squared gyration, of that against spins.
template <class N, class Element>
N corner_stiffness(const Element& element, const ShellShape<N, Element::kCorners>& shape,
                   const N& thickness, const N& gyration) {
  return shape.area * thickness * element.stiffness(shape, thickness, gyration);
}

template <class N, template <class> class ElementOf>
ShellBlock<N, ElementOf>::ShellBlock(const Mesh& mesh, ElementKind kind, int part,
                                     std::vector<int> elements, const ShellSection& section,
                                     const ElementControls& controls,
                                     std::span<const double> thickness)
    : ElementBlock(mesh, kind, part, std::move(elements), kGroupsPerPack<N>),
      matter_(section, controls),
      element_(matter_),
      kept_(kHeader + element_.history_size()) {
  const std::size_t padded = std::size_t(group_count()) * kLanes;
  thickness_.assign(padded, section.thickness);
  if (!thickness.empty()) {
    CW_ASSERT(static_cast<int>(thickness.size()) == element_count());
    std::copy(thickness.begin(), thickness.end(), thickness_.begin());
    std::fill(thickness_.begin() + element_count(), thickness_.end(), thickness.back());
  }
  for (std::vector<double>* values : {&area_, &gyration_, &stiffness_}) values->resize(padded);
  weights_.resize(pack_count());
  for (int slot = 0; slot < group_count() * kLanes; ++slot) {
    Lanes3<double> x[kCorners];
    for (int corner = 0; corner < kCorners; ++corner) {
      const Vec3& p = mesh.position[node(slot / kLanes, corner, slot % kLanes)];
      x[corner] = {p.x(), p.y(), p.z()};
    }
    set_element(slot, x);
  }
}

template <class N, template <class> class ElementOf>
void ShellBlock<N, ElementOf>::set_element(int element, const Lanes3<double> (&x)[kCorners]) {
  const ShellShape<double, kCorners> shape = shell_shape(x);
  const double t = thickness_[element];
  area_[element] = shape.area;
  // About nodes that lie off the middle by e the section has t^2 / 12 + e^2; with 4 e^2 the bound
  // of stretching and spinning at once is 1.27 of that of stretching alone (ShellBounds).
  const double off = matter_.off_middle * t;
  gyration_[element] = std::max((shape.area + t * t) / 12, 4 * off * off);
  stiffness_[element] = corner_stiffness(ElementOf<double>(matter_), shape, t, gyration_[element]);
  Weight& weight = weights_[element / kWidth<N>];
  weight.mass.set(element % kWidth<N>, matter_.density * shape.area * t);
  weight.gyration.set(element % kWidth<N>, gyration_[element]);
}

template <class N, template <class> class ElementOf>
void ShellBlock<N, ElementOf>::initialise(std::span<double> history) const {
  for (int pack = 0; pack < pack_count(); ++pack) {
    N* h = kept_.of(history, pack);
    h[kEnergy] = h[kHourglassEnergy] = constant<N>(0);
    for (int lane = 0; lane < kWidth<N>; ++lane)
      h[kThickness].set(lane, thickness_[pack * kWidth<N> + lane]);
    h[kAlive] = constant<N>(1);
    element_.initialise(h + kHeader);
  }
}

template <class N, template <class> class ElementOf>
auto ShellBlock<N, ElementOf>::load(const StepContext& step, int pack) const
    -> ShellGeometry<N, kCorners> {
  ShellGeometry<N, kCorners> g;
  const int* index = group_nodes(pack * kGroupsPerPack<N>);
  N x[kCorners][3], v[kCorners][3];
  load_corners(step.nodes, index, x, v);
  for (int corner = 0; corner < kCorners; ++corner) {
    g.x[corner] = {x[corner][0], x[corner][1], x[corner][2]};
    g.v[corner] = {v[corner][0], v[corner][1], v[corner][2]};
  }
  if (!has_moments()) return g;
  load_corner_vectors(step.spin, index, x);
  for (int corner = 0; corner < kCorners; ++corner)
    g.spin[corner] = {x[corner][0], x[corner][1], x[corner][2]};
  return g;
}

template <class N, template <class> class ElementOf>
auto ShellBlock<N, ElementOf>::motion(const ShellGeometry<N, kCorners>& g, double dt) const
    -> ShellMotion<N, kCorners> {
  const N half = constant<N>(0.5 * dt);
  ShellMotion<N, kCorners> m;
  Lanes3<N> x[kCorners];
  for (int i = 0; i < kCorners; ++i) x[i] = difference(g.x[i], scaled(g.v[i], half));
  m.middle = shell_shape(x);
  m.end = shell_shape(g.x);
  const N none = constant<N>(0);
  for (int i = 0; i < kCorners; ++i) {
    m.v[i] = m.middle.frame.to_local(g.v[i]);
    m.spin[i] = has_moments() ? m.middle.frame.to_local(g.spin[i]) : Lanes3<N>{none, none, none};
  }
  m.dt = dt;
  return m;
}

template <int kCorners, class N>
void store(const Lanes3<N>& a, const N& factor, const N& stiffness, double* to) {
  store_corner(a.x * factor, a.y * factor, a.z * factor, stiffness, to,
               std::size_t{kCorners} * kLanes * kCornerStride);
}

template <class N, template <class> class ElementOf>
CW_FLATTEN void ShellBlock<N, ElementOf>::forces(const StepContext& step, std::span<double> history,
                                                 std::span<double> corner_forces,
                                                 std::span<double> corner_moments, int first,
                                                 int last, BlockSums& sums) const {
  const bool is_bending = has_moments();
  LaneSums<N> lanes;
  for (int group = first; group < last; group += kGroupsPerPack<N>) {
    const int pack = group / kGroupsPerPack<N>;
    N* h = kept_.of(history, pack);
    ShellGeometry<N, kCorners> g = load(step, pack);
    if (!all_positive(h[kAlive])) rest_where_failed(h[kAlive], g);
    ShellMotion<N, kCorners> m = motion(g, step.dt);
    m.thickness = h[kThickness];
    m.mass = weights_[pack].mass;
    const ShellAnswer<N, kCorners> answer = element_.answer(m, h + kHeader);
    h[kEnergy] += answer.work * h[kAlive];
    h[kHourglassEnergy] += answer.stored;
    h[kAlive] = smaller(h[kAlive], answer.alive);
    if (matter_.section.thinning == ShellThinning::FollowsStrain)
      h[kThickness] *= 1.0 + answer.thinning;
    const N& gyration = weights_[pack].gyration;
    N stiffness = constant<N>(0);
    if (step.wants_stable_step)
      stiffness = h[kAlive] * corner_stiffness(element_, m.end, h[kThickness], gyration);
    for (int i = 0; i < kCorners; ++i) {
      const std::size_t slot = corner_slot(group - first, i, 0);
      store<kCorners>(m.end.frame.to_world(answer.force[i]), h[kAlive], stiffness,
                      corner_forces.data() + slot);
      if (is_bending)
        store<kCorners>(m.end.frame.to_world(answer.moment[i]), h[kAlive], N(stiffness * gyration),
                        corner_moments.data() + slot);
    }

    const N mask = lane_mask<N>(pack);
    const N live = h[kAlive] * mask;
    lanes.internal += h[kEnergy] * mask;
    lanes.hourglass += h[kHourglassEnergy] * mask;
    lanes.hourglass_dissipated += answer.dissipated * live;
    lanes.failed += mask - live;
    const N half_alive = constant<N>(0.5);
    const N area = where_less(half_alive, live, element_.least_area(m.end), constant<N>(1));
    if (!all_positive(area)) find_inverted(area, pack, sums);
    if (step.wants_stable_step)
      lanes.look_for_stiffest(live * stiffness, N(m.mass * (1.0 / kCorners)), pack);
  }
  lanes.book(sums);
}

template <class N, template <class> class ElementOf>
void ShellBlock<N, ElementOf>::find_inverted(const N& area, int pack, BlockSums& sums) const {
  for (int lane = 0; lane < kWidth<N> && sums.inverted_element < 0; ++lane)
    if (!(area[lane] > 0)) {
      sums.inverted_element = pack * kWidth<N> + lane;
      sums.inverted_jacobian = area[lane] / area_[sums.inverted_element];
    }
}

template <class N, template <class> class ElementOf>
ElementSample ShellBlock<N, ElementOf>::sample(const StepContext& step,
                                               std::span<const double> history, int element) const {
  const int pack = element / kWidth<N>, lane = element % kWidth<N>;
  const N* h = kept_.of(history, pack);
  const ShellGeometry<N, kCorners> g = load(step, pack);
  const ShellShape<N, kCorners> shape = shell_shape(g.x);
  const SectionSample section = element_.sample(h + kHeader, lane);
  Mat3 R;
  const Lanes3<N>* axes[] = {&shape.frame.e1, &shape.frame.e2, &shape.frame.e3};
  for (int i = 0; i < 3; ++i) R.col(i) = Vec3(axes[i]->x[lane], axes[i]->y[lane], axes[i]->z[lane]);
  const PlaneTensor<double>& s = section.stress;
  Mat3 local;
  local << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, 0;

  ElementSample out;
  out.centre = centre(step.nodes, element);
  out.volume = element_volume(element);
  out.stress = R * local * R.transpose();
  out.energy = h[kEnergy][lane];
  out.plastic_strain = section.plastic_strain;
  out.is_alive = h[kAlive][lane] > 0.5;
  return out;
}

}  // namespace

std::unique_ptr<ElementBlock> make_shell_block(const Mesh& mesh, ElementKind kind, int part,
                                               std::vector<int> elements,
                                               const ShellSection& section,
                                               const ElementControls& controls,
                                               std::span<const double> thickness) {
  CW_ASSERT(kind == ElementKind::Quad4 || kind == ElementKind::Tri3);
  const auto make_of =
      [&]<class N, template <class> class ElementOf>() -> std::unique_ptr<ElementBlock> {
    return std::make_unique<ShellBlock<N, ElementOf>>(mesh, kind, part, std::move(elements),
                                                      section, controls, thickness);
  };
  const auto make = [&]<template <class> class ElementOf>() {
    return controls.precision == Precision::Single
               ? make_of.template operator()<SingleLanes, ElementOf>()
               : make_of.template operator()<Lanes, ElementOf>();
  };
  if (kind == ElementKind::Tri3) return make.template operator()<TriangleShell>();
  if (section.integration == ShellIntegration::Full) return make.template operator()<FullShell>();
  return make.template operator()<QuadrilateralShell>();
}

}  // namespace crosswalk::fe
