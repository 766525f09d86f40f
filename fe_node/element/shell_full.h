// The fully integrated quadrilateral shell: the section is asked at 2 x 2 points in the plane.
// Theory in shell_full_kernel.h. The element fails once most of its points have: fewer than two
// left could not resist every deformation.
#pragma once

#include "fe_node/element/shell_element.h"
#include "fe_node/element/shell_full_kernel.h"

namespace crosswalk::fe {

template <class N>
class FullShell {
 public:
  static constexpr int kCorners = 4;
  static constexpr int kPoints = 4;

  explicit FullShell(const ShellMatter& matter)
      : matter_(matter), section_size_(section_history(matter.section)) {}

  int history_size() const { return kSections + kPoints * section_size_; }
  void initialise(N* history) const {
    for (int i = 0; i < kSections; ++i) history[i] = constant<N>(0);
    for (int p = 0; p < kPoints; ++p)
      initialise_section(matter_.section, history + kSections + p * section_size_);
  }
  ShellAnswer<N, 4> answer(const ShellMotion<N, 4>& motion, N* history) const;
  N stiffness(const ShellShape<N, 4>& shape, const N& thickness, const N& gyration) const;
  /// Four times the least Jacobian, m2; at most zero in an element folded over.
  N least_area(const ShellShape<N, 4>& shape) const {
    return 4.0 * FullShellShape<N>(shape).least_jacobian();
  }
  SectionSample sample(const N* history, int lane) const;

 private:
  static constexpr double kLeastPoints = 2;
  static constexpr double kDrilling = 1e-4;  ///< of E t^3 / 12
  static constexpr int kSections = 4;        ///< in front of them the moments of drilling, N m

  static double xi_of(int point) { return kCornerXi[point] * kGaussPoint; }
  static double eta_of(int point) { return kCornerEta[point] * kGaussPoint; }
  void add_drilling(const ShellMotion<N, 4>& motion, const N& omega, N* moments,
                    ShellAnswer<N, 4>& answer) const;

