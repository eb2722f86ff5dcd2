// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The material parameters of the visco-hypoplastic law: what each is, its bounds, and a validated set of
// them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "model/scalar.hpp"

namespace isotach::model {

enum class ParameterId : std::size_t { e100, lambda, kappa, I_v, D_r, phi_c, C_1, C_2, C_3 };
inline constexpr std::size_t kParameterCount = 9;

/// What one material parameter is. Bounds are in `unit`; the lower one is excluded where `lower_open`,
/// the upper one always is (an infinite one thus asks for a finite value).
struct ParameterInfo {
  ParameterId id;
  std::string_view name;     ///< as in result files
  std::string_view key;      ///< as in a [material] table; carries the unit
  std::string_view unit;     ///< of `key`, "-" if none
  std::string_view meaning;  ///< in the field's words
  double lower;
  double upper;
  bool lower_open;
  double to_si;           ///< factor from `unit` to SI
  bool optional = false;  ///< zero where a [material] table does not name it
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// All parameters in the order of ParameterId.
inline constexpr std::array<ParameterInfo, kParameterCount> kParameterTable{{
    {ParameterId::e100, "e100", "e100", "-", "void ratio at p_B = 100 kPa", 0.0, kInfinity, true, 1.0},
    {ParameterId::lambda, "lambda", "lambda", "-", "compression index, -d ln(1+e)/d ln p_B", 0.0, kInfinity,
     true, 1.0},
    {ParameterId::kappa, "kappa", "kappa", "-", "swelling index, -d ln(1+e)/d ln p in isotropic unloading",
     0.0, kInfinity, true, 1.0},
    {ParameterId::I_v, "I_v", "I_v", "-", "viscosity index, d ln p/d ln(strain rate)", 0.0, kInfinity, true,
     1.0},
    {ParameterId::D_r, "D_r", "D_r_per_s", "1/s", "viscous strain rate (norm) at OCR = 1", 0.0, kInfinity,
     true, 1.0},
    {ParameterId::phi_c, "phi_c", "phi_c_deg", "deg", "critical state friction angle", 0.0, 90.0, true,
     std::numbers::pi / 180.0},
    {ParameterId::C_1, "C_1", "C_1", "-", "hypoplastic strain factor", 0.0, 1.0, false, 1.0},
    {ParameterId::C_2, "C_2", "C_2", "-", "rate at which viscous strain rotates the ellipse", 0.0, kInfinity,
     false, 1.0, true},
    // from 1 on, Omega = C_3 T*/p would leave no ellipse through the critical state
    {ParameterId::C_3, "C_3", "C_3", "-", "steady Omega over the stress ratio T*/p", 0.0, 1.0, false, 1.0,
     true},
}};

[[nodiscard]] constexpr const ParameterInfo& info(ParameterId id) {
  return kParameterTable[static_cast<std::size_t>(id)];
}

/// Whether the parameter may be zero, so that its logarithm is no coordinate for it.
[[nodiscard]] constexpr bool may_be_zero(ParameterId id) {
  return !info(id).lower_open;
}

/// The parameter of that name, if there is one.
[[nodiscard]] std::optional<ParameterId> find_parameter(std::string_view name);

/// Dependence of the critical-state strength on the Lode angle.
enum class LodeDependence {
  matsuoka_nakai,  ///< F after Niemunis (2003): 1 in triaxial compression
  none             ///< F = 1
};

/// Why a set of parameters is not admissible.
struct ParameterError {
  ParameterId id;
  double value;          ///< in the unit of the parameter's key
  std::string accepted;  ///< the accepted range, in words

  [[nodiscard]] std::string message() const;
};

/// Raw parameter values in SI units (phi_c in rad), not validated.
template <class S>
struct ParameterValues {
  std::array<S, kParameterCount> values{};
  LodeDependence lode = LodeDependence::matsuoka_nakai;

  [[nodiscard]] S& operator[](ParameterId id) { return values[static_cast<std::size_t>(id)]; }
  [[nodiscard]] const S& operator[](ParameterId id) const { return values[static_cast<std::size_t>(id)]; }
};

/// Checks every bound and the conditions between parameters (kappa < lambda, C_1 < 1 - kappa/lambda).
[[nodiscard]] std::optional<ParameterError> check(const ParameterValues<double>& values);

/// An admissible set of parameters (SI), immutable.
template <class S>
class Parameters {
 public:
  /// Validates `values`; the error names the first parameter out of bounds.
  [[nodiscard]] static tl::expected<Parameters, ParameterError> create(const ParameterValues<S>& values) {
    ParameterValues<double> plain;
    plain.lode = values.lode;
    for (std::size_t i = 0; i < kParameterCount; ++i) plain.values[i] = value_of(values.values[i]);
    if (auto error = check(plain)) return tl::unexpected(std::move(*error));
    return Parameters(values);
  }

  /// The same parameters as constants of another scalar: from double to ceres::Jet with zero derivatives,
  /// from any scalar to double the plain values.
  template <class T>
  [[nodiscard]] Parameters<T> cast() const {
    ParameterValues<T> values;
    values.lode = values_.lode;
    for (std::size_t i = 0; i < kParameterCount; ++i) values.values[i] = T(value_of(values_.values[i]));
    return Parameters<T>(values);
  }

  [[nodiscard]] const S& operator[](ParameterId id) const { return values_[id]; }
  [[nodiscard]] const S& e100() const { return values_[ParameterId::e100]; }
  [[nodiscard]] const S& lambda() const { return values_[ParameterId::lambda]; }
  [[nodiscard]] const S& kappa() const { return values_[ParameterId::kappa]; }
  [[nodiscard]] const S& I_v() const { return values_[ParameterId::I_v]; }
  [[nodiscard]] const S& D_r() const { return values_[ParameterId::D_r]; }
  [[nodiscard]] const S& phi_c() const { return values_[ParameterId::phi_c]; }
  [[nodiscard]] const S& C_1() const { return values_[ParameterId::C_1]; }
  [[nodiscard]] const S& C_2() const { return values_[ParameterId::C_2]; }
  [[nodiscard]] const S& C_3() const { return values_[ParameterId::C_3]; }
  /// Whether Omega changes: where not, a state whose Omega is zero keeps it.
  [[nodiscard]] bool rotates() const { return !is_exactly_zero(C_2()); }
  [[nodiscard]] LodeDependence lode() const { return values_.lode; }
  [[nodiscard]] const ParameterValues<S>& values() const { return values_; }

 private:
  template <class T>
  friend class Parameters;
  explicit Parameters(const ParameterValues<S>& values) : values_(values) {}
  ParameterValues<S> values_;
};

}  // namespace isotach::model
