#include "fe_node/material/line_law.h"

#include <algorithm>
#include <cmath>

namespace crosswalk::fe {

LineAnswer ElasticLine::answer(const LineStep& step) const {
  LineAnswer answer;
  answer.stiffness = axial_stiffness / step.rest_length;
  answer.damping = damping;
  answer.force = preload + answer.stiffness * step.elongation + damping * step.rate;
  if (is_tension_only && answer.force < 0) answer.force = 0;
  return answer;
}

LineAnswer CurveLine::answer(const LineStep& step) const {
  LineAnswer answer;
  const double per_length = is_strain_based ? 1.0 / step.rest_length : 1.0;
  const double x = step.elongation * per_length;
  const double factor =
      scale * (rate_factor.empty() ? 1.0 : rate_factor.value(step.rate * per_length));
  if (!force.empty()) {
    answer.force = factor * force.value(x);
    answer.stiffness = std::abs(factor * force.slope(x)) * per_length;
  }
  if (is_tension_only && answer.force < 0) answer.force = 0;
  answer.damping = linear_damping;
  double damping = linear_damping * step.rate;
  if (!damping_force.empty()) {
    damping += scale * damping_force.value(step.rate);
    answer.damping += std::abs(scale * damping_force.slope(step.rate));
  }
  answer.force += damping;
  if (is_tension_only && answer.force < 0) answer.force = 0;
  return answer;
}

LineAnswer HillMuscle::answer(const LineStep& step) const {
  LineAnswer answer;
  const double slack_length = step.rest_length / initial_stretch;
  const double stretch = (step.rest_length + step.elongation) / slack_length;
  const double peak = area * peak_stress;
  if (stretch > 1) {
    const double scale = peak / std::expm1(passive_exponent);
    const double k = passive_exponent / passive_strain;
    answer.force = scale * std::expm1(k * (stretch - 1));
    answer.stiffness = scale * k * std::exp(k * (stretch - 1)) / slack_length;
  }
  if (!activation.empty()) {
    const double a = std::clamp(activation.value(step.time), 0.0, 1.0);
    const double v = maximum_rate > 0 ? step.rate / slack_length / maximum_rate : 0.0;
    double by_rate = 0;
    if (v >= 0)
      by_rate = (1 + 15 * v) / (1 + 10 * v);
    else if (v > -1)
      by_rate = (1 + v) / (1 - 4 * v);
    const double by_length = std::exp(-std::pow((stretch - 1) / 0.25, 2));
    answer.force += peak * a * by_length * by_rate;
    // |d f_l / d s| <= sqrt(2/e) / 0.25; d f_v / d v <= 5.
    answer.stiffness += peak * a * 3.5 * 1.5 / slack_length;
    if (maximum_rate > 0) answer.damping += peak * a * 5 / (maximum_rate * slack_length);
  }
  answer.damping += damping;
  answer.force = std::max(answer.force + damping * step.rate, 0.0);
  return answer;
}

}  // namespace crosswalk::fe
