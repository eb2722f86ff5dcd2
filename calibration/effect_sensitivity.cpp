// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/effect_sensitivity.hpp"

#include <stdexcept>

#include "calibration/parallel.hpp"

namespace isotach::calibration {

Problem problem_of(const datasets::Study& study, const OedometerFit& fit,
                   const std::vector<datasets::FreeEffect>& free_effects, int threads) {
  const Experiments experiments(fit.experiments.begin(), fit.experiments.end());
  std::vector<model::ParameterId> wanted = fit.result.free;
  if (fit.result.gauged) wanted.push_back(model::ParameterId::D_r);
  const CoordinateSettings settings{study.fit.bounds, study.fit.priors, free_effects};
  Problem problem(experiments,
                  Parametrisation(*fit.result.parameters, wanted, settings, fit.result.gauge, experiments),
                  threads);
  problem.set_weights(fit.noise.weights);
  return problem;
}

tl::expected<std::vector<experiments::Linearisation>, experiments::PredictionFailure> linearise_by_effects(
    const OedometerExperiments& experiments, const model::Parameters<double>& parameters,
    const std::vector<std::vector<double>>& locals, const effects::Values<double>& on,
    std::span<const effects::ParameterRef> by, int threads) {
  using Result = tl::expected<experiments::Linearisation, experiments::PredictionFailure>;
  std::vector<Result> results(experiments.size());
  parallel_for(experiments.size(), threads, [&](std::size_t i) {
    const experiments::OedometerExperiment& fitted = *experiments[i];
    try {
      const experiments::OedometerExperiment with(fitted.test(), on, {by.begin(), by.end()});
      std::vector<double> local = locals[i];
      local.resize(local.size() - fitted.free_effects().size());
      const auto own = static_cast<Eigen::Index>(model::kParameterCount + local.size());
      for (const effects::ParameterRef& parameter : by) local.push_back(on[parameter]);
      const auto count = static_cast<Eigen::Index>(by.size());
      Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(own + count, count);
      directions.bottomRows(count).setIdentity();
      results[i] = with.linearise(parameters, local, directions);
    } catch (const std::invalid_argument& error) {  // an effect that this test cannot have
      results[i] = tl::unexpected(experiments::PredictionFailure{error.what()});
    }
  });
  std::vector<experiments::Linearisation> all;
  for (Result& result : results) {
    if (!result) return tl::unexpected(result.error());
    all.push_back(std::move(*result));
  }
  return all;
}

}  // namespace isotach::calibration
