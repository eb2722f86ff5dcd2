// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What is drawn of a test, gathered from a fit.
#include "reports/oedometer_view.hpp"

#include <algorithm>
#include <cmath>

#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;
using experiments::kNoRow;
using experiments::OedometerExperiment;
using experiments::PathPoint;

constexpr int kMostIsotachs = 7;

/// Whitened residuals of the fitted test `fitted`, in the order of its values.
experiments::Values whitened(const OedometerFit& fit, std::size_t i, std::size_t fitted) {
  if (fitted >= fit.noise.weights.size()) return {};
  const experiments::Values& scaled = fit.evaluation.scaled_residuals[i];
  const experiments::Values& noise = fit.experiments[i]->noise();
  experiments::Values result(scaled.size());
  for (const calibration::ChannelWeights& channel : fit.noise.weights[fitted]) {
    Eigen::MatrixXd residuals(static_cast<Eigen::Index>(channel.values.size()), 1);
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      const std::size_t value = channel.values[k];
      residuals(static_cast<Eigen::Index>(k), 0) = scaled[value] * noise[value];
    }
    channel.whitening.whiten(residuals);
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      result[channel.values[k]] = residuals(static_cast<Eigen::Index>(k), 0);
    }
  }
  return result;
}

/// Axial strain rates (1/s) that a test shows on its way: of loading from reading to reading, and at the end
/// of each load step. As the model followed it, so that reading noise makes none.
std::vector<double> rates_of(const TestView& view) {
  std::vector<double> rates;
  const auto& record = view.experiment.test().record;
  const auto add = [&](const PathPoint& before, const PathPoint& after) {
    const double rate =
        std::log((1.0 - before.axial_strain) / (1.0 - after.axial_strain)) / (after.time - before.time);
    if (rate > 0.0 && std::isfinite(rate)) rates.push_back(rate);
  };
  for (std::size_t i = 1; i < view.path.size(); ++i) {
    const PathPoint& point = view.path[i];
    if (point.row == kNoRow || record.rows[point.row].stage != datasets::Stage::load) continue;
    if (view.stepwise()) {
      const bool ends = std::any_of(record.steps.begin(), record.steps.end(), [&](const auto& step) {
        return step.first + step.count == point.row + 1;
      });
      if (!ends) continue;
    }
    add(view.path[i - 1], point);
  }
  return rates;
}

std::vector<integrators::Isotach> isotachs_through(const TestView& view,
                                                   const model::Parameters<double>& parameters) {
  std::vector<double> rates = rates_of(view);
  if (rates.empty()) return {};
  std::sort(rates.begin(), rates.end());
  // a few odd intervals between readings set no scale
  const auto at = [&](double share) {
    return rates[static_cast<std::size_t>(share * static_cast<double>(rates.size() - 1))];
  };
  const int fastest = static_cast<int>(std::ceil(std::log10(at(0.95)) - 1e-9));
  int slowest =
      static_cast<int>(std::floor(std::log10(at(0.05)) + 1e-9)) - 1;  // where creep and relaxation go
  slowest = std::max(slowest, fastest - kMostIsotachs + 1);
  std::vector<integrators::Isotach> isotachs;
  for (int decade = slowest; decade <= fastest; ++decade) {
    auto isotach = integrators::Isotach::create(parameters, std::pow(10.0, decade));
    if (isotach) isotachs.push_back(std::move(*isotach));
  }
  return isotachs;
}

}  // namespace

std::vector<TestView> views_of(const OedometerFit& fit) {
  std::vector<TestView> views;
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    const OedometerExperiment& experiment = *fit.experiments[i];
    TestView view{.experiment = experiment,
                  .summary = fit.result.tests[i],
                  .scaled = fit.evaluation.scaled_residuals[i],
                  .white = experiment.held_out() ? experiments::Values{} : whitened(fit, i, fitted),
                  .path = {},
                  .isotachs = {}};
    if (!experiment.held_out()) ++fitted;
    auto path = experiment.path(*fit.result.parameters, fit.locals[i], experiments::Route::fellin_ostermann);
    if (path && !path->empty()) {
      view.path = std::move(*path);
      view.drawn_over_law = (1.0 + view.void_ratio_of_strain(view.path.front().axial_strain)) /
                            (1.0 + view.path.front().void_ratio);
    }
    view.isotachs = isotachs_through(view, *fit.result.parameters);
    views.push_back(std::move(view));
  }
  return views;
}

CompressionCurve measured_curve(const TestView& view) {
  const datasets::OedometerRecord& record = view.experiment.test().record;
  CompressionCurve curve;
  const auto add = [&](const datasets::OedometerRow& row) {
    curve.stress.push_back(kPerPascal * row.axial_stress);
    curve.void_ratio.push_back(view.experiment.void_ratio_of(row));
  };
  if (!view.stepwise()) {
    for (const datasets::OedometerRow& row : record.rows) add(row);
    return curve;
  }
  for (const datasets::LoadStep& step : record.steps) add(record.rows[step.first + step.count - 1]);
  return curve;
}

CompressionCurve model_curve(const TestView& view) {
  const auto& steps = view.experiment.test().record.steps;
  CompressionCurve curve;
  for (std::size_t i = 0; i < view.path.size(); ++i) {
    const PathPoint& point = view.path[i];
    const auto ends = [&](const datasets::LoadStep& step) {
      return step.first + step.count == point.row + 1;
    };
    const bool shown =
        i == 0 || !view.stepwise() || (point.row != kNoRow && std::any_of(steps.begin(), steps.end(), ends));
    if (!shown) continue;
    curve.stress.push_back(kPerPascal * point.axial_stress);
    curve.void_ratio.push_back(view.void_ratio_of_strain(point.axial_strain));
  }
  return curve;
}

}  // namespace isotach::reports
