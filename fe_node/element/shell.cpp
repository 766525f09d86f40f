#include "fe_node/element/shell.h"

#include <cmath>
#include <type_traits>

#include "common/error.h"
#include "fe_node/element/flatten.h"
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

/// Per lane group in front of the element's history.
enum Header { kEnergy, kHourglassEnergy, kThickness, kAlive, kHeader };

template <int kCorners>
struct ShellGeometry {
  Lanes3 x[kCorners], v[kCorners], spin[kCorners];
};

/// An element that has failed counts as a square at rest: its nodes go on without it and may fold
/// it to nothing.
template <int kCorners>
void rest_where_failed(const Lanes& alive, ShellGeometry<kCorners>& g) {
  constexpr double kSquare[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto rest = [&alive](Lanes3& a, const double(&b)[3]) {
    Lanes* of[] = {&a.x, &a.y, &a.z};
    for (int k = 0; k < 3; ++k)
      *of[k] = where_less(Lanes::Zero(), alive, *of[k], Lanes::Constant(b[k]));
  };
  for (int corner = 0; corner < kCorners; ++corner) {
    rest(g.x[corner], kSquare[corner]);
    rest(g.v[corner], kSquare[0]);
    rest(g.spin[corner], kSquare[0]);
  }
}

template <class Element>
class ShellBlock final : public ElementBlock {
 public:
  static constexpr int kCorners = Element::kCorners;

  ShellBlock(const Mesh& mesh, ElementKind kind, int part, std::vector<int> elements,
             const ShellSection& section, const ElementControls& controls,
             std::span<const double> thickness);

  int points() const override { return Element::kPoints; }
  bool has_moments() const override { return matter_.is_bending(); }
  int history_per_group() const override { return (kHeader + element_.history_size()) * kLanes; }
  void initialise(std::span<double> history) const override;
  double corner_mass(int element) const override { return mass_[element] / kCorners; }
  double corner_inertia(int element) const override {
    return corner_mass(element) * gyration_[element];
  }
  double added_mass(int element) const override { return added_[element]; }
  double element_volume(int element) const override { return area_[element] * thickness_[element]; }
  double density() const override { return matter_.density; }
  void forces(const StepContext& step, std::span<double> history, std::span<double> corner_forces,
              std::span<double> corner_moments, int first, int last,
              BlockSums& sums) const override;
  double initial_stable_step(int element) const override { return step_[element]; }
  bool is_alive(std::span<const double> history, int element) const override {
    return history[static_cast<std::size_t>(element / kLanes) * history_per_group() +
                   kAlive * kLanes + element % kLanes] > 0.5;
  }
  ElementSample sample(const StepContext& step, std::span<const double> history,
                       int element) const override;

 private:
  ShellGeometry<kCorners> load(const StepContext& step, int group) const;
  ShellMotion<kCorners> motion(const ShellGeometry<kCorners>& g, double dt) const;
  using PerElement = std::vector<double, Eigen::aligned_allocator<double>>;  ///< padded like groups
  static const Lanes& lanes_of(const PerElement& values, int group) {
    return *reinterpret_cast<const Lanes*>(values.data() + std::size_t(group) * kLanes);
  }
  /// dt^2 = 4 / omega^2
  Lanes stable_step_squared(const ShellShape<kCorners>& shape, const Lanes& thickness,
                            const Lanes& mass, const Lanes& gyration) const {
    return 4.0 * mass /
           (kCorners * shape.area * thickness * element_.stiffness(shape, thickness, gyration));
  }
  void find_inverted(const Lanes& area, int group, BlockSums& sums) const;

  ShellMatter matter_;
  Element element_;
  PerElement thickness_, area_, mass_, gyration_, step_;  ///< mass with what scaling added
  PerElement added_;                                      ///< kg
};

template <class Element>
ShellBlock<Element>::ShellBlock(const Mesh& mesh, ElementKind kind, int part,
                                std::vector<int> elements, const ShellSection& section,
                                const ElementControls& controls, std::span<const double> thickness)
    : ElementBlock(mesh, kind, part, std::move(elements)),
      matter_(section, controls),
      element_(matter_) {
  const std::size_t padded = std::size_t(group_count()) * kLanes;
  thickness_.assign(padded, section.thickness);
  if (!thickness.empty()) {
    CW_ASSERT(static_cast<int>(thickness.size()) == element_count());
    std::copy(thickness.begin(), thickness.end(), thickness_.begin());
    std::fill(thickness_.begin() + element_count(), thickness_.end(), thickness.back());
  }
  for (PerElement* values : {&area_, &mass_, &gyration_, &step_, &added_}) values->resize(padded);
  for (int group = 0; group < group_count(); ++group) {
    Lanes3 x[kCorners];
    for (int corner = 0; corner < kCorners; ++corner)
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vec3& p = mesh.position[node(group, corner, lane)];
        x[corner].x[lane] = p.x();
        x[corner].y[lane] = p.y();
        x[corner].z[lane] = p.z();
      }
    const ShellShape<kCorners> shape = shell_shape(x);
    const Lanes t = lanes_of(thickness_, group);
    const Lanes mass = matter_.density * shape.area * t,
                gyration = (shape.area + t * t) * (1.0 / 12);
    const Lanes step2 = stable_step_squared(shape, t, mass, gyration);
    for (int lane = 0; lane < kLanes; ++lane) {
      const int element = group * kLanes + lane;
      const double step = std::sqrt(step2[lane]);
      const double scaling = std::max(1.0, controls.minimum_step / step);
      area_[element] = shape.area[lane];
      added_[element] = mass[lane] * (scaling * scaling - 1);
      mass_[element] = mass[lane] + added_[element];
      gyration_[element] = gyration[lane];
      step_[element] = step * scaling;
    }
  }
}

