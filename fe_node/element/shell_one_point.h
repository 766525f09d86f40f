// One point in the plane: the Belytschko-Tsay quadrilateral with hourglass control, and the C0
// triangle. Theory in shell_kernel.h.
//
// Hourglass control of the quadrilateral after [belytschko1984]: stiffness form k_m = r E t A b.b/8
// (membrane), k_b = r E t^3 A b.b/192 (bending), k_w = r kappa G t^3 b.b/12 (warping), or the
// viscous form c_m = q rho t sqrt(A) c/4, c_b = c_m t^2/12, c_w = c_m t^2 b.b/12.
#pragma once

#include <cmath>

#include "fe_node/element/shell_element.h"

namespace crosswalk::fe {

template <class N, int corners>
class OnePointShell {
 public:
  static constexpr int kCorners = corners;
  static constexpr int kPoints = 1;

  explicit OnePointShell(const ShellMatter& matter) : matter_(matter) {}

  int history_size() const { return kSection + section_history(matter_.section); }
  void initialise(N* history) const {
    history[kIntact] = constant<N>(1);
    for (int i = kControl; i < kSection; ++i) history[i] = constant<N>(0);
    initialise_section(matter_.section, history + kSection);
  }
  ShellAnswer<N, corners> answer(const ShellMotion<N, corners>& motion, N* history) const;
  N stiffness(const ShellShape<N, corners>& shape, const N& thickness, const N& gyration) const;
  /// m2; at most zero in an element folded over.
  N least_area(const ShellShape<N, corners>& shape) const { return shape.area; }
  SectionSample sample(const N* history, int lane) const {
    return sample_section(matter_.section, history + kSection, lane);
  }

 private:
  enum Slot { kIntact, kControl, kSection = kControl + 5 };
  /// Control that a pane cracked through keeps.
  static constexpr double kLeastIntact = 1e-4;

  /// Transverse shear of the triangle is softened by t^2 / (t^2 + 0.1 h^2), h^2 = 2 A
  /// [lyly1993]: without it thin triangles lock.
  static N shear_softening(const N& thickness, const N& area) {
    constexpr double kShearSoftening = 0.1;
    const N t2 = thickness * thickness;
    return t2 / (t2 + 2 * kShearSoftening * area);
  }
  void add_hourglass(const ShellMotion<N, corners>& motion, const N& intact, N* history,
                     ShellAnswer<N, corners>& answer) const;

