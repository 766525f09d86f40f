// Brittle pane in plane stress: elastic in total strain until the larger principal stress has stood
// above the strength for the delay time; then a crack opens normal to it and the tension it can
// carry fades linearly over the fading time. A closed crack carries compression. A second crack may
// open at a right angle to the first by the tension along that. Nothing is deleted: the interlayer
// holds the shards.
//
// In the axes (n, t) of the first crack, with full plane-stress elasticity sigma_nn and sigma_tt,
// each tension is capped by strength x (1 - time since fracture / fading time), and the stress of
// one direction loses what the released stress of the other had put on it, nu times the release.
// The faces of a crack slide on each other once the shear exceeds what is left of that strength
// plus Coulomb friction on their pressure; the slip stays when they close again, so that no closed
// path of strains gives energy. Strength, rate factor and delay after [pyttel2011] and
// [brokmann2023]; crack frame fixed in the co-rotational frame.
#pragma once

#include "fe_node/material/shell_law.h"

namespace crosswalk::fe {

enum class GlassFracture { Off, Local };

struct ShellGlass {
  double density = 0;
  double youngs_modulus = 0;
  double poisson_ratio = 0;
  double strength = 0;         ///< Pa, principal tension
  double delay = 50e-6;        ///< s above the strength before a crack opens
  double fading_time = 20e-6;  ///< s from full strength to none
  double friction = 0.4;       ///< of crack faces [E]
  GlassFracture fracture = GlassFracture::Local;

  /// History: strain xx yy xy, crack direction (cos, sin), per crack the time above the strength
  /// and, from its opening, the time since; shear strain of the cracks' slip.
  enum Slot { kXx, kYy, kXy, kCos, kSin, kAbove1, kSince1, kAbove2, kSince2, kSlip, kSize };
  int history_size() const { return kSize; }
  template <class N>
  void initialise(N* history) const {
    for (int i = 0; i < kSize; ++i) history[i] = constant<N>(i == kCos ? 1 : 0);
  }

  template <class N>
  PlaneAnswer<N> update(const PlaneStep<N>& step, N* history) const {
    const N zero = constant<N>(0);
    PlaneAnswer<N> answer = plane_elastic(youngs_modulus, poisson_ratio, step);
    for (int i = 0; i < 3; ++i)
      history[i] += i == 0 ? step.strain.xx : i == 1 ? step.strain.yy : step.strain.xy;
    const double plane = youngs_modulus / (1 - poisson_ratio * poisson_ratio);
    const double shear = 0.5 * youngs_modulus / (1 + poisson_ratio);
    PlaneTensor<N>& s = answer.stress;
    s.xx = plane * (history[kXx] + poisson_ratio * history[kYy]);
    s.yy = plane * (history[kYy] + poisson_ratio * history[kXx]);
    s.xy = shear * history[kXy];
    if (fracture == GlassFracture::Off) return answer;

    const N timed = history[kAbove1] + history[kSince1] + history[kAbove2];
    const N no_less = larger(s.xx, s.yy) + magnitude(s.xy);  // than the larger principal stress
    if (all_positive(N(strength - no_less)) && all_positive(N(kTiny<N> - timed)))
      return answer;  // most of a pane: neither cracked nor about to

    const N mean = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
    if (!all_positive(history[kSince1])) {
      // until the first crack the frame follows the principal axes
      const N cosine2 = half / (square_root(N(half * half + s.xy * s.xy)) + kTiny<N>);
      const N cosine = square_root(larger(N(0.5 * (1.0 + cosine2)), zero));
      const N sine_size = square_root(larger(N(0.5 * (1.0 - cosine2)), zero));
      const N sine = where_less(s.xy, zero, N(-sine_size), sine_size);
      history[kCos] = where_less(zero, history[kSince1], history[kCos], cosine);
      history[kSin] = where_less(zero, history[kSince1], history[kSin], sine);
    }
    const N c = history[kCos], d = history[kSin];
    N nn = mean + half * (c * c - d * d) + 2.0 * s.xy * c * d;
    N tt = 2.0 * mean - nn;
    N nt = s.xy * (c * c - d * d) - 2.0 * half * c * d;

    const PlaneTensor<N>& was = step.stress;
    const N nn_was = was.xx * c * c + was.yy * d * d + 2.0 * was.xy * c * d;
    const N cap_n = capacity(nn_was, nn, step.dt, history[kAbove1], history[kSince1]);
    const N release_n = larger(N(nn - cap_n), zero);
    const N tension_t = tt - poisson_ratio * release_n;
    const N cap_t_raw = capacity(N(was.xx + was.yy - nn_was), tension_t, step.dt, history[kAbove2],
                                 history[kSince2]);
    const N cap_t = where_less(zero, history[kSince1], cap_t_raw, constant<N>(1e300));
    history[kSince2] = where_less(zero, history[kSince1], history[kSince2], zero);

    const N release_t = larger(N(tt - cap_t), zero);
    nn -= larger(release_n, N(poisson_ratio * release_t));
    tt -= larger(release_t, N(poisson_ratio * release_n));
    const N grip = smaller(N(cap_n + friction * larger(N(-nn), zero)),
                           N(cap_t + friction * larger(N(-tt), zero)));
    const N stuck = nt - shear * history[kSlip];
    nt = larger(smaller(stuck, grip), N(-grip));
    history[kSlip] += (stuck - nt) * (1 / shear);

    const N mean2 = 0.5 * (nn + tt), half2 = 0.5 * (nn - tt);
    const N cc = c * c - d * d, ss = 2.0 * c * d;
    s.xx = mean2 + half2 * cc - nt * ss;
    s.yy = mean2 - half2 * cc + nt * ss;
    s.xy = half2 * ss + nt * cc;
    const N whole = constant<N>(strength);
    answer.intact = (0.5 / strength) * (smaller(cap_n, whole) + smaller(cap_t, whole));
    return answer;
  }

 private:
  /// The tension that can be carried, infinite without a crack, where it went from `before` to
  /// `now` in this step. The time above the strength, from which time below is taken off again, and
  /// the opening are found inside the step, so that nothing hangs on how time is cut into steps.
  template <class N>
  N capacity(const N& before, const N& now, double dt, N& above, N& since) const {
    const N zero = constant<N>(0);
    const N excess = now - strength, excess_before = before - strength;
    const N over = (larger(excess, zero) + larger(excess_before, zero)) * dt /
                   (magnitude(excess) + magnitude(excess_before) + kTiny<N>);  // s
    const N under = dt - over, kept = smaller(above, constant<N>(delay));
    above = where_less(before, now, N(larger(N(kept - under), zero) + over),
                       larger(N(kept + over - under), zero));
    const N open = larger(N(above - delay), zero);
    since = where_less(zero, since, N(since + dt), open);
    const N left = larger(N(1.0 - since * (1 / fading_time)), zero);
    return where_less(zero, since, N(strength * left), constant<N>(1e300));
  }
};

}  // namespace crosswalk::fe
