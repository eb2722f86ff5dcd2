// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Slump tests as simulations show them at a truth.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/corrected_slumps.hpp"
#include "datasets/study.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::bench {

class SlumpGenerator {
 public:
  /// `tests` have the numerics in which they are simulated.
  SlumpGenerator(std::vector<datasets::SlumpTest> tests, const model::Parameters<double>& truth)
      : tests_(std::move(tests)), truth_(truth) {}

  /// Puts what the tests show with the effects in the place of what was measured; what could not be
  /// simulated, if anything.
  [[nodiscard]] std::optional<std::string> measure(const effects::Values<double>& effects);
  [[nodiscard]] const std::vector<datasets::SlumpTest>& tests() const { return tests_; }
  [[nodiscard]] const model::Parameters<double>& truth() const { return truth_; }

  /// The fitted tests as they were measured, with what discovery's simulations are unsure of in their
  /// covariance.
  [[nodiscard]] calibration::SlumpExperiments experiments(const effects::Values<double>& effects,
                                                          const calibration::SimulationError& error) const;

  /// Decorrelated distances of the fitted tests' outlines, as they were measured, from those with effects;
  /// nothing where those cannot be simulated.
  [[nodiscard]] std::optional<Eigen::VectorXd> seen(const effects::Values<double>& effects,
                                                    const model::Parameters<double>& parameters,
                                                    const calibration::SimulationError& error) const;

 private:
  std::vector<datasets::SlumpTest> tests_;
  model::Parameters<double> truth_;
};

}  // namespace isotach::bench
