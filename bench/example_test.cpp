// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/example_test.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "experiments/oedometer_experiment.hpp"

namespace isotach::bench {

namespace {

constexpr double kStressNoise = 0.005;  // of ln stress
constexpr double kStrainNoise = 2e-5;
constexpr double kHeldStress = 60e3;    // of a hold; elsewhere until it is known
constexpr double kFirstReading = 1e-3;  // of a rest's duration

}  // namespace

model::Parameters<double> example_mud() {
  model::ParameterValues<double> values;
  values.values = {1.36, 0.15, 0.015, 0.04, 7e-7, 16.0 * std::numbers::pi / 180.0, 0.05};
  return *model::Parameters<double>::create(values);
}

ExampleTest::ExampleTest(std::string name, double height) {
  test_.name = std::move(name);
  test_.height = height;
  test_.diameter = 0.063;
  test_.void_ratio = 2.2;
  test_.initial_K0 = 0.75;
  test_.initial_axial_stress = 8e3;
}

void ExampleTest::row(double time, double strain, datasets::Stage stage) {
  test_.record.rows.push_back({test_.record.rows.size() + 2, time, strain, kHeldStress, stage, {}, {}, {}});
}

void ExampleTest::ramp(double to, double rate, int rows) {
  const double duration = std::abs(to - strain_) / rate;
  const auto stage = to > strain_ ? datasets::Stage::load : datasets::Stage::unload;
  for (int i = 1; i <= rows; ++i) {
    const double share = static_cast<double>(i) / rows;
    row(time_ + share * duration, strain_ + share * (to - strain_), stage);
  }
  time_ += duration;
  strain_ = to;
}

void ExampleTest::rest(double duration, int rows, datasets::Stage stage) {
  for (int i = 1; i <= rows; ++i) {
    row(time_ + duration * std::pow(kFirstReading, 1.0 - static_cast<double>(i) / rows), strain_, stage);
  }
  time_ += duration;
}

void write_readings(const std::filesystem::path& file, const std::string& comment,
                    const datasets::OedometerTest& test, const effects::Values<double>& effects,
                    std::mt19937_64& random) {
  const auto path =
      experiments::OedometerExperiment(test, effects).path(example_mud(), {}, experiments::Route::cvode);
  if (!path) throw std::runtime_error(path.error().message);
  std::normal_distribution<double> normal;
  std::ofstream stream(file);
  stream << fmt::format("# {}\ntime_s,axial_strain,axial_stress_kPa,stage\n", comment);
  for (std::size_t i = 0; i < test.record.rows.size(); ++i) {
    const auto& row = test.record.rows[i];
    const auto& point = (*path)[i + 1];
    const bool held = row.stage == datasets::Stage::hold;
    const double strain = point.axial_strain + (held ? kStrainNoise * normal(random) : 0.0);
    const double stress =
        held ? row.axial_stress : point.axial_stress * std::exp(kStressNoise * normal(random));
    stream << fmt::format("{:.1f},{:.6f},{:.5g},{}\n", row.time, strain, 1e-3 * stress,
                          datasets::name_of(row.stage));
  }
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace isotach::bench
