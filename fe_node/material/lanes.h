// Lanes: as many numbers as a vector register holds, one per element, worked on at once. Kernels
// are templated on their number type N and run with Lanes or SingleLanes in the solver and with
// double in tests; the functions below exist for all three.
//
// One lane group is one register (two doubles, four with AVX, eight with AVX-512), so a kernel's
// values stay in registers instead of going through memory. Which elements share a group is fixed
// by the mesh, so results do not depend on the number of threads.
#pragma once

#include <cmath>
#include <limits>
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

/// may_alias: histories are arrays of double that kernels read as lanes.
typedef double DoubleRegister __attribute__((vector_size(kLanes * sizeof(double)), may_alias));
typedef float SingleRegister __attribute__((vector_size(kLanes * sizeof(double)), may_alias));

namespace lane_detail {
template <class Real>
struct RegisterOf;
template <>
struct RegisterOf<double> {
  using type = DoubleRegister;
};
template <>
struct RegisterOf<float> {
  using type = SingleRegister;
};
}  // namespace lane_detail

/// A register of numbers: kLanes doubles or twice as many floats.
template <class Real>
struct LanesOf {
  using Register = typename lane_detail::RegisterOf<Real>::type;
  Register v;

  LanesOf() = default;  // of no value
  LanesOf(Register a) : v(a) {}
  static LanesOf Constant(double a) { return Register{} + Real(a); }
  static LanesOf Zero() { return Register{}; }
  static LanesOf Ones() { return Constant(1); }

  double operator[](int lane) const { return v[lane]; }
  void set(int lane, double a) { data()[lane] = static_cast<Real>(a); }
  Real* data() { return reinterpret_cast<Real*>(&v); }
  const Real* data() const { return reinterpret_cast<const Real*>(&v); }

  LanesOf operator-() const { return -v; }
  LanesOf& operator+=(const LanesOf& b) { return *this = v + b.v; }
  LanesOf& operator-=(const LanesOf& b) { return *this = v - b.v; }
  LanesOf& operator*=(const LanesOf& b) { return *this = v * b.v; }
  LanesOf& operator/=(const LanesOf& b) { return *this = v / b.v; }
  LanesOf& operator+=(double b) { return *this = v + Real(b); }
  LanesOf& operator-=(double b) { return *this = v - Real(b); }
  LanesOf& operator*=(double b) { return *this = v * Real(b); }
  LanesOf& operator/=(double b) { return *this = v / Real(b); }
  friend LanesOf operator+(const LanesOf& a, const LanesOf& b) { return a.v + b.v; }
  friend LanesOf operator-(const LanesOf& a, const LanesOf& b) { return a.v - b.v; }
  friend LanesOf operator*(const LanesOf& a, const LanesOf& b) { return a.v * b.v; }
  friend LanesOf operator/(const LanesOf& a, const LanesOf& b) { return a.v / b.v; }
  friend LanesOf operator+(const LanesOf& a, double b) { return a.v + Real(b); }
  friend LanesOf operator-(const LanesOf& a, double b) { return a.v - Real(b); }
  friend LanesOf operator*(const LanesOf& a, double b) { return a.v * Real(b); }
  friend LanesOf operator/(const LanesOf& a, double b) { return a.v / Real(b); }
  friend LanesOf operator+(double a, const LanesOf& b) { return Real(a) + b.v; }
  friend LanesOf operator-(double a, const LanesOf& b) { return Real(a) - b.v; }
  friend LanesOf operator*(double a, const LanesOf& b) { return Real(a) * b.v; }
  friend LanesOf operator/(double a, const LanesOf& b) { return Real(a) / b.v; }
};

using Lanes = LanesOf<double>;
using SingleLanes = LanesOf<float>;

/// Elements in one number of type N.
template <class N>
inline constexpr int kWidth = 1;
template <class Real>
inline constexpr int kWidth<LanesOf<Real>> = kLanes* static_cast<int>(sizeof(double) /
                                                                      sizeof(Real));

/// Round-off of 1 in N; and a number so small that adding it changes nothing but a nought.
template <class N>
inline constexpr double kRoundOff = std::numeric_limits<double>::epsilon();
template <>
inline constexpr double kRoundOff<SingleLanes> = std::numeric_limits<float>::epsilon();
template <class N>
inline constexpr double kTiny = 1e-300;
template <>
inline constexpr double kTiny<SingleLanes> = 1e-37;

