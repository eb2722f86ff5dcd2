// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A model with effects beside the base, fitted to the oedometer tests of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/effect_sensitivity.hpp"
#include "calibration/fit_oedometer.hpp"

namespace isotach::discovery {

/// The base is the candidate without added effects.
struct Candidate {
  std::vector<const effects::Effect*> added;
  calibration::OedometerFit fit;
  std::vector<datasets::FreeEffect> free;  ///< of the fit
  double chi_squared = 0.0;                ///< by the noise common to all candidates
  double bic = 0.0;                        ///< the same plus ln n for each coordinate
  double bic_without_shapes = 0.0;         ///< the same but for the shape parameters of the added effects
  bool at_bound = false;                   ///< an added amplitude ends at zero or at its largest value
  /// Constants of the material, by name, that end at a bound which the data press against (kBeyondBound).
  std::vector<std::string> beyond_bounds;
};

/// The names of effects that are added, "ring_friction, gas"; "base" where there are none.
[[nodiscard]] std::string name_of(const std::vector<const effects::Effect*>& added);
[[nodiscard]] inline std::string name_of(const Candidate& candidate) {
  return name_of(candidate.added);
}

/// Root mean square of residuals in units of the noise that the study states.
struct Gap {
  double fitted = 0.0;
  double held_out = 0.0;  ///< NaN without held-out tests
};
[[nodiscard]] Gap gap_of(const calibration::OedometerFit& fit);

/// Whether every oedometer test of the study can have the effect; else why not.
[[nodiscard]] std::optional<std::string> lacks(const datasets::Study& study, const effects::Effect& effect);

/// Fits what the study fits and, beside it, all searched parameters of `added`, which start from their
/// typical values, amplitudes from less where the tests cannot be predicted so. Tests held out only
/// measure: where the answer cannot predict them they are left out of `fit`.
[[nodiscard]] tl::expected<Candidate, calibration::FitFailure> fit_with(
    const datasets::Study& study, const model::Parameters<double>& start,
    const std::vector<const effects::Effect*>& added, const calibration::OedometerFitOptions& options);

/// chi_squared and both bic of all by the noise of the one that meets the data best, each brought to its
/// least.
void weigh_alike(const datasets::Study& study, std::vector<Candidate*> candidates, int threads);

}  // namespace isotach::discovery
