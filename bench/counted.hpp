// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A scalar that counts what is done with it, so that the law's operations need not be counted by hand.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace isotach::bench {

/// Numbers of operations.
struct Operations {
  int simple = 0;  ///< additions and multiplications
  int quotients = 0;
  int roots = 0;
  int functions = 0;  ///< exp and log

  /// Additions and multiplications if every operation were made of them, as in mpm/packet_math.hpp: a
  /// quotient of 12, a root of 11, exp or log of 35, a fused multiply-add counting as two.
  [[nodiscard]] double elementary() const {
    return simple + 12.0 * quotients + 11.0 * roots + 35.0 * functions;
  }
};

/// A double that counts; not for several threads.
struct Counted {
  double value;
  static inline Operations operations;

  Counted() = default;
  // NOLINTNEXTLINE: a constant, as for any scalar
  Counted(double x) : value(x) {}

  Counted& operator+=(const Counted& b) { return *this = simple(value + b.value); }
  Counted& operator-=(const Counted& b) { return *this = simple(value - b.value); }
  Counted& operator*=(const Counted& b) { return *this = simple(value * b.value); }
  Counted& operator/=(const Counted& b) { return *this = *this / b; }

  friend Counted operator+(const Counted& a, const Counted& b) { return simple(a.value + b.value); }
  friend Counted operator-(const Counted& a, const Counted& b) { return simple(a.value - b.value); }
  friend Counted operator*(const Counted& a, const Counted& b) { return simple(a.value * b.value); }
  friend Counted operator/(const Counted& a, const Counted& b) {
    ++operations.quotients;
    return {a.value / b.value};
  }
  friend Counted operator-(const Counted& a) { return {-a.value}; }
  friend Counted sqrt(const Counted& a) {
    ++operations.roots;
    return {std::sqrt(a.value)};
  }
  friend Counted inverse_sqrt(const Counted& a) {
    ++operations.roots;
    return {1.0 / std::sqrt(a.value)};
  }
  friend Counted exp(const Counted& a) {
    ++operations.functions;
    return {std::exp(a.value)};
  }
  friend Counted log(const Counted& a) {
    ++operations.functions;
    return {std::log(a.value)};
  }

 private:
  static Counted simple(double result) {
    ++operations.simple;
    return {result};
  }
};

}  // namespace isotach::bench

/// Lets Eigen's small matrices hold it.
template <>
struct Eigen::NumTraits<isotach::bench::Counted> : Eigen::GenericNumTraits<isotach::bench::Counted> {
  using Real = isotach::bench::Counted;
  using NonInteger = isotach::bench::Counted;
  using Nested = isotach::bench::Counted;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
