// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Effective stress of a constant-rate test from total stress and base pore pressure, and how large the latter
// may be.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace isotach::datasets {

/// How the mean effective stress of a specimen drained at its top follows from the total axial stress sigma
/// and the excess pore pressure u_b at its base (ASTM D4186, theories of Wissa and others).
enum class PorePressureFormula {
  linear,    ///< sigma' = sigma - (2/3) u_b, for a coefficient of volume change that is constant
  nonlinear  ///< sigma' = (sigma^3 - 2 sigma^2 u_b + sigma u_b^2)^(1/3), for a constant compression index
};

/// The name as in study files: "linear", "nonlinear".
[[nodiscard]] std::string_view name_of(PorePressureFormula formula);

/// Mean effective axial stress (Pa, compression positive) from the total axial stress and the excess pore
/// pressure at the base (Pa; negative: suction). Nothing where it is not positive, as with u_b >= sigma in
/// the nonlinear formula.
[[nodiscard]] std::optional<double> effective_stress(double total_stress, double base_pore_pressure,
                                                     PorePressureFormula formula);

/// Total axial stress (Pa) by the linear formula, where the effective stress is what the file states.
[[nodiscard]] double linear_total_stress(double effective_stress, double base_pore_pressure);

/// Band of u_b/sigma within which ASTM D4186 keeps the rate of loading.
inline constexpr double kLeastPorePressureRatio = 0.03;
inline constexpr double kGreatestPorePressureRatio = 0.15;

/// The ratios u_b/sigma that a test went through while it was loaded.
struct PorePressureCheck {
  /// The formula that the stresses were reduced by; nothing where the file's were effective already and
  /// sigma was worked out by the linear formula.
  std::optional<PorePressureFormula> reduced_by;
  double least_ratio = 0.0;      ///< of the loading rows (-); 0 where there are none
  double greatest_ratio = 0.0;   ///< likewise
  std::size_t loading_rows = 0;  ///< rows that were looked at
  std::size_t outside = 0;       ///< those with a ratio outside of ASTM's band
};

/// The check of loading rows; one without positive total stress counts as outside and gives no ratio.
/// `total_stresses` (Pa) and `base_pore_pressures` (Pa) have one length.
[[nodiscard]] PorePressureCheck check_pore_pressures(std::span<const double> total_stresses,
                                                     std::span<const double> base_pore_pressures,
                                                     std::optional<PorePressureFormula> reduced_by);

}  // namespace isotach::datasets
