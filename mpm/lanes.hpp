// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A scalar that is as many doubles as the machine's vector registers hold, so that the law runs on many
// points at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

#include "model/scalar.hpp"

namespace isotach::mpm {

/// A pack of doubles with the arithmetic of one. exp, log and sqrt are Eigen's packet functions (within 2
/// ulp).
struct Lanes {
  using Packet = Eigen::internal::packet_traits<double>::type;
  static constexpr std::size_t kCount = sizeof(Packet) / sizeof(double);

  Packet v;

  Lanes() = default;
  Lanes(double x)
      : v(Eigen::internal::pset1<Packet>(x)) {}  // NOLINT: a constant is a pack, as for any scalar
  Lanes(Packet p) : v(p) {}                      // NOLINT

  [[nodiscard]] static Lanes load(const double* from) { return {Eigen::internal::ploadu<Packet>(from)}; }
  void store(double* to) const { Eigen::internal::pstoreu(to, v); }
  /// One lane; for rare paths.
  [[nodiscard]] double operator[](std::size_t lane) const {
    std::array<double, kCount> all;
    store(all.data());
    return all[lane];
  }

  Lanes& operator+=(const Lanes& b) { return *this = Lanes(Eigen::internal::padd(v, b.v)); }
  Lanes& operator-=(const Lanes& b) { return *this = Lanes(Eigen::internal::psub(v, b.v)); }
  Lanes& operator*=(const Lanes& b) { return *this = Lanes(Eigen::internal::pmul(v, b.v)); }
  Lanes& operator/=(const Lanes& b) { return *this = Lanes(Eigen::internal::pdiv(v, b.v)); }
};

[[nodiscard]] inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return {Eigen::internal::padd(a.v, b.v)};
}
[[nodiscard]] inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return {Eigen::internal::psub(a.v, b.v)};
}
[[nodiscard]] inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return {Eigen::internal::pmul(a.v, b.v)};
}
[[nodiscard]] inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return {Eigen::internal::pdiv(a.v, b.v)};
}
[[nodiscard]] inline Lanes operator-(const Lanes& a) {
  return {Eigen::internal::pnegate(a.v)};
}
[[nodiscard]] inline Lanes sqrt(const Lanes& a) {
  return {Eigen::internal::psqrt(a.v)};
}
[[nodiscard]] inline Lanes exp(const Lanes& a) {
  return {Eigen::internal::pexp(a.v)};
}
[[nodiscard]] inline Lanes log(const Lanes& a) {
  return {Eigen::internal::plog(a.v)};
}
[[nodiscard]] inline Lanes abs(const Lanes& a) {
  return {Eigen::internal::pabs(a.v)};
}
[[nodiscard]] inline Lanes min(const Lanes& a, const Lanes& b) {
  return {Eigen::internal::pmin(a.v, b.v)};
}
[[nodiscard]] inline Lanes max(const Lanes& a, const Lanes& b) {
  return {Eigen::internal::pmax(a.v, b.v)};
}
/// Lane by lane: only for setting up constants.
[[nodiscard]] inline Lanes sin(const Lanes& a) {
  std::array<double, Lanes::kCount> x;
  a.store(x.data());
  for (double& lane : x) lane = std::sin(lane);
  return Lanes::load(x.data());
}

/// The first lane: used where all lanes hold the same constant (material parameters).
[[nodiscard]] inline double value_of(const Lanes& a) {
  return Eigen::internal::pfirst(a.v);
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
