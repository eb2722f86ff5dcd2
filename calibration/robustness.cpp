// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/robustness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "calibration/parallel.hpp"
#include "calibration/uncertainty.hpp"

namespace isotach::calibration {

namespace {

/// One refit to be made.
struct Task {
  std::string what;
  Experiments experiments;
  model::Parameters<double> start;
  std::vector<ExperimentWeights> weights;
  std::shared_ptr<const experiments::OedometerExperiment> predicted;  ///< the test left out, if one is
};

Refit refit(const RefitBase& base, const Task& task) {
  Refit result;
  result.what = task.what;
  const auto& fitted_coordinates = base.problem.parametrisation().coordinates();
  Problem problem(task.experiments,
                  Parametrisation(task.start, base.wanted, base.settings,
                                  base.problem.parametrisation().gauge(), task.experiments),
                  1);
  problem.set_weights(task.weights);
  // coordinates of the fit by name: a test left out takes its own with it
  const auto& coordinates = problem.parametrisation().coordinates();
  std::vector<double> x;
  std::vector<std::size_t> from;
  for (const Coordinate& coordinate : coordinates) {
    const auto same = [&](const Coordinate& other) { return other.name == coordinate.name; };
    const auto found = std::find_if(fitted_coordinates.begin(), fitted_coordinates.end(), same);
    from.push_back(static_cast<std::size_t>(found - fitted_coordinates.begin()));
    x.push_back(base.answer[from.back()]);
  }
  const OptimiserResult found = minimise_with_ceres(problem, x, {}, base.control);
  const auto parameters = problem.parametrisation().at(found.coordinates);
  if (!std::isfinite(found.cost) || !parameters) {
    result.failure = parameters ? found.termination : parameters.error();
    return result;
  }
  result.parameters = *parameters;
  result.shift.assign(fitted_coordinates.size(), std::numeric_limits<double>::quiet_NaN());
  std::optional<Uncertainty> own;
  if (task.predicted) {
    if (auto found_uncertainty = estimate_uncertainty(problem, found.coordinates, Correlation::whitened)) {
      own = std::move(*found_uncertainty);
    }
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(from[k]);
    if (base.uncertainty.in_null_direction(from[k])) continue;  // no error to measure it by
    double variance = base.uncertainty.covariance(i, i);
    if (task.predicted) {
      if (!own || own->in_null_direction(k)) continue;
      const auto row = static_cast<Eigen::Index>(k);
      // below a tenth of it the difference of two estimates of variance means nothing
      variance = std::max(own->covariance(row, row) - variance, 0.1 * own->covariance(row, row));
    }
    result.shift[from[k]] = (found.coordinates[k] - base.answer[from[k]]) / std::sqrt(variance);
  }
  experiments::Values scaled;
  if (task.predicted) {
    const auto values = task.predicted->predict(
        *parameters, problem.parametrisation().local_of(*task.predicted, found.coordinates));
    if (!values) {
      result.failure = values.error().message;
      return result;
    }
    scaled = task.predicted->scaled_residuals(*values);
  } else if (const auto evaluation = problem.evaluate(found.coordinates)) {
    for (const auto& part : evaluation->scaled_residuals)
      scaled.insert(scaled.end(), part.begin(), part.end());
  }
  result.rms_over_noise = experiments::root_mean_square(scaled);
  return result;
}

std::vector<Refit> run(const RefitBase& base, const std::vector<Task>& tasks) {
  std::vector<Refit> results(tasks.size());
  parallel_for(tasks.size(), base.threads, [&](std::size_t i) { results[i] = refit(base, tasks[i]); });
  return results;
}

std::optional<Task> changed(const RefitBase& base, std::string what,
                            const std::function<bool(datasets::OedometerTest&)>& change) {
  Task task{std::move(what), {}, *base.problem.parametrisation().at(base.answer), base.weights, nullptr};
  bool any = false;
  for (const auto& experiment : base.experiments) {
    datasets::OedometerTest test = experiment->test();
    any = change(test) || any;
    task.experiments.push_back(std::make_shared<experiments::OedometerExperiment>(
        std::move(test), experiment->effects(), experiment->free_effects()));
  }
  if (!any) return std::nullopt;
  return task;
}

}  // namespace

std::vector<Refit> leave_one_out(const RefitBase& base) {
  std::vector<Task> tasks;
  std::size_t fitted = 0;
  for (const auto& experiment : base.experiments) {
    if (experiment->held_out()) continue;
    Task task{
        "without " + experiment->name(), {}, *base.problem.parametrisation().at(base.answer), {}, experiment};
    std::size_t k = 0;
    for (const auto& other : base.experiments) {
      if (other->held_out()) continue;
      if (other != experiment) {
        task.experiments.push_back(other);
        if (!base.weights.empty()) task.weights.push_back(base.weights[k]);
      }
      ++k;
    }
    ++fitted;
    tasks.push_back(std::move(task));
  }
  if (fitted < 2) return {};
  return run(base, tasks);
}

std::vector<Refit> shift_inputs(const RefitBase& base) {
  constexpr double kPhi = 2.0 * std::numbers::pi / 180.0;
  constexpr double kK0 = 0.1;
  constexpr double kSpecificGravity = 0.05;
  std::vector<Task> tasks;
  const auto moves = [&](model::ParameterId id) {
    return std::find(base.wanted.begin(), base.wanted.end(), id) != base.wanted.end();
  };
  for (const double sign : {-1.0, 1.0}) {
    const char* const way = sign < 0.0 ? "-" : "+";
    if (!moves(model::ParameterId::phi_c)) {
      const model::Parameters<double> start = *base.problem.parametrisation().at(base.answer);
      model::ParameterValues<double> values = start.values();
      values[model::ParameterId::phi_c] += sign * kPhi;
      if (const auto admissible = model::Parameters<double>::create(values)) {
        Task task{fmt::format("phi_c {} 2 deg", way), {}, *admissible, base.weights, nullptr};
        task.experiments.assign(base.experiments.begin(), base.experiments.end());
        tasks.push_back(std::move(task));
      }
    }
    auto K0 =
        changed(base, fmt::format("K0 at the start {} {}", way, kK0), [&](datasets::OedometerTest& test) {
          const double shifted = test.initial_K0 + sign * kK0;
          if (test.free_K0.moves || test.K0_rule == datasets::InitialK0::steady || !(shifted > 0.0))
            return false;
          test.initial_K0 = shifted;
          return true;
        });
    if (K0) tasks.push_back(std::move(*K0));
    auto gravity =
        changed(base, fmt::format("G_s {} {}", way, kSpecificGravity), [&](datasets::OedometerTest& test) {
          if (!test.void_ratio_per_specific_gravity) return false;
          test.void_ratio += sign * kSpecificGravity * *test.void_ratio_per_specific_gravity;
          return test.void_ratio > 0.0;
        });
    if (gravity) tasks.push_back(std::move(*gravity));
  }
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const Task& a, const Task& b) { return a.what.substr(0, 3) < b.what.substr(0, 3); });
  return run(base, tasks);
}

}  // namespace isotach::calibration
