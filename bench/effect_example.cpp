// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Writes the two tests of docs/effects.md, with ring friction: effect_example FOLDER.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <stdexcept>

#include "effects/ring_friction.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace {

using isotach::datasets::OedometerTest;
using isotach::datasets::Stage;

constexpr double kFriction = 0.08;
constexpr double kStressNoise = 0.005;  // of ln stress
constexpr double kStrainNoise = 2e-5;

/// Two rates, unloading, reloading, a relaxation, a hold at 60 kPa and the way on.
OedometerTest blank_test(double height) {
  OedometerTest test{};
  test.name = "example";
  test.height = height;
  test.diameter = 0.063;
  test.void_ratio = 2.2;
  test.initial_K0 = 0.75;
  test.initial_axial_stress = 8e3;
  double time = 0.0;
  double strain = 0.0;
  const auto row = [&](double at, double to, Stage stage) {
    constexpr double kHeld = 60e3;
    test.record.rows.push_back({test.record.rows.size() + 2, at, to, kHeld, stage, {}, {}, {}});
  };
  const auto ramp = [&](double to, double rate, int rows, Stage stage) {
    const double duration = std::abs(to - strain) / rate;
    for (int i = 1; i <= rows; ++i) {
      const double share = static_cast<double>(i) / rows;
      row(time + share * duration, strain + share * (to - strain), stage);
    }
    time += duration;
    strain = to;
  };
  const auto hold = [&](double duration, int rows, Stage stage) {
    for (int i = 1; i <= rows; ++i) {
      row(time + duration * std::pow(1e-3, 1.0 - static_cast<double>(i) / rows), strain, stage);
    }
    time += duration;
  };
  ramp(0.08, 1e-6, 30, Stage::load);
  ramp(0.12, 1e-5, 20, Stage::load);
  ramp(0.105, 3e-6, 20, Stage::unload);
  ramp(0.15, 3e-6, 25, Stage::load);
  hold(4e4, 15, Stage::relax);
  ramp(0.18, 3e-6, 15, Stage::load);
  hold(4e4, 15, Stage::hold);
  ramp(0.21, 2e-6, 15, Stage::load);
  return test;
}

void write_test(const std::filesystem::path& file, double height, std::mt19937_64& random) {
  namespace fx = isotach::effects;
  isotach::model::ParameterValues<double> values;
  values.values = {1.36, 0.15, 0.015, 0.04, 7e-7, 16.0 * std::numbers::pi / 180.0, 0.05};
  const OedometerTest test = blank_test(height);
  const auto effects =
      *fx::Values<double>::create({fx::with_amplitude(fx::ring_friction::kEffect, kFriction)});
  const auto path =
      isotach::experiments::OedometerExperiment(test, effects)
          .path(*isotach::model::Parameters<double>::create(values), {}, isotach::experiments::Route::cvode);
  if (!path) throw std::runtime_error(path.error().message);
  std::normal_distribution<double> normal;
  std::ofstream stream(file);
  stream
      << "# synthetic: ring friction 0.08, noise of 0.5 % of stress and 2e-5 of strain where stress is held\n"
         "time_s,axial_strain,axial_stress_kPa,stage\n";
  for (std::size_t i = 0; i < test.record.rows.size(); ++i) {
    const auto& row = test.record.rows[i];
    const auto& point = (*path)[i + 1];
    const bool held = row.stage == Stage::hold;
    const double strain = point.axial_strain + (held ? kStrainNoise * normal(random) : 0.0);
    const double stress =
        held ? row.axial_stress : point.axial_stress * std::exp(kStressNoise * normal(random));
    stream << fmt::format("{:.1f},{:.6f},{:.5g},{}\n", row.time, strain, 1e-3 * stress,
                          isotach::datasets::name_of(row.stage));
  }
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: effect_example FOLDER\n");
    return 2;
  }
  std::mt19937_64 random(1);
  write_test(std::filesystem::path(arguments[1]) / "low.csv", 0.02, random);
  write_test(std::filesystem::path(arguments[1]) / "high.csv", 0.04, random);
  return 0;
}
