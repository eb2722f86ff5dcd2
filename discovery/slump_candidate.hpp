// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A model with effects beside the base, fitted to the slump tests of a study by few simulations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "calibration/corrected_slumps.hpp"
#include "calibration/reference_numerics.hpp"
#include "calibration/secant_fit.hpp"
#include "calibration/simulation_error.hpp"
#include "discovery/candidate.hpp"

namespace isotach::discovery {

/// What all candidates share: the tests, where fits start and what is known beforehand.
struct SlumpBasis {
  const datasets::Study& study;
  model::Parameters<double> start;
  std::array<std::optional<datasets::Prior>, model::kParameterCount> priors;  ///< as from oedometer tests
  experiments::Simulate simulate;
  calibration::SimulationError error;
  calibration::Corrections corrections;  ///< of simulations to the study's reference numerics
  int threads = 1;
  calibration::OptimiserControl control;
};

using SlumpTests = calibration::SlumpExperiments;

/// The fit of one set of effects. Residuals are outlines' distances decorrelated, the simulations' own error
/// in their covariance.
struct SlumpCandidate {
  std::vector<const effects::Effect*> added;
  SlumpTests tests;  ///< all of the study, with these effects
  std::shared_ptr<const calibration::Problem> problem;
  calibration::SecantPoint
      at;  ///< residuals freed of the error that all tests share (slump_common_error.hpp)
  effects::Values<double> effects;  ///< all that are on, at the answer
  std::optional<model::Parameters<double>> parameters;
  double chi_squared = 0.0;  ///< priors included
  double bic = 0.0;          ///< the same over `scale` of the search, and ln n for each coordinate
  bool at_bound = false;     ///< an added amplitude ends at zero or at its largest value
  /// Root mean square of each fitted test's residuals.
  std::vector<double> gaps;
  double gap = 0.0;  ///< of all fitted tests
};

[[nodiscard]] inline std::string name_of(const SlumpCandidate& candidate) {
  return name_of(candidate.added);
}

/// The problem of a set of effects, amplitudes at zero where they are added; nothing is simulated.
[[nodiscard]] SlumpCandidate slump_candidate(const SlumpBasis& basis,
                                             const std::vector<const effects::Effect*>& added);

/// Coordinates of the base continued by `amplitudes` (typical values) of the added effects and typical
/// shapes.
[[nodiscard]] std::vector<double> continued(const SlumpCandidate& candidate, const std::vector<double>& base,
                                            double amplitude);

/// Fills in what follows from `at`; `gaps` are of `as_read`, its residuals as the problem has them.
void conclude(SlumpCandidate& candidate, const Eigen::VectorXd& as_read);

/// Rows of residuals that belong to each fitted test: first and count.
[[nodiscard]] std::vector<std::pair<Eigen::Index, Eigen::Index>> rows_of(const calibration::Problem& problem);

/// Log density of each fitted test as the others predict it, by linearisation, summed: residuals then have
/// the covariance `variance` I + J C J', C that of the coordinates without the test.
[[nodiscard]] double left_out_density(const SlumpCandidate& candidate, double variance);

}  // namespace isotach::discovery