  ShellMatter matter_;
};

template <class N, int corners>
ShellAnswer<N, corners> OnePointShell<N, corners>::answer(const ShellMotion<N, corners>& motion,
                                                          N* history) const {
  const ShellShape<N, corners>& middle = motion.middle;
  const SectionVector<N> e =
      increment_of(shell_rates(middle, motion.v, motion.spin), motion.dt, matter_.is_bending());
  N shear_factor = constant<N>(matter_.section.shear_factor);
  if (kCorners == 3) shear_factor *= shear_softening(motion.thickness, middle.area);
  const SectionAnswer<N> section = integrate_section(matter_.section, e, motion.thickness,
                                                     shear_factor, motion.dt, history + kSection);
  ShellAnswer<N, corners> out;
  out.work = section.work * middle.area;
  out.thinning = section.thinning;
  out.alive = section.alive;
  for (int i = 0; i < kCorners; ++i)
    shell_loads(motion.end, section.resultants, i, out.force[i], out.moment[i]);
  if constexpr (kCorners == 4)
    if (matter_.controls.hourglass != HourglassForm::None)
      add_hourglass(
          motion, larger(N(section.youngs * (1 / matter_.mean_youngs)), constant<N>(kLeastIntact)),
          history, out);
  return out;
}

template <class N, int corners>
N OnePointShell<N, corners>::stiffness(const ShellShape<N, corners>& shape, const N& thickness,
                                       const N& gyration) const {
  ShellBounds<N> bounds = shell_bounds(matter_, shape, thickness, gyration);
  if (kCorners == 3)  // shear of the triangle meets its curvature; of the quadrilateral it cannot
    bounds.shear = bounds.bending + bounds.shear * shear_softening(thickness, shape.area);
  return larger(larger(bounds.membrane, bounds.bending), bounds.shear);
}

/// Control is as stiff as what is left of the section: a cracked pane folds along lines that whole
/// glass would forbid. What a crack sets free of the control's own energy is dissipated.
template <class N, int corners>
void OnePointShell<N, corners>::add_hourglass(const ShellMotion<N, corners>& motion,
                                              const N& intact, N* history,
                                              ShellAnswer<N, corners>& answer) const {
  static_assert(kCorners == 4);
  const ShellShape<N, 4>&middle = motion.middle, &end = motion.end;
  const bool is_bending = matter_.is_bending();
  const double r = matter_.controls.hourglass_coefficient, dt = motion.dt;
  const double poisson = matter_.poisson;
  const N& t = motion.thickness;
  N largest, trace, mode[5], gamma[4];
  gradient_metric(end, largest, trace);
  const N hx = middle.x[0] - middle.x[1] + middle.x[2] - middle.x[3];
  const N hy = middle.y[0] - middle.y[1] + middle.y[2] - middle.y[3];
  for (N& m : mode) m = constant<N>(0);
  // the part of the in-plane modes that a rotation of the warped element makes is taken out
  const N warp = 4.0 * middle.warp, end_warp = 4.0 * end.warp;
  for (int i = 0; i < 4; ++i) {
    const N g = (i % 2 == 0 ? 1.0 : -1.0) - hx * middle.bx[i] - hy * middle.by[i];
    const Lanes3<N>&v = motion.v[i], &spin = motion.spin[i];
    mode[0] += g * v.x + warp * middle.bx[i] * v.z;
    mode[1] += g * v.y + warp * middle.by[i] * v.z;
    if (!is_bending) continue;
    mode[2] += g * v.z;
    mode[3] += g * spin.x;
    mode[4] += g * spin.y;
  }
  const N ex = end.x[0] - end.x[1] + end.x[2] - end.x[3];
  const N ey = end.y[0] - end.y[1] + end.y[2] - end.y[3];
  for (int i = 0; i < 4; ++i)
    gamma[i] = (i % 2 == 0 ? 1.0 : -1.0) - ex * end.bx[i] - ey * end.by[i];

  N factor[3];  // membrane, warping, bending
  const bool is_stiff = matter_.controls.hourglass == HourglassForm::Stiffness;
  if (is_stiff) {
    const N stiffness = matter_.mean_youngs * intact;
    factor[0] = (r / 8) * stiffness * t * end.area * trace;
    factor[2] = factor[0] * t * t * (1.0 / 24);
    factor[1] = (r * matter_.section.shear_factor * 0.5 / (1 + poisson) / 12) * stiffness * t * t *
                t * trace;
  } else {
    const double c = std::sqrt(matter_.youngs / (matter_.density * (1 - poisson * poisson)));
    factor[0] = (0.25 * r * c) * motion.mass / square_root(end.area);
    factor[2] = factor[0] * t * t * (1.0 / 12);
    factor[1] = factor[2] * trace;
  }
  const N kept = intact / history[kIntact];
  history[kIntact] = intact;
  const int modes = is_bending ? 5 : 2;
  N load[5];
  for (int k = 0; k < modes; ++k) {
    const N& f = factor[k < 2 ? 0 : k == 2 ? 1 : 2];
    if (is_stiff) {
      N& stored = history[kControl + k];
      const N before = stored;
      stored = kept * before + f * mode[k] * dt;
      const N released = 0.5 * kept * (1.0 - kept) * before * before / (f + kTiny<N>);
      answer.dissipated += released;
      answer.stored += 0.5 * (before + stored) * mode[k] * dt - released;
      load[k] = stored;
    } else {
      load[k] = f * mode[k];
      answer.dissipated += load[k] * mode[k] * dt;
    }
  }
  for (int i = 0; i < 4; ++i) {
    Lanes3<N>&force = answer.force[i], &moment = answer.moment[i];
    force.x -= gamma[i] * load[0];
    force.y -= gamma[i] * load[1];
    force.z -= end_warp * (end.bx[i] * load[0] + end.by[i] * load[1]);
    if (!is_bending) continue;
    force.z -= gamma[i] * load[2];
    moment.x -= gamma[i] * load[3];
    moment.y -= gamma[i] * load[4];
  }
}

template <class N>
using QuadrilateralShell = OnePointShell<N, 4>;
template <class N>
using TriangleShell = OnePointShell<N, 3>;

}  // namespace crosswalk::fe