inline double square_root(double a) { return std::sqrt(a); }
inline double exponential(double a) { return std::exp(a); }
inline double logarithm(double a) { return std::log(a); }
inline double magnitude(double a) { return std::abs(a); }
inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
/// a < b ? yes : no, lane by lane.
inline double where_less(double a, double b, double yes, double no) { return a < b ? yes : no; }

template <class Real, class F>
LanesOf<Real> each(const LanesOf<Real>& a, F f) {
  LanesOf<Real> out;
  for (int i = 0; i < kWidth<LanesOf<Real>>; ++i) out.data()[i] = f(a.v[i]);
  return out;
}

#ifdef __AVX512F__
inline Lanes square_root(const Lanes& a) { return DoubleRegister(_mm512_sqrt_pd(a.v)); }
inline SingleLanes square_root(const SingleLanes& a) { return SingleRegister(_mm512_sqrt_ps(a.v)); }
#elif defined(__AVX__)
inline Lanes square_root(const Lanes& a) { return DoubleRegister(_mm256_sqrt_pd(a.v)); }
inline SingleLanes square_root(const SingleLanes& a) { return SingleRegister(_mm256_sqrt_ps(a.v)); }
#else
template <class Real>
LanesOf<Real> square_root(const LanesOf<Real>& a) {
  return each(a, [](Real x) { return std::sqrt(x); });
}
#endif

#ifdef __AVX__
namespace lane_detail {
#ifdef __AVX512F__
using Packet = Eigen::internal::Packet8d;
using SinglePacket = Eigen::internal::Packet16f;
#else
using Packet = Eigen::internal::Packet4d;
using SinglePacket = Eigen::internal::Packet8f;
#endif
}  // namespace lane_detail
inline Lanes exponential(const Lanes& a) {
  return DoubleRegister(Eigen::internal::pexp(lane_detail::Packet(a.v)));
}
inline SingleLanes exponential(const SingleLanes& a) {
  return SingleRegister(Eigen::internal::pexp(lane_detail::SinglePacket(a.v)));
}
inline Lanes any_logarithm(const Lanes& a) {
  return DoubleRegister(Eigen::internal::plog(lane_detail::Packet(a.v)));
}
inline SingleLanes any_logarithm(const SingleLanes& a) {
  return SingleRegister(Eigen::internal::plog(lane_detail::SinglePacket(a.v)));
}
#else
template <class Real>
LanesOf<Real> exponential(const LanesOf<Real>& a) {
  return each(a, [](Real x) { return std::exp(x); });
}
template <class Real>
LanesOf<Real> any_logarithm(const LanesOf<Real>& a) {
  return each(a, [](Real x) { return std::log(x); });
}
#endif

template <class Real>
LanesOf<Real> magnitude(const LanesOf<Real>& a) {
  return a.v < 0 ? -a.v : a.v;
}
template <class Real>
LanesOf<Real> smaller(const LanesOf<Real>& a, const LanesOf<Real>& b) {
  return a.v < b.v ? a.v : b.v;
}
template <class Real>
LanesOf<Real> larger(const LanesOf<Real>& a, const LanesOf<Real>& b) {
  return a.v > b.v ? a.v : b.v;
}
template <class Real>
LanesOf<Real> where_less(const LanesOf<Real>& a, const LanesOf<Real>& b, const LanesOf<Real>& yes,
                         const LanesOf<Real>& no) {
  return a.v < b.v ? yes.v : no.v;
}
/// The smaller one; what is not a number wins.
template <class Real>
LanesOf<Real> smaller_or_nan(const LanesOf<Real>& a, const LanesOf<Real>& b) {
  return ((b.v < a.v) | (b.v != b.v)) ? b.v : a.v;
}

/// Sum of all lanes in double, in a fixed order: halves on each other.
#ifdef __AVX512F__
inline double sum(const Lanes& a) {
  const __m256d four = _mm256_add_pd(_mm512_castpd512_pd256(a.v), _mm512_extractf64x4_pd(a.v, 1));
  const __m128d two = _mm_add_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
  return two[0] + two[1];
}
inline double sum(const SingleLanes& a) {
  return sum(Lanes(DoubleRegister(_mm512_add_pd(_mm512_cvtps_pd(_mm512_castps512_ps256(a.v)),
                                                _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1))))));
}
#else
template <class Real>
double sum(const LanesOf<Real>& a) {
  constexpr int kCount = kWidth<LanesOf<Real>>;
  double part[kCount];
  for (int i = 0; i < kCount; ++i) part[i] = a[i];
  for (int width = kCount / 2; width > 0; width /= 2)
    for (int i = 0; i < width; ++i) part[i] += part[i + width];
  return part[0];
}
#endif

