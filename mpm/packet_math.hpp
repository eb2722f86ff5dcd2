// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Division, roots, exp and log of a vector register of doubles, for throughput.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include <immintrin.h>
#endif

namespace isotach::mpm {

/// The machine's widest vector register of doubles.
using Packet = Eigen::internal::packet_traits<double>::type;
inline constexpr std::size_t kPacketSize = sizeof(Packet) / sizeof(double);

#if defined(__AVX512F__) && defined(__AVX512DQ__)

// The divider serves eight doubles in 16 cycles and their root in some 30, one operation at a time, whereas a
// multiplication takes half a cycle. Estimates of 14 bits, raised to full precision by Newton's method, go
// through the multipliers instead. Where an estimate is already exact (0, infinity) its residual is not a
// number, and it is kept.

/// 1/x, within 1 ulp where 1/x is a normal number.
[[nodiscard]] inline __m512d reciprocal(__m512d x) {
  const __m512d one = _mm512_set1_pd(1.0);
  const __m512d y0 = _mm512_rcp14_pd(x);
  const __m512d r0 = _mm512_fnmadd_pd(x, y0, one);
  const __mmask8 inexact = _mm512_cmp_pd_mask(r0, r0, _CMP_ORD_Q);
  const __m512d y1 = _mm512_mask_fmadd_pd(y0, inexact, r0, y0);
  const __m512d r1 = _mm512_fnmadd_pd(x, y1, one);
  return _mm512_mask_fmadd_pd(y1, inexact, r1, y1);
}

/// a/b, within 1 ulp where 1/b and a/b are normal numbers.
[[nodiscard]] inline __m512d quotient(__m512d a, __m512d b) {
  const __m512d y = reciprocal(b);
  const __m512d q = _mm512_mul_pd(a, y);
  const __m512d r = _mm512_fnmadd_pd(b, q, a);
  const __mmask8 inexact = _mm512_cmp_pd_mask(r, r, _CMP_ORD_Q);
  return _mm512_mask3_fmadd_pd(r, y, q, inexact);
}

/// What 1/sqrt and sqrt share: an estimate y of 1/sqrt(x), x y, and the relative correction of both.
struct RootEstimate {
  __m512d y, xy, residual, correction;
};

[[nodiscard]] inline RootEstimate estimate_root(__m512d x) {
  RootEstimate e;
  e.y = _mm512_rsqrt14_pd(x);
  e.xy = _mm512_mul_pd(x, e.y);
  // 1/sqrt(1 - r) - 1 = r/2 + 3/8 r^2 + 5/16 r^3, r of 13 bits
  e.residual = _mm512_fnmadd_pd(e.xy, e.y, _mm512_set1_pd(1.0));
  __m512d series = _mm512_fmadd_pd(e.residual, _mm512_set1_pd(0.3125), _mm512_set1_pd(0.375));
  series = _mm512_fmadd_pd(e.residual, series, _mm512_set1_pd(0.5));
  e.correction = _mm512_mul_pd(e.residual, series);
  return e;
}

/// 1/sqrt(x), within 1 ulp where x is a normal number.
[[nodiscard]] inline __m512d inverse_root(__m512d x) {
  const RootEstimate e = estimate_root(x);
  const __mmask8 inexact = _mm512_cmp_pd_mask(e.residual, e.residual, _CMP_ORD_Q);
  return _mm512_mask_fmadd_pd(e.y, inexact, e.correction, e.y);
}

/// sqrt(x), within 1 ulp where x is zero or a normal number.
[[nodiscard]] inline __m512d root(__m512d x) {
  constexpr int kZeroOrInfinite = 0x02 | 0x04 | 0x08;
  const RootEstimate e = estimate_root(x);
  const __m512d y = _mm512_fmadd_pd(e.xy, e.correction, e.xy);
  return _mm512_mask_mov_pd(y, _mm512_fpclass_pd_mask(x, kZeroOrInfinite), x);
}

/// exp(x), within 1 ulp.
///
/// x = n ln 2 + r, |r| <= ln(2)/2; exp(r) = 1 + r + r^2 Q(r), with Q the polynomial through exp at the
/// Chebyshev nodes (relative error 1.6e-17).
[[nodiscard]] inline __m512d exponential(__m512d argument) {
  const auto c = [](double x) { return _mm512_set1_pd(x); };
  // beyond these the result is infinite or zero; the order of operands lets NaN through
  const __m512d x = _mm512_min_pd(c(710.0), _mm512_max_pd(c(-746.0), argument));
  const __m512d n = _mm512_roundscale_pd(_mm512_mul_pd(x, c(1.4426950408889634)),
                                         _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  __m512d r = _mm512_fnmadd_pd(n, c(0.6931471805599453), x);
  r = _mm512_fnmadd_pd(n, c(2.3190468138462996e-17), r);
  const auto line = [&](double a, double b) { return _mm512_fmadd_pd(c(b), r, c(a)); };
  const __m512d r2 = _mm512_mul_pd(r, r);
  const __m512d r4 = _mm512_mul_pd(r2, r2);
  __m512d q01 = line(0.5000000000000001, 0.16666666666666669);
  __m512d q45 = line(0.0013888888917196719, 0.00019841269863040545);
  const __m512d q23 = line(0.041666666666624164, 0.008333333333330065);
  const __m512d q67 = line(2.4801521322368692e-05, 2.7557268480310024e-06);
  const __m512d q89 = line(2.7620075879983367e-07, 2.5100375832561234e-08);
  q01 = _mm512_fmadd_pd(q23, r2, q01);
  q45 = _mm512_fmadd_pd(q67, r2, q45);
  q45 = _mm512_fmadd_pd(q89, r4, q45);
  const __m512d q = _mm512_fmadd_pd(q45, r4, q01);
  const __m512d power = _mm512_add_pd(_mm512_fmadd_pd(q, r2, r), c(1.0));
  return _mm512_scalef_pd(power, n);
}

/// ln(x) for normal x > 0, within 2 ulp or 2e-16, whichever is larger; NaN for x < 0, -infinity for 0.
///
/// x = 2^n m, 3/4 <= m < 3/2; ln m = 2 artanh(s), s = (m - 1)/(m + 1), with (2 artanh(s) - 2 s)/s^3 the
/// polynomial in s^2 through it at the Chebyshev nodes (relative error 6e-17).
[[nodiscard]] inline __m512d logarithm(__m512d x) {
  const auto c = [](double a) { return _mm512_set1_pd(a); };
  const __m512d m = _mm512_getmant_pd(x, _MM_MANT_NORM_p75_1p5, _MM_MANT_SIGN_nan);
  // getexp counts from 1 <= m < 2
  const __mmask8 halved = _mm512_cmp_pd_mask(m, c(1.0), _CMP_LT_OQ);
  __m512d n = _mm512_getexp_pd(x);
  n = _mm512_mask_add_pd(n, halved, n, c(1.0));
  const __m512d f = _mm512_sub_pd(m, c(1.0));
  const __m512d s = _mm512_mul_pd(f, reciprocal(_mm512_add_pd(m, c(1.0))));
  const __m512d z = _mm512_mul_pd(s, s);
  const auto line = [&](double a, double b) { return _mm512_fmadd_pd(c(b), z, c(a)); };
  const __m512d z2 = _mm512_mul_pd(z, z);
  __m512d p01 = line(0.6666666666666693, 0.3999999999934565);
  __m512d p45 = line(0.18184588603804439, 0.15284232657100633);
  const __m512d p23 = line(0.2857142883267973, 0.22222183180681265);
  p45 = _mm512_fmadd_pd(c(0.15113680893531198), z2, p45);
  p01 = _mm512_fmadd_pd(p23, z2, p01);
  const __m512d p = _mm512_fmadd_pd(p45, _mm512_mul_pd(z2, z2), p01);
  const __m512d rest = _mm512_mul_pd(_mm512_mul_pd(s, z), p);
  const __m512d low = _mm512_fmadd_pd(n, c(2.3190468138462996e-17), rest);
  const __m512d sum = _mm512_fmadd_pd(s, c(2.0), low);
  return _mm512_fmadd_pd(n, c(0.6931471805599453), sum);
}

#else

[[nodiscard]] inline Packet reciprocal(Packet x) {
  return Eigen::internal::pdiv(Eigen::internal::pset1<Packet>(1.0), x);
}
[[nodiscard]] inline Packet quotient(Packet a, Packet b) {
  return Eigen::internal::pdiv(a, b);
}
[[nodiscard]] inline Packet inverse_root(Packet x) {
  return reciprocal(Eigen::internal::psqrt(x));
}
[[nodiscard]] inline Packet root(Packet x) {
  return Eigen::internal::psqrt(x);
}
[[nodiscard]] inline Packet exponential(Packet x) {
  return Eigen::internal::pexp(x);
}
[[nodiscard]] inline Packet logarithm(Packet x) {
  return Eigen::internal::plog(x);
}

#endif

}  // namespace isotach::mpm
