#include "fe_node/element/shell.h"

#include <cmath>

#include "common/error.h"
#include "fe_node/element/flatten.h"
#include "fe_node/element/section_integral.h"

namespace crosswalk::fe {
namespace {

/// Per lane group in front of the points' history.
enum Header {
  kEnergy,
  kHourglassEnergy,
  kThickness,
  kAlive,
  kIntact,
  kControl,
  kHeader = kControl + 5
};

/// Transverse shear of the triangle is softened by t^2 / (t^2 + 0.1 h^2), h^2 = 2 A
/// [lyly1993]: without it thin triangles lock.
constexpr double kShearSoftening = 0.1;
inline Lanes shear_softening(const Lanes& thickness, const Lanes& area) {
  const Lanes t2 = thickness * thickness;
  return t2 / (t2 + 2 * kShearSoftening * area);
}

/// Control that a pane cracked through keeps.
constexpr double kLeastIntact = 1e-4;

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

template <int kCorners>
class ShellBlock final : public ElementBlock {
 public:
  ShellBlock(const Mesh& mesh, ElementKind kind, int part, std::vector<int> elements,
             const ShellSection& section, const ElementControls& controls,
             std::span<const double> thickness);

  bool has_moments() const override { return section_.theory == ShellTheory::Bending; }
  int history_per_group() const override { return (kHeader + section_history(section_)) * kLanes; }
  void initialise(std::span<double> history) const override;
  double corner_mass(int element) const override { return mass_[element] / kCorners; }
  double corner_inertia(int element) const override {
    return corner_mass(element) * gyration_[element];
  }
  double added_mass(int element) const override { return added_[element]; }
  double element_volume(int element) const override { return area_[element] * thickness_[element]; }
  double density() const override { return density_; }
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
  using PerElement = std::vector<double, Eigen::aligned_allocator<double>>;  ///< padded like groups
  static const Lanes& lanes_of(const PerElement& values, int group) {
    return *reinterpret_cast<const Lanes*>(values.data() + std::size_t(group) * kLanes);
  }
  Lanes stable_step_squared(const ShellShape<kCorners>& shape, const Lanes& thickness,
                            const Lanes& mass, const Lanes& gyration) const;
  void add_hourglass(const ShellShape<kCorners>& middle, const ShellShape<kCorners>& end,
                     const Lanes3 (&v)[kCorners], const Lanes3 (&spin)[kCorners], const Lanes& mass,
                     const Lanes& intact, double dt, Lanes* history, Lanes3 (&force)[kCorners],
                     Lanes3 (&moment)[kCorners], Lanes& dissipated) const;

  void find_inverted(const Lanes& area, int group, BlockSums& sums) const;

