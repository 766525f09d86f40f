// Lanes: eight numbers worked on at once, one per element. Kernels are templated on their number
// type N and run with Lanes in the solver and with double in tests; the functions below exist for
// both and return plain values, never Eigen expressions.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace crosswalk::fe {

inline constexpr int kLanes = 8;
using Lanes = Eigen::Array<double, kLanes, 1>;

inline double square_root(double a) { return std::sqrt(a); }
inline Lanes square_root(const Lanes& a) { return a.sqrt(); }
inline double exponential(double a) { return std::exp(a); }
inline Lanes exponential(const Lanes& a) { return a.exp(); }
inline double logarithm(double a) { return std::log(a); }
inline Lanes logarithm(const Lanes& a) { return a.log(); }
inline double magnitude(double a) { return std::abs(a); }
inline Lanes magnitude(const Lanes& a) { return a.abs(); }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a.min(b); }
inline double larger(double a, double b) { return a > b ? a : b; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return a.max(b); }
/// a < b ? yes : no, lane by lane.
inline double where_less(double a, double b, double yes, double no) { return a < b ? yes : no; }
inline Lanes where_less(const Lanes& a, const Lanes& b, const Lanes& yes, const Lanes& no) {
  return (a < b).select(yes, no);
}
template <class N>
N constant(double a) {
  if constexpr (std::is_same_v<N, double>)
    return a;
  else
    return N::Constant(a);
}

}  // namespace crosswalk::fe
