// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A made-up incremental test and a fit of it, for the tests of reports: the model's own strains, so that
// nothing is missed.
#pragma once

#include <memory>

#include "calibration/fit_oedometer.hpp"
#include "calibration/uncertainty.hpp"
#include "datasets/study.hpp"

namespace isotach::reports {

inline constexpr std::size_t kReadingsPerStep = 6;
inline constexpr double kEndOfPrimary = 200.0;  // s; the first three of the readings below lie before it

/// Loads of 20, 40 and 80 kPa, each read 15, 60, 150, 1000, 10000 and 80000 s after it; then 40 kPa again,
/// read once.
inline datasets::OedometerTest load_step_test() {
  using datasets::Stage;
  datasets::OedometerTest test{};
  test.name = "il-1";
  test.height = 0.02;
  test.void_ratio = 2.2;
  test.void_ratio_source = "given";
  test.initial_K0 = 0.8;
  test.initial_axial_stress = 10e3;
  test.end_of_primary = {datasets::EndOfPrimary::Rule::given, kEndOfPrimary};
  datasets::OedometerRecord& record = test.record;
  record.file = "/somewhere/private/mud-a/il-1.csv";
  record.control = datasets::Control::stress;
  double begin = 0.0;
  std::size_t line = 2;
  const auto step = [&](double load, Stage stage, std::initializer_list<double> times) {
    record.steps.push_back({begin, load, stage, record.rows.size(), times.size()});
    for (const double time : times) {
      record.rows.push_back({line++, begin + time, 0.0, load, stage, std::nullopt, std::nullopt});
    }
    begin = record.rows.back().time;
  };
  for (const double load : {20e3, 40e3, 80e3}) {
    step(load, Stage::load, {15.0, 60.0, 150.0, 1000.0, 10000.0, 80000.0});
  }
  step(40e3, Stage::unload, {80000.0});
  return test;
}

/// The strains that the parameters predict for it.
inline std::shared_ptr<const experiments::OedometerExperiment> load_step_experiment(
    const model::Parameters<double>& parameters) {
  datasets::OedometerTest test = load_step_test();
  // strains do not drive a test of loads, so any will do to learn what the model makes of it
  const experiments::OedometerExperiment blank(test);
  const auto path = blank.path(parameters, {}, experiments::Route::fellin_ostermann).value();
  for (const experiments::PathPoint& point : path) {
    if (point.row != experiments::kNoRow) test.record.rows[point.row].axial_strain = point.axial_strain;
  }
  return std::make_shared<experiments::OedometerExperiment>(test);
}

/// A fit that ends where the strains come from.
inline calibration::OedometerFit load_step_fit(const model::Parameters<double>& parameters) {
  calibration::OedometerFit fit;
  fit.experiments = {load_step_experiment(parameters)};
  fit.locals = {{}};
  fit.result.parameters = parameters;
  const calibration::Experiments all{fit.experiments.front()};
  fit.evaluation = calibration::evaluate_all(all, parameters, fit.locals, 1).value();
  fit.result.tests = calibration::summarise_tests(all, fit.evaluation);
  return fit;
}

}  // namespace isotach::reports