  ShellSection section_;
  ElementControls controls_;
  double density_ = 0;
  double youngs_ = 0, poisson_ = 0;                       ///< of the stiffest layer
  double mean_youngs_ = 0;                                ///< over the thickness
  PerElement thickness_, area_, mass_, gyration_, step_;  ///< mass with what scaling added
  PerElement added_;                                      ///< kg
};

template <int kCorners>
ShellBlock<kCorners>::ShellBlock(const Mesh& mesh, ElementKind kind, int part,
                                 std::vector<int> elements, const ShellSection& section,
                                 const ElementControls& controls, std::span<const double> thickness)
    : ElementBlock(mesh, kind, part, std::move(elements)),
      section_(section),
      controls_(controls),
      density_(section.density()),
      mean_youngs_(section.youngs_modulus()) {
  for (const ShellLayer& layer : section_.layers)
    std::visit(
        [this](const auto& law) {
          if (law.youngs_modulus / (1 - law.poisson_ratio) > youngs_ / (1 - poisson_)) {
            youngs_ = law.youngs_modulus;
            poisson_ = law.poisson_ratio;
          }
        },
        layer.law);
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
    const Lanes mass = density_ * shape.area * t, gyration = (shape.area + t * t) * (1.0 / 12);
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

template <int kCorners>
void ShellBlock<kCorners>::initialise(std::span<double> history) const {
  for (int group = 0; group < group_count(); ++group) {
    Lanes* h = reinterpret_cast<Lanes*>(history.data() +
                                        static_cast<std::size_t>(group) * history_per_group());
    for (int i = 0; i < kHeader; ++i) h[i] = Lanes::Zero();
    h[kThickness] = lanes_of(thickness_, group);
    h[kAlive] = h[kIntact] = Lanes::Ones();
    initialise_section(section_, h + kHeader);
  }
}

template <int kCorners>
ShellGeometry<kCorners> ShellBlock<kCorners>::load(const StepContext& step, int group) const {
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

/// The bound omega^2 <= n A t / m (lambda' tr g + 2 mu g_max) for the membrane, n corners, with
/// lambda' = E nu / (1 - nu^2); the same times t^2 / (12 gyration) for bending; and n A t kappa G /
/// m times the larger eigenvalue of the shear rows for shear. dt^2 = 4 / omega^2.
template <int kCorners>
Lanes ShellBlock<kCorners>::stable_step_squared(const ShellShape<kCorners>& shape,
                                                const Lanes& thickness, const Lanes& mass,
                                                const Lanes& gyration) const {
  Lanes largest, trace;
  gradient_metric(shape, largest, trace);
  const double two_mu = youngs_ / (1 + poisson_);
  const double lambda = youngs_ * poisson_ / (1 - poisson_ * poisson_);
  const Lanes membrane = lambda * trace + two_mu * largest;
  Lanes stiffness = membrane;
  if (has_moments()) {
    const Lanes bending = membrane * thickness * thickness / (12.0 * gyration);
    Lanes shear = (0.5 * two_mu * section_.shear_factor) * shear_metric(shape, gyration);
    if (kCorners == 3)  // shear of the triangle meets its curvature; of the quadrilateral it cannot
      shear = bending + shear * shear_softening(thickness, shape.area);
    stiffness = larger(larger(membrane, bending), shear);
  }
  return 4.0 * mass / (kCorners * shape.area * thickness * stiffness);
}

/// Control is as stiff as what is left of the section: a cracked pane folds along lines that whole
/// glass would forbid. What a crack sets free of the control's own energy is dissipated.
template <int kCorners>
void ShellBlock<kCorners>::add_hourglass(const ShellShape<kCorners>& middle,
                                         const ShellShape<kCorners>& end,
                                         const Lanes3 (&v)[kCorners],
                                         const Lanes3 (&spin)[kCorners], const Lanes& mass,
                                         const Lanes& intact, double dt, Lanes* history,
                                         Lanes3 (&force)[kCorners], Lanes3 (&moment)[kCorners],
                                         Lanes& dissipated) const {
  static_assert(kCorners == 4);
  const bool is_bending = has_moments();
  const double r = controls_.hourglass_coefficient;
  const Lanes& t = history[kThickness];
  Lanes largest, trace, mode[5], gamma[4];
  gradient_metric(end, largest, trace);
  const Lanes hx = middle.x[0] - middle.x[1] + middle.x[2] - middle.x[3];
  const Lanes hy = middle.y[0] - middle.y[1] + middle.y[2] - middle.y[3];
  for (Lanes& m : mode) m = Lanes::Zero();
  // the part of the in-plane modes that a rotation of the warped element makes is taken out
  const Lanes warp = 4.0 * middle.warp, end_warp = 4.0 * end.warp;
  for (int i = 0; i < 4; ++i) {
    const Lanes g = (i % 2 == 0 ? 1.0 : -1.0) - hx * middle.bx[i] - hy * middle.by[i];
    mode[0] += g * v[i].x + warp * middle.bx[i] * v[i].z;
    mode[1] += g * v[i].y + warp * middle.by[i] * v[i].z;
    if (!is_bending) continue;
    mode[2] += g * v[i].z;
    mode[3] += g * spin[i].x;
    mode[4] += g * spin[i].y;
  }
  const Lanes ex = end.x[0] - end.x[1] + end.x[2] - end.x[3];
  const Lanes ey = end.y[0] - end.y[1] + end.y[2] - end.y[3];
  for (int i = 0; i < 4; ++i)
    gamma[i] = (i % 2 == 0 ? 1.0 : -1.0) - ex * end.bx[i] - ey * end.by[i];

  Lanes factor[3];  // membrane, warping, bending
  const bool is_stiff = controls_.hourglass == HourglassForm::Stiffness;
  if (is_stiff) {
    const Lanes stiffness = mean_youngs_ * intact;
    factor[0] = (r / 8) * stiffness * t * end.area * trace;
    factor[2] = factor[0] * t * t * (1.0 / 24);
    factor[1] =
        (r * section_.shear_factor * 0.5 / (1 + poisson_) / 12) * stiffness * t * t * t * trace;
  } else {
    const double c = std::sqrt(youngs_ / (density_ * (1 - poisson_ * poisson_)));
    factor[0] = (0.25 * r * c) * mass / square_root(end.area);
    factor[2] = factor[0] * t * t * (1.0 / 12);
    factor[1] = factor[2] * trace;
  }
  const Lanes kept = intact / history[kIntact];
  history[kIntact] = intact;
  const int modes = is_bending ? 5 : 2;
  Lanes load[5];
  for (int k = 0; k < modes; ++k) {
    const Lanes& f = factor[k < 2 ? 0 : k == 2 ? 1 : 2];
    if (is_stiff) {
      Lanes& stored = history[kControl + k];
      const Lanes before = stored;
      stored = kept * before + f * mode[k] * dt;
      const Lanes released = 0.5 * kept * (1.0 - kept) * before * before / (f + 1e-300);
      history[kHourglassEnergy] -= released;
      dissipated += released;
      history[kHourglassEnergy] += 0.5 * (before + stored) * mode[k] * dt;
      load[k] = stored;
    } else {
      load[k] = f * mode[k];
      dissipated += load[k] * mode[k] * dt;
    }
  }
  for (int i = 0; i < 4; ++i) {
    force[i].x -= gamma[i] * load[0];
    force[i].y -= gamma[i] * load[1];
    force[i].z -= end_warp * (end.bx[i] * load[0] + end.by[i] * load[1]);
    if (!is_bending) continue;
    force[i].z -= gamma[i] * load[2];
    moment[i].x -= gamma[i] * load[3];
    moment[i].y -= gamma[i] * load[4];
  }
}

inline void store(const Lanes3& a, const Lanes& factor, double* to) {
  store_corner(a.x * factor, a.y * factor, a.z * factor, to);
}

template <int kCorners>
CW_FLATTEN void ShellBlock<kCorners>::forces(const StepContext& step, std::span<double> history,
                                             std::span<double> corner_forces,
                                             std::span<double> corner_moments, int first, int last,
                                             BlockSums& sums) const {
  const bool is_bending = has_moments();
  const double half = 0.5 * step.dt;
  LaneSums lanes;
  for (int group = first; group < last; ++group) {
    Lanes* h = reinterpret_cast<Lanes*>(history.data() +
                                        static_cast<std::size_t>(group) * history_per_group());
    ShellGeometry<kCorners> g = load(step, group);
    if (!all_positive(h[kAlive])) rest_where_failed(h[kAlive], g);
    Lanes3 x[kCorners], v[kCorners], spin[kCorners];
    for (int i = 0; i < kCorners; ++i)
      x[i] = difference(g.x[i], scaled(g.v[i], Lanes::Constant(half)));
    const ShellShape<kCorners> middle = shell_shape(x);
    for (int i = 0; i < kCorners; ++i) {
      v[i] = middle.frame.to_local(g.v[i]);
      spin[i] = is_bending ? middle.frame.to_local(g.spin[i])
                           : Lanes3{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    }
    SectionVector e = shell_rates(middle, v, spin);
    for (Lanes* rate : {&e.xx, &e.yy, &e.xy, &e.kxx, &e.kyy, &e.kxy, &e.yz, &e.zx})
      *rate *= step.dt;
    Lanes shear_factor = Lanes::Constant(section_.shear_factor);
    if (kCorners == 3) shear_factor *= shear_softening(h[kThickness], middle.area);
    if (!is_bending) e.yz = e.zx = Lanes::Zero();
    SectionAnswer answer =
        integrate_section(section_, e, h[kThickness], shear_factor, step.dt, h + kHeader);
    h[kEnergy] += answer.work * middle.area * h[kAlive];
    h[kAlive] = smaller(h[kAlive], answer.alive);
    if (section_.thinning == ShellThinning::FollowsStrain) h[kThickness] *= 1.0 + answer.thinning;

    const ShellShape<kCorners> end = shell_shape(g.x);
    const Lanes mass = lanes_of(mass_, group);
    Lanes3 force[kCorners], moment[kCorners];
    for (int i = 0; i < kCorners; ++i) shell_loads(end, answer.resultants, i, force[i], moment[i]);
    Lanes dissipated = Lanes::Zero();
    if constexpr (kCorners == 4) {
      if (controls_.hourglass != HourglassForm::None)
        add_hourglass(middle, end, v, spin, mass,
                      larger(answer.intact, Lanes::Constant(kLeastIntact)), step.dt, h, force,
                      moment, dissipated);
    }
    for (int i = 0; i < kCorners; ++i) {
      const std::size_t slot = corner_slot(group - first, i, 0);
      store(end.frame.to_world(force[i]), h[kAlive], corner_forces.data() + slot);
      if (is_bending) store(end.frame.to_world(moment[i]), h[kAlive], corner_moments.data() + slot);
    }

    const Lanes mask = lane_mask(group);
    const Lanes live = h[kAlive] * mask;
    lanes.internal += h[kEnergy] * mask;
    lanes.hourglass += h[kHourglassEnergy] * mask;
    lanes.hourglass_dissipated += dissipated * live;
    lanes.failed += mask - live;
    const Lanes half_alive = Lanes::Constant(0.5);
    const Lanes area = where_less(half_alive, live, end.area, Lanes::Ones());
    if (!all_positive(area)) find_inverted(area, group, sums);
    if (step.wants_stable_step)
      lanes.limit_step(
          where_less(live, half_alive, Lanes::Constant(1e300),
                     stable_step_squared(end, h[kThickness], mass, lanes_of(gyration_, group))),
          group);
  }
  lanes.book(sums);
}

template <int kCorners>
void ShellBlock<kCorners>::find_inverted(const Lanes& area, int group, BlockSums& sums) const {
  for (int lane = 0; lane < kLanes && sums.inverted_element < 0; ++lane)
    if (!(area[lane] > 0)) {
      sums.inverted_element = group * kLanes + lane;
      sums.inverted_jacobian = area[lane] / area_[sums.inverted_element];
    }
}

template <int kCorners>
ElementSample ShellBlock<kCorners>::sample(const StepContext& step, std::span<const double> history,
                                           int element) const {
  const int group = element / kLanes, lane = element % kLanes;
  const Lanes* h = reinterpret_cast<const Lanes*>(history.data() + static_cast<std::size_t>(group) *
                                                                       history_per_group());
  const ShellGeometry<kCorners> g = load(step, group);
  const ShellShape<kCorners> shape = shell_shape(g.x);
  const SectionSample section = sample_section(section_, h + kHeader, lane);
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
  if (kind == ElementKind::Quad4)
    return std::make_unique<ShellBlock<4>>(mesh, kind, part, std::move(elements), section, controls,
                                           thickness);
  return std::make_unique<ShellBlock<3>>(mesh, kind, part, std::move(elements), section, controls,
                                         thickness);
}

}  // namespace crosswalk::fe
