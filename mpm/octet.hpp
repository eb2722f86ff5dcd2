// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Eight doubles that are added and scaled as one.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

namespace isotach::mpm {

/// Either one quantity of eight points, or eight quantities of one node; the compiler splits it where
/// registers are narrower.
using Octet = double __attribute__((vector_size(64)));
using IntegerOctet = long long __attribute__((vector_size(64)));

inline constexpr std::size_t kOctet = 8;

[[nodiscard, gnu::always_inline]] inline Octet load_octet(const double* from) {
  Octet x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
[[gnu::always_inline]] inline void store_octet(double* to, const Octet& x) {
  std::memcpy(to, &x, sizeof x);
}
/// The same number eight times.
[[nodiscard, gnu::always_inline]] inline Octet all(double x) {
  return Octet{x, x, x, x, x, x, x, x};
}
/// The numbers without their fractions; they must be within the range of long long.
[[nodiscard, gnu::always_inline]] inline IntegerOctet truncated(const Octet& x) {
  return __builtin_convertvector(x, IntegerOctet);
}
[[nodiscard, gnu::always_inline]] inline Octet to_double(const IntegerOctet& x) {
  return __builtin_convertvector(x, Octet);
}

/// Whether any of the conditions holds.
[[nodiscard, gnu::always_inline]] inline bool any(const IntegerOctet& conditions) {
  long long sum = 0;
  for (std::size_t k = 0; k < kOctet; ++k) sum |= conditions[k];
  return sum != 0;
}

/// Eight points' quantities, rows[k] the quantity k of all, into columns: eight quantities of one point.
[[gnu::always_inline]] inline void transpose(Octet (&rows)[kOctet]) {
  Octet a[kOctet];
  for (std::size_t k = 0; k < 4; ++k) {
    a[2 * k] = __builtin_shufflevector(rows[2 * k], rows[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    a[2 * k + 1] = __builtin_shufflevector(rows[2 * k], rows[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  Octet b[kOctet];
  for (const std::size_t k : {0U, 1U, 4U, 5U}) {
    b[k] = __builtin_shufflevector(a[k], a[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    b[k + 2] = __builtin_shufflevector(a[k], a[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    rows[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    rows[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace isotach::mpm
