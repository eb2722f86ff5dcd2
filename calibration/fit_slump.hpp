// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The fit of a study's slump tests by MPM simulations.
#pragma once

#include "calibration/corrected_slumps.hpp"
#include "calibration/fit_result.hpp"
#include "calibration/slump_map.hpp"
#include "datasets/study.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::calibration {

/// A slump test at the answer.
struct SlumpComparison {
  std::shared_ptr<const experiments::SlumpExperiment> experiment;
  mpm::SlumpResult simulation;
  experiments::Values distances;  ///< m, signed, at each measured point
  double rms = 0.0;               ///< m, all times
  double rms_mould_gone = 0.0;    ///< m, times from which the rim had left the mud; NaN if there is none
  double volume_excess = 0.0;     ///< of the measured outlines over the fill of the mould, mean over times
};

struct SlumpFit {
  FitResult result;
  effects::Values<double> effects;           ///< those of the study, at the answer
  std::vector<double> mud;                   ///< of the study's slump_mud, at the answer
  Corrections corrections;                   ///< to the study's reference numerics, about the answer
  std::vector<SlumpComparison> comparisons;  ///< all tests of the study
  double rms_mould_gone = 0.0;               ///< m, over all tests, held-out ones included
  mpm::RunCounts runs;                       ///< simulations by how they ended, those of the search included
  SimulationError simulation_error;
  std::vector<NumericalShift> shifts;         ///< of the answer by other numerics
  std::optional<SlumpMap> map;                ///< where it was asked for
  std::vector<OptimiserResult> other_routes;  ///< on simulations, beside the one whose answer is taken
};

/// What a slump fit is doing, in the order in which it does it.
enum class SlumpFitStage { simulation_error, uncertainty, map, comparison };

/// In words: "map and profiles".
[[nodiscard]] std::string_view name_of(SlumpFitStage stage);

struct SlumpFitOptions {
  int threads = 1;
  int max_evaluations = 40;
  double first_step = 0.2;  ///< of logarithmic coordinates
  double first_step_C_1 = 0.08;
  /// Searches on simulations, one after the other from the same start; the best answer is taken.
  std::vector<datasets::SlumpRoute> routes{datasets::SlumpRoute::bobyqa};
  OptimiserControl control;
  experiments::Simulate simulate;  ///< where empty, mpm::run_slump until control.stop
  /// Measured at the start values where absent.
  std::optional<SimulationError> simulation_error;
  bool map = true;    ///< profiles and map by a surrogate; intervals then are those of the profiles
  unsigned seed = 1;  ///< of the surrogate's points
  /// Called where a stage begins; the search itself, after simulation_error, is heard by control.callback.
  std::function<void(SlumpFitStage)> stage;
};

/// mpm::run_slump, without history, until `stop`.
[[nodiscard]] experiments::Simulate plain_simulation(const std::atomic<bool>* stop);

/// What a search found, before its uncertainty and the comparison with all tests are worked out.
struct SlumpSearch {
  SlumpPlace at;                        ///< the answer
  OptimiserResult search;               ///< the route that ended best
  std::vector<OptimiserResult> others;  ///< the other routes that were asked for
  mpm::RunCounts runs;                  ///< simulations by how they ended
  SimulationError simulation_error;
  std::vector<std::string> warnings;
};

/// Moves `wanted`, and the study's free effects and mud, from `start` to fit the slump tests that are not
/// held out; tests of one evaluation run in parallel. Where the study has reference numerics, simulations are
/// corrected to them at the start, and the search goes on from its answer, corrected there, until it stays.
[[nodiscard]] tl::expected<SlumpSearch, FitFailure> search_slump(
    const datasets::Study& study, const SlumpPlace& start, const std::vector<model::ParameterId>& wanted,
    const SlumpFitOptions& options);
/// The same from the effects and the mud that the study states.
[[nodiscard]] tl::expected<SlumpSearch, FitFailure> search_slump(
    const datasets::Study& study, const model::Parameters<double>& start,
    const std::vector<model::ParameterId>& wanted, const SlumpFitOptions& options);

/// Uncertainty of `wanted` at the answer of a search (two evaluations a parameter and one), with
/// SlumpFitOptions::map also profiles, map and a last step to the surrogate's least misfit, if the
/// simulations there agree better; and the comparison with all tests, held-out ones included.
[[nodiscard]] tl::expected<SlumpFit, FitFailure> assess_slump(const datasets::Study& study,
                                                              const SlumpSearch& found,
                                                              const std::vector<model::ParameterId>& wanted,
                                                              const SlumpFitOptions& options);

/// Search, by the study's routes, and assessment of its [fit] slump parameters.
[[nodiscard]] tl::expected<SlumpFit, FitFailure> fit_slump(const datasets::Study& study,
                                                           const model::Parameters<double>& start,
                                                           const SlumpFitOptions& options);

}  // namespace isotach::calibration