  ShellMatter matter_;
  int section_size_;
};

template <class N>
ShellAnswer<N, 4> FullShell<N>::answer(const ShellMotion<N, 4>& motion, N* history) const {
  const FullShellShape<N> middle(motion.middle), end(motion.end);
  const FullShellField<N> rate = full_shell_field(middle, motion.v, motion.spin);
  const TiedShear<N> shear = TiedShear<N>::of(middle, rate);
  const FullShellPoint<N> middle_centre(middle, 0, 0), end_centre(end, 0, 0);
  const N plane_shear = middle_centre.gradient(rate.u).y + middle_centre.gradient(rate.v).x;
  const N shear_factor = constant<N>(matter_.section.shear_factor);

  const Bilinear<N> none = Bilinear<N>::zero();
  FullShellField<N> load{none, none, none, none, none};
  TiedShear<N> shear_load{constant<N>(0), constant<N>(0), constant<N>(0), constant<N>(0)};
  N plane_shear_load = constant<N>(0), points = constant<N>(0);
  ShellAnswer<N, 4> out;
  for (int i = 0; i < kPoints; ++i) {
    const FullShellPoint<N> before(middle, xi_of(i), eta_of(i)), now(end, xi_of(i), eta_of(i));
    const SectionVector<N> e = increment_of(full_shell_rates(before, rate, shear, plane_shear),
                                            motion.dt, matter_.is_bending());
    const SectionAnswer<N> section =
        integrate_section(matter_.section, e, motion.thickness, shear_factor, motion.dt,
                          history + kSections + i * section_size_);
    out.work += section.work * before.jacobian;
    out.thinning += (1.0 / kPoints) * section.thinning;
    points += section.alive;
    add_full_shell_loads(now, section.resultants, load, shear_load);
    plane_shear_load += section.resultants.xy * now.jacobian;
  }
  out.alive = where_less(points, constant<N>(kLeastPoints), constant<N>(0), constant<N>(1));
  plane_shear_load /= end.jacobian;
  end_centre.add_gradient_load({constant<N>(0), plane_shear_load}, load.u);
  end_centre.add_gradient_load({plane_shear_load, constant<N>(0)}, load.v);
  if (matter_.is_bending()) shear_load.add_loads(end, load);

  for (int i = 0; i < 4; ++i) {
    const Slope<N> z = corner_slope(end_centre, end.warp, i);
    Lanes3<N>& m = out.moment[i];
    m.x = -load.th_x.at_corner(i);
    m.y = -load.th_y.at_corner(i);
    m.z = z.x * m.x + z.y * m.y;
    out.force[i] = {-load.u.at_corner(i), -load.v.at_corner(i), -load.w.at_corner(i)};
  }
  if (matter_.is_bending()) add_drilling(motion, material_spin(middle_centre, rate), history, out);
  return out;
}

/// Elastic moments against th_z - Omega; and the forces that do the work of all moments about z on
/// Omega.
template <class N>
void FullShell<N>::add_drilling(const ShellMotion<N, 4>& motion, const N& omega, N* moments,
                                ShellAnswer<N, 4>& answer) const {
  const N t3 = motion.thickness * motion.thickness * motion.thickness;
  const N stiffness = (kDrilling * matter_.mean_youngs / 48) * t3 * motion.end.area;
  N sum = constant<N>(0);
  for (int i = 0; i < 4; ++i) {
    const N turn = (motion.spin[i].z - omega) * motion.dt, before = moments[i];
    moments[i] += stiffness * turn;
    answer.stored += 0.5 * (before + moments[i]) * turn;
    answer.moment[i].z -= moments[i];
    sum += answer.moment[i].z;
  }
  for (int i = 0; i < 4; ++i) {
    answer.force[i].x += 0.5 * sum * motion.end.by[i];
    answer.force[i].y -= 0.5 * sum * motion.end.bx[i];
  }
}

/// Of a parallelogram the one-point bounds hold: the modes of constant strain are the stiffest, and
/// the others, orthogonal to them, have at most two thirds of it. Other shapes, with J the Jacobian
/// and h the xi eta part of x and y: the sum over points grows by at most J_0 / J_min, the metric
/// by
/// (|h|^2 + |h| sqrt(tr g)) / 3 in units of g; a warp of slope s stretches by 1 + s^2. The shear
/// that varies over the element, two thirds, meets its twist.
template <class N>
N FullShell<N>::stiffness(const ShellShape<N, 4>& shape, const N& thickness,
                          const N& gyration) const {
  const FullShellShape<N> s(shape);
  const ShellBounds<N> bounds = shell_bounds(matter_, shape, thickness, gyration);
  N largest, trace;
  gradient_metric(shape, largest, trace);
  const N h2 = 0.25 * (s.x.twist * s.x.twist + s.y.twist * s.y.twist) / (s.jacobian * s.jacobian);
  const N growth = 1.0 + (h2 + square_root(h2 * trace)) * (1.0 / 3) / largest;
  const N warped = 1.0 + (8.0 / 3) * s.warp * s.warp * trace;
  const N least = larger(s.least_jacobian(), 1e-3 * s.jacobian);
  const N bent = larger(bounds.shear, bounds.bending + (2.0 / 3) * bounds.shear);
  return larger(bounds.membrane, bent) * growth * warped * s.jacobian / least;
}

template <class N>
SectionSample FullShell<N>::sample(const N* history, int lane) const {
  SectionSample mean;
  for (int p = 0; p < kPoints; ++p) {
    const SectionSample at =
        sample_section(matter_.section, history + kSections + p * section_size_, lane);
    mean.stress.xx += at.stress.xx / kPoints;
    mean.stress.yy += at.stress.yy / kPoints;
    mean.stress.xy += at.stress.xy / kPoints;
    mean.stress.yz += at.stress.yz / kPoints;
    mean.stress.zx += at.stress.zx / kPoints;
    mean.plastic_strain = std::max(mean.plastic_strain, at.plastic_strain);
  }
  return mean;
}

}  // namespace crosswalk::fe
