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
#ifdef EIGEN_VECTORIZE_AVX512  // Eigen 3.4 compares and selects lane by lane
  Lanes out;
  const __mmask8 less =
      _mm512_cmp_pd_mask(_mm512_load_pd(a.data()), _mm512_load_pd(b.data()), _CMP_LT_OQ);
  _mm512_store_pd(out.data(), _mm512_mask_blend_pd(less, _mm512_load_pd(no.data()),
                                                   _mm512_load_pd(yes.data())));
  return out;
#else
  return (a < b).select(yes, no);
#endif
}
/// False also for a lane that is not a number.
inline bool all_positive(const Lanes& a) {
#ifdef EIGEN_VECTORIZE_AVX512
  return _mm512_cmp_pd_mask(_mm512_load_pd(a.data()), _mm512_setzero_pd(), _CMP_GT_OQ) == 0xff;
#else
  return (a > 0).all();
#endif
}
template <class N>
N constant(double a) {
  if constexpr (std::is_same_v<N, double>)
    return a;
  else
    return N::Constant(a);
}

}  // namespace crosswalk::fe
