// Laws of line elements: force over elongation and its rate. Forces are positive in tension.
#pragma once

#include <variant>

#include "common/curve.h"

namespace crosswalk::fe {

struct LineStep {
  double rest_length = 0;  ///< m
  double elongation = 0;   ///< m, length minus rest length
  double rate = 0;         ///< m/s
  double time = 0;         ///< s
};

struct LineAnswer {
  double force = 0;      ///< N
  double stiffness = 0;  ///< N/m, bound for the stable step
  double damping = 0;    ///< N s/m, likewise
};

/// F = EA e / l0 + c de/dt; a cable carries no compression.
struct ElasticLine {
  double axial_stiffness = 0;  ///< EA, N
  double damping = 0;          ///< N s/m
  double preload = 0;          ///< N, at zero elongation
  bool is_tension_only = false;
  LineAnswer answer(const LineStep& step) const;
};

/// F = scale f(e) (1 + r(de/dt)) + d(de/dt), with the curves of *MAT_SPRING_NONLINEAR_ELASTIC and
/// *MAT_DAMPER_NONLINEAR_VISCOUS; empty curves give nothing. With `is_strain_based` the curve is a
/// force over engineering strain.
struct CurveLine {
  Curve force = {};          ///< N over m (or strain)
  Curve rate_factor = {};    ///< multiplies the force; over m/s (or strain rate 1/s)
  Curve damping_force = {};  ///< N over m/s
  double scale = 1;
  double linear_damping = 0;  ///< N s/m
  bool is_tension_only = false;
  bool is_strain_based = false;
  LineAnswer answer(const LineStep& step) const;
};

/// Muscle strand after Hill [zajac1989]: F = A sigma_max (a(t) f_l f_v + f_p) + c de/dt with
///   f_l = exp(-((s-1)/0.25)^2), f_p = (exp(k (s-1)/s_p) - 1) / (e^k - 1) for s > 1,
///   f_v = (1+v)/(1-4v) for -1 < v < 0, (1+15v)/(1+10v) for v >= 0, v = ds/dt / v_max; s = l / l_0.
/// No compression.
struct HillMuscle {
  double area = 0;              ///< m2
  double peak_stress = 0;       ///< sigma_max, Pa
  double passive_strain = 0;    ///< s_p, stretch less one at which f_p = 1
  double passive_exponent = 0;  ///< k
  double maximum_rate = 0;      ///< v_max, 1/s; 0: no velocity dependence
  double damping = 0;           ///< N s/m
  double initial_stretch = 1;   ///< l / l_0 of the undeformed mesh
  Curve activation = {};        ///< a(t) in [0, 1]; empty: passive
  LineAnswer answer(const LineStep& step) const;
};

using LineLaw = std::variant<ElasticLine, CurveLine, HillMuscle>;

inline LineAnswer answer_of(const LineLaw& law, const LineStep& step) {
  return std::visit([&step](const auto& l) { return l.answer(step); }, law);
}

}  // namespace crosswalk::fe
