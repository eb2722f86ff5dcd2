// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/candidate.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/optimisers.hpp"
#include "discovery/limits.hpp"

namespace isotach::discovery {

namespace {

/// Whether the tests that are fitted can be predicted.
bool predicts(const datasets::Study& study, const model::Parameters<double>& parameters,
              const effects::Values<double>& on) {
  return std::all_of(study.oedometer_tests.begin(), study.oedometer_tests.end(), [&](const auto& test) {
    if (test.hold_out) return true;
    const experiments::OedometerExperiment experiment(test, on);
    return experiment.predict(parameters, experiment.local_values()).has_value();
  });
}

/// `base` with the effects added at their typical amplitudes, or at so small ones that the tests can be
/// predicted: what is typical of one soil may leave another's readings without any stress.
tl::expected<effects::Values<double>, calibration::FitFailure> starting_values(
    const datasets::Study& study, const model::Parameters<double>& start, const effects::Values<double>& base,
    const std::vector<const effects::Effect*>& added) {
  constexpr int kTries = 8;
  constexpr double kSmaller = 0.25;
  double share = 1.0;
  for (int k = 0;; ++k, share *= kSmaller) {
    effects::Values<double> values = base;
    for (const effects::Effect* effect : added) {
      auto on = values.with(effects::with_amplitude(*effect, share * effect->parameters[0].typical_si()));
      if (!on) return tl::unexpected(calibration::FitFailure{on.error().message()});
      values = std::move(*on);
    }
    if (added.empty() || k == kTries || predicts(study, start, values)) return values;
  }
}

/// Constants of the material that the data would take beyond their bounds: released, each would gain at least
/// kBeyondBound of chi-squared, to first order.
std::vector<std::string> beyond_bounds(const datasets::Study& study, const Candidate& candidate,
                                       int threads) {
  const calibration::FitResult& result = candidate.fit.result;
  const calibration::Problem problem = calibration::problem_of(study, candidate.fit, candidate.free, threads);
  const std::vector<double>& x = result.main.coordinates;
  std::vector<std::size_t> there;
  for (std::size_t k = 0; k < result.free.size(); ++k) {
    if (problem.parametrisation().at_bound(x, k)) there.push_back(k);
  }
  std::vector<std::string> names;
  if (there.empty()) return names;
  const auto at = problem.linearise(x);
  if (!at) return names;
  const Eigen::VectorXd gradient = at->jacobian.transpose() * at->residuals;
  for (const std::size_t k : there) {
    const auto i = static_cast<Eigen::Index>(k);
    const double gain = gradient[i] * gradient[i] * candidate.fit.white_covariance(i, i);
    if (gain >= kBeyondBound) names.push_back(result.coordinates[k].name);
  }
  return names;
}

}  // namespace

std::string name_of(const std::vector<const effects::Effect*>& added) {
  std::string name;
  for (const effects::Effect* effect : added) {
    if (!name.empty()) name += ", ";
    name += effect->name;
  }
  return name.empty() ? "base" : name;
}

Gap gap_of(const calibration::OedometerFit& fit) {
  double squares[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    const std::size_t k = fit.experiments[i]->held_out() ? 1 : 0;
    for (const double r : fit.evaluation.scaled_residuals[i]) {
      squares[k] += r * r;
      counts[k] += 1.0;
    }
  }
  return {std::sqrt(squares[0] / counts[0]), std::sqrt(squares[1] / counts[1])};
}

std::optional<std::string> lacks(const datasets::Study& study, const effects::Effect& effect) {
  for (const datasets::OedometerTest& test : study.oedometer_tests) {
    try {
      const experiments::OedometerExperiment tried(
          test, *effects::Values<double>::create({effects::with_amplitude(effect, 0.0)}), {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }
  return std::nullopt;
}

tl::expected<Candidate, calibration::FitFailure> fit_with(const datasets::Study& study,
                                                          const model::Parameters<double>& start,
                                                          const std::vector<const effects::Effect*>& added,
                                                          const calibration::OedometerFitOptions& options) {
  Candidate candidate;
  candidate.added = added;
  calibration::FittedEffects with{study.effects, study.fit.oedometer_effects};
  auto on = starting_values(study, start, study.effects, added);
  if (!on) return tl::unexpected(on.error());
  with.on = std::move(*on);
  for (const effects::Effect* effect : added) {
    for (std::size_t k = 0; k < effect->parameters.size(); ++k) {
      if (effect->parameters[k].searched()) with.free.push_back({{effect, k}, std::nullopt});
    }
  }
  auto fit = calibration::fit_oedometer(study, start, study.fit.oedometer, with, options);
  if (!fit && !fit.error().interrupted) {
    datasets::Study fitted = study;
    std::erase_if(fitted.oedometer_tests, [](const auto& test) { return test.hold_out; });
    if (fitted.oedometer_tests.size() < study.oedometer_tests.size()) {
      fit = calibration::fit_oedometer(fitted, start, study.fit.oedometer, with, options);
    }
  }
  if (!fit) return tl::unexpected(fit.error());
  candidate.fit = std::move(*fit);
  candidate.free = with.free;
  for (const effects::Effect* effect : added) {
    const double amplitude = candidate.fit.effects[effects::ParameterRef{effect, 0}];
    const effects::EffectParameter& info = effect->parameters[0];
    const double near = 1e-3 * info.typical_si();
    if (std::abs(amplitude) < near || amplitude > info.upper_si() - near ||
        amplitude < info.lower_si() + near) {
      candidate.at_bound = true;
    }
  }
  candidate.beyond_bounds = beyond_bounds(study, candidate, options.threads);
  return candidate;
}

void weigh_alike(const datasets::Study& study, std::vector<Candidate*> candidates, int threads) {
  const auto best = std::min_element(candidates.begin(), candidates.end(), [](auto* a, auto* b) {
    return gap_of(a->fit).fitted < gap_of(b->fit).fitted;
  });
  for (Candidate* candidate : candidates) {
    calibration::Problem problem = calibration::problem_of(study, candidate->fit, candidate->free, threads);
    problem.set_weights((*best)->fit.noise.weights);
    const auto found =
        calibration::minimise_with_ceres(problem, candidate->fit.result.main.coordinates, {}, {});
    candidate->chi_squared = 2.0 * found.cost;
    candidate->bic = candidate->chi_squared + static_cast<double>(problem.parametrisation().size()) *
                                                  std::log(static_cast<double>(problem.value_count()));
    std::size_t shapes = 0;
    for (const datasets::FreeEffect& one : candidate->free) {
      const auto& added = candidate->added;
      if (one.parameter.index == 0) continue;
      if (std::find(added.begin(), added.end(), one.parameter.effect) != added.end()) ++shapes;
    }
    candidate->bic_without_shapes =
        candidate->bic - static_cast<double>(shapes) * std::log(static_cast<double>(problem.value_count()));
  }
}

}  // namespace isotach::discovery
