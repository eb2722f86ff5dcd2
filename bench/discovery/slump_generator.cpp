// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/slump_generator.hpp"

#include "calibration/fit_slump.hpp"
#include "datasets/slump_effects.hpp"

namespace isotach::bench {

namespace {

constexpr std::size_t kPoints = 30;  // of an outline

const experiments::Simulate simulate = calibration::plain_simulation(nullptr);

}  // namespace

std::optional<std::string> SlumpGenerator::measure(const effects::Values<double>& effects) {
  for (datasets::SlumpTest& test : tests_) {
    const auto result = simulate(test.name, truth_, datasets::with_effects(test.setup, effects));
    if (!result) return test.name + ": " + result.error().message;
    for (std::size_t k = 0; k < test.outlines.size(); ++k) {
      test.outlines[k].points.clear();
      for (const auto& point : experiments::resampled(result->outlines[k].points, kPoints)) {
        test.outlines[k].points.push_back({point.r, point.z});
      }
    }
  }
  return std::nullopt;
}

calibration::SlumpExperiments SlumpGenerator::experiments(const effects::Values<double>& effects,
                                                          const calibration::SimulationError& error) const {
  calibration::SlumpExperiments all;
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    if (tests_[i].hold_out) continue;
    all.push_back(std::make_shared<experiments::SlumpExperiment>(
        tests_[i],
        experiments::SlumpModel{.simulate = simulate, .simulation_error = error.of(i), .effects = effects}));
  }
  return all;
}

std::optional<Eigen::VectorXd> SlumpGenerator::seen(const effects::Values<double>& effects,
                                                    const model::Parameters<double>& parameters,
                                                    const calibration::SimulationError& error) const {
  std::vector<double> all;
  for (const auto& experiment : experiments(effects, error)) {
    const auto values = experiment->predict(parameters, experiment->local_values());
    if (!values) return std::nullopt;
    all.insert(all.end(), values->begin(), values->end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace isotach::bench
