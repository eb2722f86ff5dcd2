// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Parameters read off compression curves by the constructions an engineer draws: where a fit starts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/viscosity_index.hpp"
#include "calibration/yield_stress.hpp"

namespace isotach::calibration {

/// Everything drawn through one test's curve.
struct Constructions {
  Drawn<VirginLine> virgin;
  std::vector<Line> swelling;
  Drawn<CasagrandeYield> casagrande;
  Drawn<BeckerYield> becker;
  std::vector<RateStep> rate_steps;
  std::vector<TimeLine> relaxation;
  std::vector<TimeLine> creep;
};

/// A parameter as read, and from what in a sentence; or no value, and why.
struct StartValue {
  std::optional<double> value;
  std::string source;
};

struct StartValues {
  StartValue e100;  ///< void ratio at p_B+ = 100 kPa on the isotach of the reference rate
  StartValue lambda;
  StartValue kappa;  ///< isotropic
  StartValue I_v;
  std::vector<Constructions> tests;  ///< as given
};

/// The medians over the tests.
///
/// - lambda: slopes of the virgin lines.
/// - kappa: slopes of all swelling lines, made isotropic at `K0` and `phi_c` (isotropic_swelling_index), at
/// most
///   half of lambda: above that the unloading was creeping more than swelling, and it is said so.
/// - I_v: jumps of rate where there are any, else relaxations, else creep lines over lambda of their test.
/// - e100: each virgin line, moved in ln sigma by I_v ln(reference_rate/rate) to the reference rate, read at
/// the
///   axial stress where p_B+ = p + q^2/(M^2 p) is 100 kPa at `K0`. As OCR = 1 at the reference rate in the
///   default gauge, p_B = p_B+ there. Not moved where I_v or the test's rate is unknown, and that is said.
///   For steps of stress the rate is that of creep at the end of the steps.
///
/// phi_c (rad) in (0, pi/2); K0 (lateral to axial stress) in (0, 1]; reference_rate (1/s) > 0; else
/// std::invalid_argument, as for a curve that is none (require_curve).
[[nodiscard]] StartValues start_values(std::span<const std::vector<CurvePoint>> tests, double phi_c,
                                       double K0, double reference_rate);

}  // namespace isotach::calibration
