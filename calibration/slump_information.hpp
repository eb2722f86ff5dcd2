// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How slump outlines move with the parameters and with the numerics, by simulations beside a point.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "calibration/fit_result.hpp"
#include "calibration/parametrisation.hpp"
#include "calibration/simulation_error.hpp"
#include "datasets/study.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::calibration {

/// One setup simulated at a point, beside it in each coordinate, and with other numerics.
struct SlumpRuns {
  std::string name;
  mpm::SlumpSetup setup;
  std::optional<mpm::SlumpResult> base;  ///< at the point
  /// A simulation with one coordinate moved by `step`, which may be of either sign.
  struct Side {
    double step = 0.0;
    std::optional<mpm::SlumpResult> run{};
  };
  std::vector<std::array<Side, 2>> moved;                 ///< by coordinate of the material
  std::vector<std::optional<mpm::SlumpResult>> variants;  ///< by change of the numerics, at the point
  std::string failure;                                    ///< of the last simulation without a result
};

/// A setup to be simulated, and the name by which the journal knows it.
struct NamedSetup {
  std::string name;
  mpm::SlumpSetup setup;
};

struct SimulatedSetups {
  std::vector<SlumpRuns> runs;  ///< by setup
  /// Of the simulations, as a fit measures it; its own runs are moved to `runs`. Nothing where no setup could
  /// be simulated with changed numerics.
  std::optional<SimulationError> error;
};

/// Simulates all setups at coordinates x, 0.03 beside x in each coordinate of the material (3 %, where it is
/// a logarithm), and at x with the changes of numerics that a fit tries, on the same grid otherwise. A
/// simulation that fails leaves its place empty; only an interrupt ends all.
[[nodiscard]] tl::expected<SimulatedSetups, FitFailure> simulate_around(
    const datasets::Study& study, const Parametrisation& parametrisation, const std::vector<double>& x,
    const std::vector<NamedSetup>& setups, const experiments::Simulate& simulate, int threads);

/// Number of simulations that simulate_around makes of one setup.
[[nodiscard]] std::size_t simulations_around(std::size_t material_coordinates);

/// The test that photographs of runs.base at `times` would make: points of its outlines some `spacing` (m)
/// apart. `times` are among those of the setup.
[[nodiscard]] datasets::SlumpTest test_of(const SlumpRuns& runs, const std::vector<double>& times,
                                          double spacing, const datasets::SlumpNoise& noise);

/// Derivatives of the experiment's values, which have unit variance, by `coordinates` coordinates, those of
/// the material first and zero for the rest; behind them a column for each change of the numerics: by how
/// much it moves them. Central differences, one-sided where a side failed. The experiment's times are among
/// those of the runs. An error says what could not be simulated.
[[nodiscard]] tl::expected<Eigen::MatrixXd, std::string> slump_jacobian(
    const experiments::SlumpExperiment& experiment, const SlumpRuns& runs, std::size_t coordinates);

}  // namespace isotach::calibration
