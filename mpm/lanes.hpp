// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A scalar that is several vector registers of doubles, so that the law runs on many points at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "model/scalar.hpp"
#include "mpm/packet_math.hpp"

namespace isotach::mpm {

/// A pack of doubles with the arithmetic of one. Division, exp, log and roots are within 2 ulp.
///
/// The law is one long chain of operations that wait for each other. Several registers side by side let
/// others fill the waits of one; beyond four they spill to memory more than they gain.
struct Lanes {
  static constexpr std::size_t kRegisters = 4;
  static constexpr std::size_t kCount = kRegisters * kPacketSize;

  Packet v[kRegisters];  // std::array would drop the alignment of its elements

  Lanes() = default;
  // NOLINTNEXTLINE: a constant is a pack, as for any scalar
  Lanes(double x) {
    for (Packet& packet : v) packet = Eigen::internal::pset1<Packet>(x);
  }

  [[nodiscard]] static Lanes load(const double* from) {
    Lanes lanes;
    for (std::size_t i = 0; i < kRegisters; ++i) {
      lanes.v[i] = Eigen::internal::ploadu<Packet>(from + i * kPacketSize);
    }
    return lanes;
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < kRegisters; ++i) Eigen::internal::pstoreu(to + i * kPacketSize, v[i]);
  }
  /// One lane; for rare paths.
  [[nodiscard]] double operator[](std::size_t lane) const {
    std::array<double, kCount> all;
    store(all.data());
    return all[lane];
  }

  Lanes& operator+=(const Lanes& b);
  Lanes& operator-=(const Lanes& b);
  Lanes& operator*=(const Lanes& b);
  Lanes& operator/=(const Lanes& b);
};

/// f of each register.
template <class F, class... Pack>
[[nodiscard]] inline Lanes each(F f, const Pack&... packs) {
  Lanes result;
#pragma GCC unroll 4
  for (std::size_t i = 0; i < Lanes::kRegisters; ++i) result.v[i] = f(packs.v[i]...);
  return result;
}

[[nodiscard]] inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return each([](const Packet& x, const Packet& y) { return Eigen::internal::padd(x, y); }, a, b);
}
[[nodiscard]] inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return each([](const Packet& x, const Packet& y) { return Eigen::internal::psub(x, y); }, a, b);
}
[[nodiscard]] inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return each([](const Packet& x, const Packet& y) { return Eigen::internal::pmul(x, y); }, a, b);
}
[[nodiscard]] inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return each([](const Packet& x, const Packet& y) { return quotient(x, y); }, a, b);
}
[[nodiscard]] inline Lanes operator-(const Lanes& a) {
  return each([](const Packet& x) { return Eigen::internal::pnegate(x); }, a);
}
inline Lanes& Lanes::operator+=(const Lanes& b) {
  return *this = *this + b;
}
inline Lanes& Lanes::operator-=(const Lanes& b) {
  return *this = *this - b;
}
inline Lanes& Lanes::operator*=(const Lanes& b) {
  return *this = *this * b;
}
inline Lanes& Lanes::operator/=(const Lanes& b) {
  return *this = *this / b;
}

/// 1/a.
[[nodiscard]] inline Lanes inverse(const Lanes& a) {
  return each([](const Packet& x) { return reciprocal(x); }, a);
}
[[nodiscard]] inline Lanes operator/(double a, const Lanes& b) {
  return Lanes(a) * inverse(b);
}
[[nodiscard]] inline Lanes sqrt(const Lanes& a) {
  return each([](const Packet& x) { return root(x); }, a);
}
/// 1/sqrt(a).
[[nodiscard]] inline Lanes inverse_sqrt(const Lanes& a) {
  return each([](const Packet& x) { return inverse_root(x); }, a);
}
[[nodiscard]] inline Lanes exp(const Lanes& a) {
  return each([](const Packet& x) { return exponential(x); }, a);
}
[[nodiscard]] inline Lanes log(const Lanes& a) {
  return each([](const Packet& x) { return logarithm(x); }, a);
}
[[nodiscard]] inline Lanes abs(const Lanes& a) {
  return each([](const Packet& x) { return Eigen::internal::pabs(x); }, a);
}
[[nodiscard]] inline Lanes min(const Lanes& a, const Lanes& b) {
  return each([](const Packet& x, const Packet& y) { return Eigen::internal::pmin(x, y); }, a, b);
}
[[nodiscard]] inline Lanes max(const Lanes& a, const Lanes& b) {
  return each([](const Packet& x, const Packet& y) { return Eigen::internal::pmax(x, y); }, a, b);
}
/// Lane by lane: `yes` where a <= b, `no` where a > b or one of them is not a number.
[[nodiscard]] inline Lanes where_le(const Lanes& a, const Lanes& b, const Lanes& yes, const Lanes& no) {
  return each(
      [](const Packet& x, const Packet& y, const Packet& if_le, const Packet& if_not) {
        return Eigen::internal::pselect(Eigen::internal::pcmp_le(x, y), if_le, if_not);
      },
      a, b, yes, no);
}
/// The largest lane; undefined where one is not a number.
[[nodiscard]] inline double largest(const Lanes& a) {
  Packet result = a.v[0];
  for (std::size_t i = 1; i < Lanes::kRegisters; ++i) result = Eigen::internal::pmax(result, a.v[i]);
  return Eigen::internal::predux_max(result);
}

/// The first lane: used where all lanes hold the same constant.
[[nodiscard]] inline double value_of(const Lanes& a) {
  return Eigen::internal::pfirst(a.v[0]);
}

}  // namespace isotach::mpm

/// Lets Eigen's small matrices hold packs.
template <>
struct Eigen::NumTraits<isotach::mpm::Lanes> : Eigen::GenericNumTraits<isotach::mpm::Lanes> {
  using Real = isotach::mpm::Lanes;
  using NonInteger = isotach::mpm::Lanes;
  using Nested = isotach::mpm::Lanes;
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
