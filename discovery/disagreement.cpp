// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/disagreement.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/effect_sensitivity.hpp"
#include "discovery/linear_model.hpp"

namespace isotach::discovery {

namespace {

using calibration::FitFailure;
using experiments::Linearisation;

double root_of_squares_in(const Disagreement& place, const experiments::OedometerExperiment& test,
                          const experiments::Values& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double time = test.row_of(test.values()[k]).time;
    if (time >= place.stage.from_time && time <= place.stage.to_time) sum += values[k] * values[k];
  }
  return std::sqrt(sum);
}

}  // namespace

std::vector<Disagreement> disagreement_of(const calibration::OedometerFit& base) {
  std::vector<Disagreement> all;
  for (const calibration::TestCheck& test : base.checks) {
    for (const calibration::StageCheck& stage : test.stages) {
      const double count = static_cast<double>(stage.count);
      const double beyond = count * (stage.rms_over_noise * stage.rms_over_noise - 1.0);
      all.push_back({test.name, test.held_out, stage, std::sqrt(std::max(0.0, beyond)), std::nullopt});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  return all;
}

std::optional<FitFailure> rank_by_explanation(const datasets::Study& study, const Candidate& base,
                                              const Candidate& explanation,
                                              const std::vector<calibration::ExperimentWeights>& weights,
                                              int threads, std::vector<Disagreement>& places) {
  const std::vector<double> x = matched(base.fit.result.coordinates, explanation.fit.result.coordinates,
                                        explanation.fit.result.main.coordinates);
  const auto linear = LinearModel::of(study, base, weights, x, threads);
  if (!linear) return linear.error();
  const auto with = calibration::problem_of(study, explanation.fit, explanation.free, threads)
                        .predictions(explanation.fit.result.main.coordinates);
  if (!with) return FitFailure{with.error().message};
  std::vector<Linearisation> changes;
  for (std::size_t i = 0; i < with->size(); ++i) {
    const experiments::Values& base_values = linear->predictions()[i].values;
    Linearisation change{base_values, Eigen::MatrixXd((*with)[i].values.size(), 1)};
    for (std::size_t k = 0; k < base_values.size(); ++k) {
      change.jacobian(static_cast<Eigen::Index>(k), 0) = (*with)[i].values[k] - base_values[k];
    }
    changes.push_back(std::move(change));
  }
  const auto left = linear->left_of(changes, Eigen::VectorXd::Ones(1));
  for (Disagreement& place : places) {
    std::size_t next = 0;
    for (const auto& experiment : base.fit.experiments) {
      if (experiment->held_out()) continue;
      const experiments::Values& values = left[next++];
      if (experiment->name() == place.test) place.explained = root_of_squares_in(place, *experiment, values);
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.explained > b.explained; });
  return std::nullopt;
}

}  // namespace isotach::discovery
