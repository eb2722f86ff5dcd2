// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How far a simulated outline can be trusted: the same tests with other cells, points and water.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "calibration/common_error.hpp"
#include "calibration/fit_result.hpp"
#include "calibration/problem.hpp"
#include "datasets/study.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::calibration {

/// In how many ways the numerics are changed.
inline constexpr std::size_t kNumericalVariants = 4;
/// How many simulations of a test tell how far they bend when its material changes.
inline constexpr std::size_t kNudgedSimulations = 4;

/// Simulations of all tests with their numerics changed in one way.
struct NumericalVariant {
  std::string name;        ///< "7 cells across the radius instead of 6"
  double outline = 0.0;    ///< root mean square distance (m) of its outlines, once the rim has left the mud
  double lifting = 0.0;    ///< and before; NaN if there is no such outline
  std::size_t failed = 0;  ///< simulations without a result
  std::vector<std::optional<mpm::SlumpResult>> runs;  ///< of the fitted tests, in their order
};

struct SimulationError {
  experiments::SharedError error;  ///< of all tests alike
  /// What goes into the covariance of each of the study's slump tests; empty: `error` for all.
  std::vector<experiments::SharedError> of_tests = {};
  std::vector<NumericalVariant> variants;
  std::size_t failed = 0;  ///< simulations with the numerics that were changed without a result
  std::vector<std::optional<mpm::SlumpResult>> runs;  ///< with the numerics that were changed, likewise

  [[nodiscard]] const experiments::SharedError& of(std::size_t test) const {
    return of_tests.empty() ? error : of_tests[test];
  }
};

/// Compares outlines of the tests that are fitted with those of one and two cells more across the radius, of
/// nine points a cell, and of these in water four times as stiff; where the study has reference numerics,
/// with those, one and two cells fewer. The differences of all variants are taken as they are for the error:
/// half of their variance may be the variants' own, but an error common to all of them is not seen. Each
/// outline's own differences count for its error, with those of its test and of all tests as one variant more
/// each: a mould that is lifted slowly leaves more to the numerics than one that is lifted at once. So few
/// tell little of how large the next may be; its variance is that of Student's distribution. To that comes
/// how far simulations with the study's numerics bend when I_v or C_1 change by about what tests leave of
/// them open, half of a second difference: little, but for mud that topples. Correlations are those of
/// neighbouring places and times. Nothing of the data is used.
[[nodiscard]] tl::expected<SimulationError, FitFailure> measure_simulation_error(
    const datasets::Study& study, const model::Parameters<double>& parameters,
    const experiments::Simulate& simulate, int threads);

/// What takes `from` to `to`, simulations of the `tests`: distances as fits see them, stacked. A test without
/// either of the two has zeros.
[[nodiscard]] Eigen::VectorXd stacked_change(
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
    const std::vector<std::optional<mpm::SlumpResult>>& from,
    const std::vector<std::optional<mpm::SlumpResult>>& to);

/// What each variant of the numerics that was measured changes in the residuals of the tests that are fitted,
/// one column a variant. A variant that failed in some test gives none.
[[nodiscard]] Eigen::MatrixXd directions_of(
    const SimulationError& error,
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& fitted);

/// How far each variant moves the answer of a fit: by what its outlines differ, common to all tests.
struct NumericalShift {
  std::string variant;
  Eigen::VectorXd shift;  ///< of the coordinates
};

/// The shifts by a linearised problem; its fitted experiments are `tests`, or stand in for them, and `common`
/// is what whitened it. A test that a variant could not simulate does not shift anything.
[[nodiscard]] std::vector<NumericalShift> numerical_shifts(
    const Linearised& at, const CommonError& common,
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
    const SimulationError& error);

/// The sum of the shifts' outer products: what the choice of cells and points adds to the covariance of the
/// coordinates where nothing whitened the problem. It does not shrink with more tests.
[[nodiscard]] Eigen::MatrixXd numerical_covariance(const std::vector<NumericalShift>& shifts,
                                                   Eigen::Index coordinates);

}  // namespace isotach::calibration
