// Lanes: as many numbers as a vector register holds, one per element, worked on at once. Kernels
// are templated on their number type N and run with Lanes in the solver and with double in tests;
// the functions below exist for both.
//
// One lane group is one register (two doubles, four with AVX, eight with AVX-512), so a kernel's
// values stay in registers instead of going through memory. Which elements share a group is fixed
// by the mesh, so results do not depend on the number of threads.
#pragma once

#include <cmath>
#include <type_traits>

#include <Eigen/Core>

namespace crosswalk::fe {

#if defined(__AVX512F__)
inline constexpr int kLanes = 8;
#elif defined(__AVX__)
inline constexpr int kLanes = 4;
#else
inline constexpr int kLanes = 2;
#endif

/// may_alias: histories are arrays of double that kernels read as Lanes.
typedef double LaneRegister __attribute__((vector_size(kLanes * sizeof(double)), may_alias));

struct Lanes {
  LaneRegister v;

  Lanes() = default;  // of no value
  Lanes(LaneRegister a) : v(a) {}
  static Lanes Constant(double a) { return LaneRegister{} + a; }
  static Lanes Zero() { return LaneRegister{}; }
  static Lanes Ones() { return Constant(1); }

  double operator[](int lane) const { return v[lane]; }
  double& operator[](int lane) { return data()[lane]; }
  double* data() { return reinterpret_cast<double*>(&v); }
  const double* data() const { return reinterpret_cast<const double*>(&v); }

  Lanes operator-() const { return -v; }
  Lanes& operator+=(const Lanes& b) { return *this = v + b.v; }
  Lanes& operator-=(const Lanes& b) { return *this = v - b.v; }
  Lanes& operator*=(const Lanes& b) { return *this = v * b.v; }
  Lanes& operator/=(const Lanes& b) { return *this = v / b.v; }
  Lanes& operator+=(double b) { return *this = v + b; }
  Lanes& operator-=(double b) { return *this = v - b; }
  Lanes& operator*=(double b) { return *this = v * b; }
  Lanes& operator/=(double b) { return *this = v / b; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
  friend Lanes operator+(const Lanes& a, double b) { return a.v + b; }
  friend Lanes operator-(const Lanes& a, double b) { return a.v - b; }
  friend Lanes operator*(const Lanes& a, double b) { return a.v * b; }
  friend Lanes operator/(const Lanes& a, double b) { return a.v / b; }
  friend Lanes operator+(double a, const Lanes& b) { return a + b.v; }
  friend Lanes operator-(double a, const Lanes& b) { return a - b.v; }
  friend Lanes operator*(double a, const Lanes& b) { return a * b.v; }
  friend Lanes operator/(double a, const Lanes& b) { return a / b.v; }
};

inline double square_root(double a) { return std::sqrt(a); }
inline double exponential(double a) { return std::exp(a); }
inline double logarithm(double a) { return std::log(a); }
inline double magnitude(double a) { return std::abs(a); }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
/// a < b ? yes : no, lane by lane.
inline double where_less(double a, double b, double yes, double no) { return a < b ? yes : no; }

namespace lane_detail {
#if defined(__AVX512F__)
using Packet = Eigen::internal::Packet8d;
#elif defined(__AVX__)
using Packet = Eigen::internal::Packet4d;
#endif
template <class F>
Lanes each(const Lanes& a, F f) {
  Lanes out;
  for (int i = 0; i < kLanes; ++i) out[i] = f(a[i]);
  return out;
}
}  // namespace lane_detail

#ifdef __AVX__
inline Lanes square_root(const Lanes& a) {
#ifdef __AVX512F__
  return LaneRegister(_mm512_sqrt_pd(a.v));
#else
  return LaneRegister(_mm256_sqrt_pd(a.v));
#endif
}
inline Lanes exponential(const Lanes& a) {
  return LaneRegister(Eigen::internal::pexp(lane_detail::Packet(a.v)));
}
inline Lanes any_logarithm(const Lanes& a) {
  return LaneRegister(Eigen::internal::plog(lane_detail::Packet(a.v)));
}
#else
inline Lanes square_root(const Lanes& a) {
  return lane_detail::each(a, [](double x) { return std::sqrt(x); });
}
inline Lanes exponential(const Lanes& a) {
  return lane_detail::each(a, [](double x) { return std::exp(x); });
}
inline Lanes any_logarithm(const Lanes& a) {
  return lane_detail::each(a, [](double x) { return std::log(x); });
}
#endif
inline Lanes magnitude(const Lanes& a) { return a.v < 0 ? -a.v : a.v; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a.v < b.v ? a.v : b.v; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return a.v > b.v ? a.v : b.v; }
inline Lanes where_less(const Lanes& a, const Lanes& b, const Lanes& yes, const Lanes& no) {
  return a.v < b.v ? yes.v : no.v;
}
/// The smaller one; what is not a number wins.
inline Lanes smaller_or_nan(const Lanes& a, const Lanes& b) {
  return ((b.v < a.v) | (b.v != b.v)) ? b.v : a.v;
}

/// Sum of all lanes, in a fixed order.
inline double sum(const Lanes& a) {
  double part[kLanes];
  for (int i = 0; i < kLanes; ++i) part[i] = a[i];
  for (int width = kLanes / 2; width > 0; width /= 2)
    for (int i = 0; i < width; ++i) part[i] += part[i + width];
  return part[0];
}
inline double smallest(const Lanes& a) {
  double least = a[0];
  for (int i = 1; i < kLanes; ++i) least = smaller(a[i], least);
  return least;
}
inline int lane_of_smallest(const Lanes& a) {
  int lane = 0;
  for (int i = 1; i < kLanes; ++i)
    if (a[i] < a[lane]) lane = i;
  return lane;
}
/// False also for a lane that is not a number.
inline bool all_positive(double a) { return a > 0; }
inline bool all_positive(const Lanes& a) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(a.v, _mm512_setzero_pd(), _CMP_GT_OQ) == 0xff;
#elif defined(__AVX__)
  return _mm256_movemask_pd(_mm256_cmp_pd(a.v, _mm256_setzero_pd(), _CMP_GT_OQ)) == 0xf;
#else
  for (int i = 0; i < kLanes; ++i)
    if (!(a[i] > 0)) return false;
  return true;
#endif
}

/// Logarithms of volume ratios: close to one the series 2 artanh((a - 1) / (a + 1)), which is
/// exact to round-off where |a - 1| < 1/4 and costs a third of the general one.
inline Lanes logarithm(const Lanes& a) {
  if (!all_positive(0.25 - magnitude(a - 1.0))) return any_logarithm(a);
  const Lanes s = (a - 1.0) / (a + 1.0), z = s * s;
  Lanes series = Lanes::Constant(1.0 / 17);
  for (int k = 15; k >= 1; k -= 2) series = series * z + 1.0 / k;
  return 2.0 * s * series;
}

template <class N>
N constant(double a) {
  if constexpr (std::is_same_v<N, double>)
    return a;
  else
    return N::Constant(a);
}

}  // namespace crosswalk::fe
