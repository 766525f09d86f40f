// The contract of a shell law: plane stress in the element's own plane, as a rate law in the
// co-rotational frame (axis z normal to the shell). SI.
//
//   struct SomeShellLaw {
//     double density, youngs_modulus, poisson_ratio;  // the moduli bound the stable step
//     int history_size() const;                       // numbers per point, the stress not counted
//     template <class N> void initialise(N* history) const;
//     template <class N> PlaneAnswer<N> update(const PlaneStep<N>& step, N* history) const;
//   };
//
// N is Lanes or double. With dt = 0 and zero increments the present stress comes back. A point that
// has failed answers alive = 0 and zero stress for good.
#pragma once

#include <variant>

#include "fe_node/material/lanes.h"

namespace crosswalk::fe {

/// Order xx, yy, xy, yz, zx; engineering shear where it holds strain.
template <class N>
struct PlaneTensor {
  N xx, yy, xy, yz, zx;
};

template <class N>
struct PlaneStep {
  PlaneTensor<N> strain;  ///< increments of this step
  PlaneTensor<N> stress;  ///< at its start, Pa
  double dt = 0;          ///< s
};

template <class N>
struct PlaneAnswer {
  PlaneTensor<N> stress;  ///< Pa
  N thinning;             ///< increment of the normal strain that keeps the normal stress zero
  N alive = constant<N>(1);
  N intact = constant<N>(1);  ///< share of the elastic stiffness in the plane that cracks have left
};

/// a . b as work: sum of products, engineering shear counted once.
template <class N>
N work(const PlaneTensor<N>& stress, const PlaneTensor<N>& strain) {
  return stress.xx * strain.xx + stress.yy * strain.yy + stress.xy * strain.xy +
         stress.yz * strain.yz + stress.zx * strain.zx;
}

/// Isotropic elastic predictor: the stress and the thinning of a purely elastic increment.
template <class N>
PlaneAnswer<N> plane_elastic(double youngs_modulus, double poisson_ratio,
                             const PlaneStep<N>& step) {
  const double plane = youngs_modulus / (1 - poisson_ratio * poisson_ratio);
  const double shear = 0.5 * youngs_modulus / (1 + poisson_ratio);
  const PlaneTensor<N>& e = step.strain;
  PlaneAnswer<N> answer;
  answer.stress = {step.stress.xx + plane * (e.xx + poisson_ratio * e.yy),
                   step.stress.yy + plane * (e.yy + poisson_ratio * e.xx),
                   step.stress.xy + shear * e.xy, step.stress.yz + shear * e.yz,
                   step.stress.zx + shear * e.zx};
  answer.thinning = (-poisson_ratio / (1 - poisson_ratio)) * (e.xx + e.yy);
  return answer;
}

struct ShellElastic {
  double density = 0;
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;

  int history_size() const { return 0; }
  template <class N>
  void initialise(N* /*history*/) const {}
  template <class N>
  PlaneAnswer<N> update(const PlaneStep<N>& step, N* /*history*/) const {
    return plane_elastic(youngs_modulus, poisson_ratio, step);
  }
};

}  // namespace crosswalk::fe
