// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/corrected_slumps.hpp"

#include <algorithm>
#include <iterator>

#include "calibration/outline_volume.hpp"

namespace isotach::calibration {

namespace {

/// The study's tests in their order. D_r stays: the oedometer's gauge has been applied.
Problem make_problem(const SlumpExperiments& all, const datasets::Study& study,
                     const model::Parameters<double>& at, const std::vector<model::ParameterId>& wanted,
                     const SimulationError& error, int threads) {
  const Experiments in_order(all.begin(), all.end());
  const CoordinateSettings settings{study.fit.bounds, {}, study.fit.slump_effects};
  Problem problem(in_order, Parametrisation(at, wanted, settings, GaugeChoice{}, in_order), threads);
  problem.set_common_error(common_error_of(fitted_of(all), error));
  return problem;
}

/// Whether a coordinate moves the mud.
bool is_mud(const Coordinate& coordinate) {
  return coordinate.shared && !coordinate.effect;
}

}  // namespace

std::vector<effects::ParameterRef> free_slump_effects(const datasets::Study& study) {
  std::vector<effects::ParameterRef> free;
  for (const datasets::FreeEffect& one : study.fit.slump_effects) free.push_back(one.parameter);
  return free;
}

SlumpExperiments slump_experiments(const datasets::Study& study, const experiments::Simulate& simulate,
                                   const SimulationError& error, const Corrections& corrections,
                                   const effects::Values<double>& effects,
                                   const std::vector<effects::ParameterRef>& free) {
  SlumpExperiments all;
  for (std::size_t i = 0; i < study.slump_tests.size(); ++i) {
    all.push_back(std::make_shared<experiments::SlumpExperiment>(
        study.slump_tests[i], experiments::SlumpModel{simulate, error.of(i), effects, free,
                                                      study.fit.slump_mud, corrections.of(i)}));
  }
  return all;
}

SlumpExperiments fitted_of(const SlumpExperiments& all) {
  SlumpExperiments fitted;
  std::copy_if(all.begin(), all.end(), std::back_inserter(fitted),
               [](const auto& test) { return !test->held_out(); });
  return fitted;
}

CommonError common_error_of(const SlumpExperiments& fitted, const SimulationError& error) {
  return CommonError(directions_of(error, fitted)).with(direction_of_volume(fitted));
}

SlumpPlace CorrectedSlumps::place_at(const std::vector<double>& x) const {
  const Parametrisation& parametrisation = problem.parametrisation();
  const experiments::SlumpExperiment& any = *tests.front();  // all tests share effects
  SlumpPlace place{*parametrisation.at(x), *any.effects_at(parametrisation.local_of(any, x)), {}};
  const auto& coordinates = parametrisation.coordinates();
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (is_mud(coordinates[k])) place.mud.push_back(coordinates[k].quantity(x[k]));
  }
  return place;
}

tl::expected<CorrectedSlumps, FitFailure> corrected_slumps(const datasets::Study& study,
                                                           const SlumpPlace& place,
                                                           const std::vector<model::ParameterId>& wanted,
                                                           const experiments::Simulate& simulate,
                                                           const SimulationError& error, int threads) {
  const std::vector<effects::ParameterRef> free = free_slump_effects(study);
  SlumpExperiments tests = slump_experiments(study, simulate, error, {}, place.effects, free);
  Problem problem = make_problem(tests, study, place.parameters, wanted, error, threads);
  std::vector<double> start = problem.parametrisation().start();
  const auto& coordinates = problem.parametrisation().coordinates();
  auto mud = place.mud.begin();
  for (std::size_t k = 0; k < start.size() && mud != place.mud.end(); ++k) {
    if (is_mud(coordinates[k])) start[k] = coordinates[k].of_quantity(*mud++);
  }
  std::vector<std::vector<double>> locals;
  for (const auto& test : tests) locals.push_back(problem.parametrisation().local_of(*test, start));
  auto corrections = measure_corrections(study, tests, place.parameters, locals, threads);
  if (!corrections) return tl::unexpected(corrections.error());
  if (corrections->any()) {
    tests = slump_experiments(study, simulate, error, *corrections, place.effects, free);
    const SlumpExperiments fitted = fitted_of(tests);
    problem = problem.with_fitted({fitted.begin(), fitted.end()});
  }
  return CorrectedSlumps{std::move(tests), std::move(problem), std::move(start), std::move(*corrections)};
}

}  // namespace isotach::calibration
