// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/oedometer_wandering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration/parallel.hpp"
#include "discovery/limits.hpp"
#include "discovery/linear_model.hpp"

namespace isotach::discovery {

namespace {

using calibration::FitFailure;
using experiments::Linearisation;
using experiments::OedometerExperiment;
using experiments::Slot;
using experiments::Values;

/// A fitted test of the model.
struct Fitted {
  const OedometerExperiment* experiment;
  const std::vector<double>* local;
  Values predicted;
};

std::vector<Fitted> fitted_of(const Candidate& model, const LinearModel& linear) {
  std::vector<Fitted> tests;
  for (std::size_t i = 0; i < model.fit.experiments.size(); ++i) {
    if (model.fit.experiments[i]->held_out()) continue;
    tests.push_back(
        {model.fit.experiments[i].get(), &model.fit.locals[i], linear.predictions()[tests.size()].values});
  }
  return tests;
}

/// The variable that a slot wanders over, at the start and at the end of each step. Stress is the model's
/// where it is compared: a function of what was read would bend to the noise of the readings.
std::vector<double> variable_of(const Fitted& test, const WanderAxis& along) {
  const auto& protocol = test.experiment->protocol();
  double time = protocol.start.time;
  double log_stress = std::log(protocol.start.axial_stress);
  std::vector<double> all{&along == &kOverTime ? time : log_stress};
  std::size_t next = 0;
  for (std::size_t i = 0; i < protocol.steps.size(); ++i) {
    time += protocol.steps[i].duration;
    while (next < protocol.values.size() && protocol.values[next].step < i) ++next;
    if (next < protocol.values.size() && protocol.values[next].step == i &&
        protocol.values[next].kind == experiments::ValueKind::log_stress) {
      log_stress = test.predicted[next];
    } else if (protocol.steps[i].stress_controlled) {
      log_stress = std::log(protocol.steps[i].amount);
    }
    all.push_back(&along == &kOverTime ? time : log_stress);
  }
  return all;
}

/// Knots between which as many readings lie each; no two alike.
std::vector<double> knots_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> knots;
  for (std::size_t k = 0; k < kWanderKnots; ++k) {
    const double value = values[k * (values.size() - 1) / (kWanderKnots - 1)];
    if (knots.empty() || value > knots.back()) knots.push_back(value);
  }
  return knots;
}

/// The knots' hats, a column each, at values of the variable.
Eigen::MatrixXd hats(const std::vector<double>& knots, const std::vector<double>& values) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(values.size()),
                                              static_cast<Eigen::Index>(knots.size()));
  if (knots.size() == 1) return all.setOnes();  // of a variable that stays
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double value = std::clamp(values[i], knots.front(), knots.back());
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, value);
    const auto k = static_cast<Eigen::Index>(above - knots.begin());
    const double from = *(above - 1);
    const double share = (value - from) / (*above - from);
    all(row, k - 1) = 1.0 - share;
    all(row, k) = share;
  }
  return all;
}

/// A variable's knots, of each test or of all, and the hats of each test among all columns.
struct Functions {
  const WanderAxis* along;
  std::vector<std::vector<double>> knots;
  std::vector<Eigen::MatrixXd> of_test;
};

Functions functions_of(const std::vector<Fitted>& tests, const WanderAxis& along) {
  Functions found{&along, {}, {}};
  std::vector<std::vector<double>> values;
  std::vector<double> pooled;
  for (const Fitted& test : tests) {
    values.push_back(variable_of(test, along));
    pooled.insert(pooled.end(), values.back().begin(), values.back().end());
  }
  if (&along == &kOverStress) {
    found.knots.push_back(knots_of(pooled));
    for (const auto& one : values) found.of_test.push_back(hats(found.knots.front(), one));
    return found;
  }
  Eigen::Index columns = 0;
  for (const auto& one : values) {
    found.knots.push_back(knots_of(one));
    columns += static_cast<Eigen::Index>(found.knots.back().size());
  }
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Eigen::MatrixXd own = hats(found.knots[i], values[i]);
    found.of_test.emplace_back(Eigen::MatrixXd::Zero(own.rows(), columns));
    found.of_test.back().middleCols(first, own.cols()) = own;
    first += own.cols();
  }
  return found;
}

std::vector<WanderCurve> curves_of(const Functions& functions, const std::vector<Fitted>& tests,
                                   const Eigen::VectorXd& change, const Eigen::VectorXd& std_error) {
  std::vector<WanderCurve> curves;
  Eigen::Index next = 0;
  for (std::size_t c = 0; c < functions.knots.size(); ++c) {
    WanderCurve curve;
    if (functions.along == &kOverTime) curve.test = tests[c].experiment->name();
    for (const double knot : functions.knots[c]) {
      curve.at.push_back(functions.along == &kOverTime ? knot : std::exp(knot));
      curve.change.push_back(change[next]);
      curve.std_error.push_back(std_error[next++]);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

tl::expected<WanderTrial, FitFailure> let_wander(const Candidate& model, const LinearModel& linear, Slot slot,
                                                 const Functions& functions, const std::vector<Fitted>& tests,
                                                 int threads) {
  using Result = tl::expected<Linearisation, experiments::PredictionFailure>;
  std::vector<Result> results(tests.size());
  calibration::parallel_for(tests.size(), threads, [&](std::size_t i) {
    results[i] = tests[i].experiment->linearise_wander(*model.fit.result.parameters, *tests[i].local, slot,
                                                       functions.of_test[i]);
  });
  std::vector<Linearisation> changes;
  for (Result& result : results) {
    if (!result) return tl::unexpected(FitFailure{result.error().message});
    changes.push_back(std::move(*result));
  }
  const double plausible = info_of(slot).plausible;
  Eigen::MatrixXd left = linear.weighted(changes) * plausible;
  if (!left.allFinite()) {
    return tl::unexpected(FitFailure{
        fmt::format("derivatives by a {} that wanders are not finite", experiments::info_of(slot).name)});
  }
  for (Eigen::Index k = 0; k < left.cols(); ++k) left.col(k) = linear.parameters().freed(left.col(k));
  WanderTrial trial =
      try_slot({experiments::info_of(slot).name, functions.along, info_of(slot).logarithmic, "1e-3", 1e-3},
               left, plausible, linear.residuals());
  trial.slot.curves = curves_of(functions, tests, trial.change, trial.std_error);
  trial.slot.change = linear.left_of(changes, trial.change);
  return trial;
}

}  // namespace

tl::expected<Wandering, FitFailure> let_wander(const datasets::Study& study, const Candidate& model,
                                               const std::vector<calibration::ExperimentWeights>& weights,
                                               int threads) {
  const auto linear = LinearModel::of(study, model, weights, model.fit.result.main.coordinates, threads);
  if (!linear) return tl::unexpected(linear.error());
  const std::vector<Fitted> tests = fitted_of(model, *linear);
  std::vector<WanderTrial> trials;
  for (const WanderAxis* along : {&kOverTime, &kOverStress}) {
    const Functions functions = functions_of(tests, *along);
    for (const Slot slot : experiments::kSlots) {
      auto one = let_wander(model, *linear, slot, functions, tests, threads);
      if (!one) return tl::unexpected(one.error());
      trials.push_back(std::move(*one));
    }
  }
  return ranked(std::move(trials));
}

}  // namespace isotach::discovery