/// False also for a lane that is not a number.
inline bool all_positive(double a) { return a > 0; }
template <class Real>
bool all_positive(const LanesOf<Real>& a) {
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<Real, double>)
    return _mm512_cmp_pd_mask(a.v, _mm512_setzero_pd(), _CMP_GT_OQ) == 0xff;
  else
    return _mm512_cmp_ps_mask(a.v, _mm512_setzero_ps(), _CMP_GT_OQ) == 0xffff;
#elif defined(__AVX__)
  if constexpr (std::is_same_v<Real, double>)
    return _mm256_movemask_pd(_mm256_cmp_pd(a.v, _mm256_setzero_pd(), _CMP_GT_OQ)) == 0xf;
  else
    return _mm256_movemask_ps(_mm256_cmp_ps(a.v, _mm256_setzero_ps(), _CMP_GT_OQ)) == 0xff;
#else
  for (int i = 0; i < kWidth<LanesOf<Real>>; ++i)
    if (!(a[i] > 0)) return false;
  return true;
#endif
}

/// ln(1 + x) - 2 s with s = x / (2 + x): the tail 2 (s^3 / 3 + s^5 / 5 + ...) of the logarithm,
/// without the round-off of 1 + x where |x| < 1/4. Energies are made of it: those of small strains
/// would drown in what the logarithm and its first terms leave of each other.
inline double logarithm_tail(double x) {
  const double s = x / (2.0 + x), z = s * s;
  if (std::abs(x) >= 0.25) return std::log1p(x) - 2.0 * s;
  double series = 1.0 / 17;
  for (int k = 15; k >= 3; k -= 2) series = series * z + 1.0 / k;
  return 2.0 * s * z * series;
}
template <class Real>
LanesOf<Real> logarithm_tail(const LanesOf<Real>& x) {
  const LanesOf<Real> s = x / (2.0 + x), z = s * s;
  if (!all_positive(0.25 - magnitude(x))) return any_logarithm(1.0 + x) - 2.0 * s;
  constexpr int kLast = std::is_same_v<Real, double> ? 17 : 9;
  LanesOf<Real> series = LanesOf<Real>::Constant(1.0 / kLast);
  for (int k = kLast - 2; k >= 3; k -= 2) series = series * z + 1.0 / k;
  return 2.0 * s * z * series;
}

/// Logarithms of volume ratios: close to one a series, which is exact to round-off and costs a
/// third of the general one.
template <class Real>
LanesOf<Real> logarithm(const LanesOf<Real>& a) {
  const LanesOf<Real> x = a - 1.0;
  if (!all_positive(0.25 - magnitude(x))) return any_logarithm(a);
  return 2.0 * x / (2.0 + x) + logarithm_tail(x);
}

/// x - ln(1 + x), and (1 + x) ln(1 + x) - x: both x^2 / 2 to lowest order, right to round-off of
/// themselves.
template <class N>
N logarithm_gap(const N& x) {
  return x * x / (2.0 + x) - logarithm_tail(x);
}
template <class N>
N entropy_gap(const N& x) {
  return x * x / (2.0 + x) + (1.0 + x) * logarithm_tail(x);
}

template <class N>
N constant(double a) {
  if constexpr (std::is_same_v<N, double>)
    return a;
  else
    return N::Constant(a);
}

/// Writes one element's numbers into its lane: T<double> and T<N> hold nothing but numbers.
template <template <class> class T, class N>
void set_lane(const T<double>& one, int lane, T<N>& all) {
  constexpr std::size_t kCount = sizeof(T<double>) / sizeof(double);
  static_assert(sizeof(T<N>) == kCount * sizeof(N));
  const double* from = reinterpret_cast<const double*>(&one);
  N* to = reinterpret_cast<N*>(&all);
  for (std::size_t k = 0; k < kCount; ++k) to[k].set(lane, from[k]);
}

/// The numbers of one lane.
template <template <class> class T, class N>
T<double> lane_of(const T<N>& all, int lane) {
  constexpr std::size_t kCount = sizeof(T<double>) / sizeof(double);
  static_assert(sizeof(T<N>) == kCount * sizeof(N));
  T<double> one;
  const N* from = reinterpret_cast<const N*>(&all);
  double* to = reinterpret_cast<double*>(&one);
  for (std::size_t k = 0; k < kCount; ++k) to[k] = from[k][lane];
  return one;
}

}  // namespace crosswalk::fe
