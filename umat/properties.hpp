// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The PROPS array of the UMAT: what stands where, read and checked.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "integrators/fellin_ostermann.hpp"

namespace isotach::umat {

/// Places in PROPS, counted from 0. All values are SI, but phi_c in degrees and the units themselves.
enum class Property : std::size_t {
  e100,                       ///< 0 to 8: the material parameters, in the order of model::ParameterId
  C_3 = 8,                    ///< the last of them
  lode_dependence,            ///< 1: Matsuoka-Nakai, 0: none
  relative_tolerance,         ///< of a substep, < 1; 0: the default of integrators::Tolerance
  absolute_stress_tolerance,  ///< Pa, of a substep, >= 0
  max_substeps,               ///< in one increment, a whole number; 0: kDefaultMaxSubsteps
  stress_unit,                ///< Pa, of STRESS and DDSDDE: 1 for Pa, 1000 for kPa
  time_unit,                  ///< s, of DTIME: 1 for s, 86400 for days
  initial_void_ratio,         ///< where STATEV holds none; 0: not given
  initial_ocr                 ///< the same, as an overconsolidation ratio; 0: not given
};

inline constexpr std::size_t kPropertyCount = 17;
inline constexpr long kDefaultMaxSubsteps = 100'000;

/// What PROPS says.
struct Properties {
  model::Parameters<double> parameters;
  integrators::Tolerance tolerance;
  double stress_unit;         ///< Pa, > 0
  double time_unit;           ///< s, > 0
  double initial_void_ratio;  ///< 0: not given
  double initial_ocr;         ///< 0: not given; never both
};

/// Reads PROPS. The error names the first value that is not accepted, its place (counted from 1, as Fortran
/// does) and the accepted range.
[[nodiscard]] tl::expected<Properties, std::string> read_properties(std::span<const double> props);

}  // namespace isotach::umat
