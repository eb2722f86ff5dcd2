// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fits by quick simulations that are corrected to a study's reference numerics.
#pragma once

#include <memory>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "calibration/fit_result.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::calibration {

/// What the reference numerics of a study change in the distances between outlines, at one set of parameters.
/// Quick simulations with that added meet the reference there, and near there as far as the change does not
/// depend on the parameters (additive correction of multi-fidelity optimisation, Alexandrov et al. 2001).
struct Corrections {
  /// Of each of the study's slump tests: at its measured points (m). Empty for a test that needs none, that
  /// was not asked for or that could not be simulated in both ways; empty altogether without a reference.
  std::vector<experiments::Values> tests;
  double outline = 0.0;    ///< root mean square (m) once the rim has left the mud; 0 without a reference
  double lifting = 0.0;    ///< and before
  std::size_t failed = 0;  ///< tests that could not be simulated in both ways

  [[nodiscard]] bool any() const { return !tests.empty(); }
  [[nodiscard]] experiments::Values of(std::size_t test) const {
    return test < tests.size() ? tests[test] : experiments::Values{};
  }
};

/// Whether the study has reference numerics.
[[nodiscard]] bool has_reference(const datasets::Study& study);

/// How many times the work of a quick simulation one by the reference is: by the cells, and the steps that
/// they take; 0 without a reference.
[[nodiscard]] double reference_cost(const datasets::Study& study);

enum class Corrected { all_tests, fitted_tests };

/// Simulates those of `tests`, which are all of a study, both ways at parameters and each test's `locals`.
/// Nothing is simulated where the study has no reference. A test that fails is left as it is. The error is an
/// interruption.
[[nodiscard]] tl::expected<Corrections, FitFailure> measure_corrections(
    const datasets::Study& study,
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
    const model::Parameters<double>& parameters, const std::vector<std::vector<double>>& locals, int threads,
    Corrected which = Corrected::all_tests);

}  // namespace isotach::calibration