template <class Element>
void ShellBlock<Element>::initialise(std::span<double> history) const {
  for (int group = 0; group < group_count(); ++group) {
    Lanes* h = reinterpret_cast<Lanes*>(history.data() +
                                        static_cast<std::size_t>(group) * history_per_group());
    h[kEnergy] = h[kHourglassEnergy] = Lanes::Zero();
    h[kThickness] = lanes_of(thickness_, group);
    h[kAlive] = Lanes::Ones();
    element_.initialise(h + kHeader);
  }
}

template <class Element>
auto ShellBlock<Element>::load(const StepContext& step, int group) const
    -> ShellGeometry<kCorners> {
  ShellGeometry<kCorners> g;
  const int* index = group_nodes(group);
  const bool is_bending = has_moments();
  for (int corner = 0; corner < kCorners; ++corner, index += kLanes) {
    Lanes x[3], v[3];
    load_positions(step.nodes, index, x);
    load_velocities(step.nodes, index, v);
    g.x[corner] = {x[0], x[1], x[2]};
    g.v[corner] = {v[0], v[1], v[2]};
    if (!is_bending) continue;
    load_vectors(step.spin, index, g.spin[corner].x, g.spin[corner].y, g.spin[corner].z);
  }
  return g;
}

template <class Element>
auto ShellBlock<Element>::motion(const ShellGeometry<kCorners>& g, double dt) const
    -> ShellMotion<kCorners> {
  const Lanes half = Lanes::Constant(0.5 * dt);
  ShellMotion<kCorners> m;
  Lanes3 x[kCorners];
  for (int i = 0; i < kCorners; ++i) x[i] = difference(g.x[i], scaled(g.v[i], half));
  m.middle = shell_shape(x);
  m.end = shell_shape(g.x);
  const Lanes none = Lanes::Zero();
  for (int i = 0; i < kCorners; ++i) {
    m.v[i] = m.middle.frame.to_local(g.v[i]);
    m.spin[i] = has_moments() ? m.middle.frame.to_local(g.spin[i]) : Lanes3{none, none, none};
  }
  m.dt = dt;
  return m;
}

inline void store(const Lanes3& a, const Lanes& factor, double* to) {
  store_corner(a.x * factor, a.y * factor, a.z * factor, to);
}

