// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Oedometer tests of the examples in docs/: stages, readings of a model with effects, and their file.
#pragma once

#include <filesystem>
#include <random>
#include <string>

#include "datasets/study.hpp"
#include "effects/values.hpp"

namespace isotach::bench {

/// The mud of the examples.
[[nodiscard]] model::Parameters<double> example_mud();

/// A test of it without readings, from 8 kPa; stages are appended.
class ExampleTest {
 public:
  ExampleTest(std::string name, double height);
  /// To a strain at a rate (1/s), by so many rows.
  void ramp(double to, double rate, int rows);
  /// For so long (s), readings evenly over the logarithm of time.
  void rest(double duration, int rows, datasets::Stage stage);
  [[nodiscard]] const datasets::OedometerTest& test() const { return test_; }

 private:
  void row(double time, double strain, datasets::Stage stage);
  datasets::OedometerTest test_{};
  double time_ = 0.0;
  double strain_ = 0.0;
};

/// Writes what the mud with those effects reads in the test, by the reference integration, with noise of
/// 0.5 % of stress, and of 2e-5 of strain where stress is held; `comment` says what it is. Throws
/// std::runtime_error where it cannot be led through the test, or the file not written.
void write_readings(const std::filesystem::path& file, const std::string& comment,
                    const datasets::OedometerTest& test, const effects::Values<double>& effects,
                    std::mt19937_64& random);

}  // namespace isotach::bench
