// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Effective stress of a constant-rate test: implementation.
#include "datasets/effective_stress.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::datasets {

std::string_view name_of(PorePressureFormula formula) {
  return formula == PorePressureFormula::linear ? "linear" : "nonlinear";
}

std::optional<double> effective_stress(double total_stress, double base_pore_pressure,
                                       PorePressureFormula formula) {
  // The nonlinear formula is (sigma (sigma - u_b)^2)^(1/3): beyond u_b = sigma it would grow again.
  const double drained = total_stress - base_pore_pressure;
  double effective = total_stress - 2.0 * base_pore_pressure / 3.0;
  if (formula == PorePressureFormula::nonlinear) {
    effective = total_stress > 0.0 && drained > 0.0 ? std::cbrt(total_stress * drained * drained) : 0.0;
  }
  if (!(effective > 0.0) || !std::isfinite(effective)) return std::nullopt;
  return effective;
}

double linear_total_stress(double effective_stress, double base_pore_pressure) {
  return effective_stress + 2.0 * base_pore_pressure / 3.0;
}

PorePressureCheck check_pore_pressures(std::span<const double> total_stresses,
                                       std::span<const double> base_pore_pressures,
                                       std::optional<PorePressureFormula> reduced_by) {
  PorePressureCheck check;
  check.reduced_by = reduced_by;
  bool any = false;
  for (std::size_t i = 0; i < total_stresses.size(); ++i) {
    ++check.loading_rows;
    const double ratio = base_pore_pressures[i] / total_stresses[i];
    if (!(ratio >= kLeastPorePressureRatio && ratio <= kGreatestPorePressureRatio)) ++check.outside;
    // Suction beyond the effective stress leaves no total stress to compare with.
    if (!(total_stresses[i] > 0.0) || !std::isfinite(ratio)) continue;
    check.least_ratio = any ? std::min(check.least_ratio, ratio) : ratio;
    check.greatest_ratio = any ? std::max(check.greatest_ratio, ratio) : ratio;
    any = true;
  }
  return check;
}

}  // namespace isotach::datasets
