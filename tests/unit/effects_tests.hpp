// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer tests that show every effect, for the tests of effects.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "effects/values.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::experiments {

inline model::Parameters<double> effects_mud(double I_v = 0.04, double e100 = 1.36, double D_r = 7e-7) {
  model::ParameterValues<double> values;
  values.values = {e100, 0.15, 0.015, I_v, D_r, 16.0 * std::numbers::pi / 180.0, 0.05};
  return *model::Parameters<double>::create(values);
}

/// The room's temperature (deg C) at a time (s): between 17 and 23.
inline double room(double time) {
  return 20.0 + 3.0 * std::sin(time / 60000.0);
}

/// Builds a record row by row.
struct RecordBuilder {
  datasets::OedometerTest test{};
  double time = 0.0;
  double strain = 0.0;

  void row(double at, double axial_strain, double stress, datasets::Stage stage) {
    test.record.rows.push_back(
        {test.record.rows.size() + 2, at, axial_strain, stress, stage, {}, room(at), {}});
    time = at;
    strain = axial_strain;
  }
  /// At a constant rate (1/s) to a strain.
  void ramp(double to, double rate, int rows, datasets::Stage stage) {
    const double from = strain;
    const double begin = time;
    for (int i = 1; i <= rows; ++i) {
      const double share = static_cast<double>(i) / rows;
      row(begin + share * std::abs(to - from) / rate, from + share * (to - from), 10e3, stage);
    }
  }
  /// Rows at growing times; the stress is read only where the stage holds it.
  void hold(double duration, int rows, datasets::Stage stage, double stress) {
    const double begin = time;
    const double held = strain;
    for (int i = 1; i <= rows; ++i) {
      row(begin + duration * std::pow(1e-3, 1.0 - static_cast<double>(i) / rows), held, stress, stage);
    }
  }
};

inline datasets::OedometerTest described(datasets::OedometerTest test, const std::string& name) {
  test.name = name;
  test.height = 0.025;
  test.diameter = 0.06;
  test.void_ratio = 2.2;
  test.initial_K0 = 0.75;
  test.initial_axial_stress = 8e3;
  test.noise = {0.005, 20.0, 2e-5};
  return test;
}

/// Two rates, unloading and reloading, a relaxation and a hold at constant stress.
inline datasets::OedometerTest crs_test() {
  using datasets::Stage;
  RecordBuilder record;
  record.ramp(0.08, 1e-6, 20, Stage::load);
  record.ramp(0.12, 1e-5, 12, Stage::load);
  record.ramp(0.105, 3e-6, 10, Stage::unload);
  record.ramp(0.15, 3e-6, 16, Stage::load);
  record.hold(4e4, 10, Stage::relax, 10e3);
  record.ramp(0.18, 3e-6, 10, Stage::load);
  record.hold(4e4, 10, Stage::hold, 60e3);
  record.ramp(0.21, 2e-6, 8, Stage::load);
  return described(std::move(record.test), "crs");
}

/// Loads of 6 hours, each brought on within 10 minutes, with unloading.
inline datasets::OedometerTest load_test() {
  using datasets::Stage;
  RecordBuilder record;
  record.test.record.control = datasets::Control::stress;
  double last = 8e3;
  for (const double load : {16e3, 32e3, 64e3, 32e3, 16e3, 64e3, 128e3}) {
    const double begin = record.time;
    const Stage stage = load > last ? Stage::load : Stage::unload;
    record.test.record.steps.push_back({begin, load, stage, record.test.record.rows.size(), 8});
    for (int i = 0; i < 8; ++i) record.row(begin + 60.0 * std::pow(360.0, i / 7.0), 0.01, load, stage);
    last = load;
  }
  datasets::OedometerTest test = described(std::move(record.test), "loads");
  test.end_of_primary = {datasets::EndOfPrimary::Rule::given, 600.0};
  return test;
}

/// The effect at its typical parameters, its amplitude times a factor.
inline effects::Values<double> only(const effects::Effect& effect, double factor = 1.0) {
  return *effects::Values<double>::create(
      {effects::with_amplitude(effect, factor * effect.parameters[0].typical_si())});
}

/// The values compared, by the integrator of the fits and by the reference.
inline Values by_fit(const OedometerExperiment& experiment, const model::Parameters<double>& parameters,
                     std::span<const double> local = {}) {
  const auto values = experiment.predict(parameters, local);
  if (!values) throw std::runtime_error(values.error().message);
  return *values;
}
inline Values by_reference(const OedometerExperiment& experiment, const model::Parameters<double>& parameters,
                           std::span<const double> local = {}) {
  const auto path = experiment.path(parameters, local, Route::cvode);
  if (!path) throw std::runtime_error(path.error().message);
  return experiment.values_of(*path);
}

}  // namespace isotach::experiments