template <class Element>
CW_FLATTEN void ShellBlock<Element>::forces(const StepContext& step, std::span<double> history,
                                            std::span<double> corner_forces,
                                            std::span<double> corner_moments, int first, int last,
                                            BlockSums& sums) const {
  const bool is_bending = has_moments();
  LaneSums lanes;
  for (int group = first; group < last; ++group) {
    Lanes* h = reinterpret_cast<Lanes*>(history.data() +
                                        static_cast<std::size_t>(group) * history_per_group());
    ShellGeometry<kCorners> g = load(step, group);
    if (!all_positive(h[kAlive])) rest_where_failed(h[kAlive], g);
    ShellMotion<kCorners> m = motion(g, step.dt);
    m.thickness = h[kThickness];
    m.mass = lanes_of(mass_, group);
    const ShellAnswer<kCorners> answer = element_.answer(m, h + kHeader);
    h[kEnergy] += answer.work * h[kAlive];
    h[kHourglassEnergy] += answer.stored;
    h[kAlive] = smaller(h[kAlive], answer.alive);
    if (matter_.section.thinning == ShellThinning::FollowsStrain)
      h[kThickness] *= 1.0 + answer.thinning;
    for (int i = 0; i < kCorners; ++i) {
      const std::size_t slot = corner_slot(group - first, i, 0);
      store(m.end.frame.to_world(answer.force[i]), h[kAlive], corner_forces.data() + slot);
      if (is_bending)
        store(m.end.frame.to_world(answer.moment[i]), h[kAlive], corner_moments.data() + slot);
    }

    const Lanes mask = lane_mask(group);
    const Lanes live = h[kAlive] * mask;
    lanes.internal += h[kEnergy] * mask;
    lanes.hourglass += h[kHourglassEnergy] * mask;
    lanes.hourglass_dissipated += answer.dissipated * live;
    lanes.failed += mask - live;
    const Lanes half_alive = Lanes::Constant(0.5);
    const Lanes area = where_less(half_alive, live, element_.least_area(m.end), Lanes::Ones());
    if (!all_positive(area)) find_inverted(area, group, sums);
    if (step.wants_stable_step)
      lanes.limit_step(
          where_less(live, half_alive, Lanes::Constant(1e300),
                     stable_step_squared(m.end, h[kThickness], m.mass, lanes_of(gyration_, group))),
          group);
  }
  lanes.book(sums);
}

template <class Element>
void ShellBlock<Element>::find_inverted(const Lanes& area, int group, BlockSums& sums) const {
  for (int lane = 0; lane < kLanes && sums.inverted_element < 0; ++lane)
    if (!(area[lane] > 0)) {
      sums.inverted_element = group * kLanes + lane;
      sums.inverted_jacobian = area[lane] / area_[sums.inverted_element];
    }
}

template <class Element>
ElementSample ShellBlock<Element>::sample(const StepContext& step, std::span<const double> history,
                                          int element) const {
  const int group = element / kLanes, lane = element % kLanes;
  const Lanes* h = reinterpret_cast<const Lanes*>(history.data() + static_cast<std::size_t>(group) *
                                                                       history_per_group());
  const ShellGeometry<kCorners> g = load(step, group);
  const ShellShape<kCorners> shape = shell_shape(g.x);
  const SectionSample section = element_.sample(h + kHeader, lane);
  Mat3 R;
  const Lanes3* axes[] = {&shape.frame.e1, &shape.frame.e2, &shape.frame.e3};
  for (int i = 0; i < 3; ++i) R.col(i) = Vec3(axes[i]->x[lane], axes[i]->y[lane], axes[i]->z[lane]);
  const PlaneTensor<double>& s = section.stress;
  Mat3 local;
  local << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, 0;

  ElementSample out;
  for (int i = 0; i < kCorners; ++i)
    out.centre += Vec3(g.x[i].x[lane], g.x[i].y[lane], g.x[i].z[lane]) / kCorners;
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
  const auto make = [&]<class Element>(std::type_identity<Element>) {
    return std::make_unique<ShellBlock<Element>>(mesh, kind, part, std::move(elements), section,
                                                 controls, thickness);
  };
  if (kind == ElementKind::Tri3) return make(std::type_identity<OnePointShell<3>>{});
  if (section.integration == ShellIntegration::Full) return make(std::type_identity<FullShell>{});
  return make(std::type_identity<OnePointShell<4>>{});
}

}  // namespace crosswalk::fe
