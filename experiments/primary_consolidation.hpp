// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The end of primary consolidation of a load step, by the constructions that engineers draw.
#pragma once

#include <span>
#include <string>
#include <tl/expected.hpp>

namespace isotach::experiments {

/// Taylor's square-root-of-time construction: a straight line through the early readings of strain against
/// sqrt(t), cut by the readings where its abscissae are 1.15 times as long: there 90 % of primary compression
/// is done, and 10/9 of the strain until then is its end. Time (s) after the load at which the readings pass
/// that strain. Times (s) increase strictly and are positive; strains (-) in either direction; `before` is
/// the strain that was read last before the load.
///
/// Fails, saying why, where readings do not begin early enough or the curve never leaves its straight part.
[[nodiscard]] tl::expected<double, std::string> end_of_primary_taylor(std::span<const double> times,
                                                                      std::span<const double> strains,
                                                                      double before);

/// Casagrande's log-time construction: the tangent at the point of inflection of strain against ln(t) and the
/// straight line through the last readings meet at the end of primary compression.
[[nodiscard]] tl::expected<double, std::string> end_of_primary_casagrande(std::span<const double> times,
                                                                          std::span<const double> strains);

}  // namespace isotach::experiments
