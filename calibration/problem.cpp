// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "calibration/parallel.hpp"

namespace isotach::calibration {

namespace {

/// Runs f(i) for all experiments in parallel, the costly ones first, and returns the results, or the first
/// failure, in the order of the experiments.
template <class Result, class F>
tl::expected<std::vector<Result>, experiments::PredictionFailure> for_all(const Experiments& experiments,
                                                                          int threads, F&& f) {
  const std::vector<std::size_t> order = by_cost(experiments);
  std::vector<tl::expected<Result, experiments::PredictionFailure>> results(order.size());
  parallel_for(order.size(), threads, [&](std::size_t k) { results[order[k]] = f(order[k]); });
  std::vector<Result> values;
  values.reserve(order.size());
  for (auto& result : results) {
    if (!result) return tl::unexpected(result.error());
    values.push_back(std::move(*result));
  }
  return values;
}

/// A derivative by a coordinate beyond it is no derivative: substeps that follow the values through a start
/// far beyond yield may still blow up what goes along with them.
constexpr double kLargestDerivative = 1e12;

/// Where a prediction is not a number or a derivative of it is of no use, if one is not.
std::optional<experiments::PredictionFailure> useless(const experiments::Linearisation& at,
                                                      const experiments::Experiment& experiment,
                                                      const std::vector<Coordinate>& coordinates) {
  const auto failure = [&](std::size_t value, const std::string& what, double number) {
    return experiments::PredictionFailure{fmt::format("{}: {} of value {} of {} is {:.3g}", experiment.name(),
                                                      what, value + 1, at.values.size(), number)};
  };
  for (std::size_t i = 0; i < at.values.size(); ++i) {
    if (!std::isfinite(at.values[i])) return failure(i, "the prediction", at.values[i]);
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      const double slope = at.jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
      if (!(std::abs(slope) <= kLargestDerivative)) {
        return failure(i, "the derivative by " + coordinates[k].name, slope);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::size_t> by_cost(const Experiments& experiments) {
  std::vector<std::size_t> order(experiments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return experiments[a]->cost() > experiments[b]->cost();
  });
  return order;
}

tl::expected<Evaluation, experiments::PredictionFailure> evaluate_all(
    const Experiments& experiments, const model::Parameters<double>& parameters,
    const std::vector<std::vector<double>>& locals, int threads) {
  auto all = for_all<experiments::Values>(
      experiments, threads,
      [&](std::size_t i) -> tl::expected<experiments::Values, experiments::PredictionFailure> {
        const auto values =
            experiments[i]->predict(parameters, locals.empty() ? experiments[i]->local_values() : locals[i]);
        if (!values) return tl::unexpected(values.error());
        return experiments[i]->scaled_residuals(*values);
      });
  if (!all) return tl::unexpected(all.error());
  return Evaluation{std::move(*all)};
}

Problem::Problem(const Experiments& experiments, Parametrisation parametrisation, int threads)
    : parametrisation_(std::move(parametrisation)), threads_(threads) {
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (experiments[i]->held_out()) continue;
    fitted_.push_back(experiments[i]);
    index_.push_back(i);
    value_count_ += experiments[i]->measured().size();
  }
  for (std::size_t k = 0; k < parametrisation_.size(); ++k) {
    if (parametrisation_.coordinates()[k].prior) priors_.push_back(k);
  }
}

tl::expected<Evaluation, experiments::PredictionFailure> Problem::evaluate(
    const std::vector<double>& x) const {
  const auto parameters = parametrisation_.at(x);
  if (!parameters) return tl::unexpected(experiments::PredictionFailure{parameters.error()});
  std::vector<std::vector<double>> locals;
  for (const std::size_t i : index_) locals.push_back(parametrisation_.local_at(x, i));
  return evaluate_all(fitted_, *parameters, locals, threads_);
}

tl::expected<Eigen::VectorXd, experiments::PredictionFailure> Problem::residuals(
    const std::vector<double>& x) const {
  const auto evaluation = evaluate(x);
  if (!evaluation) return tl::unexpected(evaluation.error());
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(residual_count()));
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < fitted_.size(); ++i) {
    const auto& scaled = evaluation->scaled_residuals[i];
    const auto count = static_cast<Eigen::Index>(scaled.size());
    auto block = residuals.segment(row, count);
    block = Eigen::Map<const Eigen::VectorXd>(scaled.data(), count);
    if (!weights_.empty()) {
      block.array() *= Eigen::Map<const Eigen::ArrayXd>(fitted_[i]->noise().data(), count);
      weigh(i, block);
    }
    row += count;
  }
  residuals = common_.whitened(std::move(residuals));
  append_priors(x, residuals, nullptr);
  return residuals;
}

tl::expected<std::vector<experiments::Linearisation>, experiments::PredictionFailure> Problem::predictions(
    const std::vector<double>& x) const {
  const auto tangent = parametrisation_.tangent(x);
  if (!tangent) return tl::unexpected(experiments::PredictionFailure{tangent.error()});
  return for_all<experiments::Linearisation>(fitted_, threads_, [&](std::size_t i) {
    auto at = fitted_[i]->linearise(tangent->parameters, parametrisation_.local_at(x, index_[i]),
                                    parametrisation_.directions(*tangent, x, index_[i]));
    if (at) {
      if (auto failure = useless(*at, *fitted_[i], parametrisation_.coordinates()))
        at = tl::unexpected(*std::move(failure));
    }
    return at;
  });
}

Linearised Problem::weighted(const std::vector<experiments::Linearisation>& predictions) const {
  const Eigen::Index columns = predictions.empty() ? 0 : predictions.front().jacobian.cols();
  // residuals and derivatives are weighted alike, so they go together
  Eigen::MatrixXd both(static_cast<Eigen::Index>(value_count_), columns + 1);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < fitted_.size(); ++i) {
    const auto count = static_cast<Eigen::Index>(fitted_[i]->measured().size());
    auto block = both.middleRows(row, count);
    block.leftCols(columns) = predictions[i].jacobian;
    block.col(columns) = Eigen::Map<const Eigen::VectorXd>(predictions[i].values.data(), count) -
                         Eigen::Map<const Eigen::VectorXd>(fitted_[i]->measured().data(), count);
    if (weights_.empty()) {
      block.array().colwise() /= Eigen::Map<const Eigen::ArrayXd>(fitted_[i]->noise().data(), count);
    } else {
      weigh(i, block);
    }
    row += count;
  }
  both = common_.whitened(std::move(both));
  return {both.col(columns), both.leftCols(columns)};
}

tl::expected<Linearised, experiments::PredictionFailure> Problem::linearise(
    const std::vector<double>& x) const {
  const auto all = predictions(x);
  if (!all) return tl::unexpected(all.error());
  return linearised(x, *all);
}

Linearised Problem::linearised(const std::vector<double>& x,
                               const std::vector<experiments::Linearisation>& predictions) const {
  Linearised result = weighted(predictions);
  const auto rows = static_cast<Eigen::Index>(residual_count());
  result.residuals.conservativeResize(rows);
  result.jacobian.conservativeResize(rows, static_cast<Eigen::Index>(x.size()));
  append_priors(x, result.residuals, &result.jacobian);
  return result;
}

void Problem::weigh(std::size_t fitted, Eigen::Ref<Eigen::MatrixXd> block) const {
  Eigen::MatrixXd part;
  for (const ChannelWeights& channel : weights_[fitted]) {
    if (channel.values.size() == static_cast<std::size_t>(block.rows())) {
      channel.whitening.whiten(block);  // the only channel: its values are all, in order
      continue;
    }
    part.resize(static_cast<Eigen::Index>(channel.values.size()), block.cols());
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      part.row(static_cast<Eigen::Index>(i)) = block.row(static_cast<Eigen::Index>(channel.values[i]));
    }
    channel.whitening.whiten(part);
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      block.row(static_cast<Eigen::Index>(channel.values[i])) = part.row(static_cast<Eigen::Index>(i));
    }
  }
}

void Problem::append_priors(const std::vector<double>& x, Eigen::VectorXd& residuals,
                            Eigen::MatrixXd* jacobian) const {
  auto row = static_cast<Eigen::Index>(value_count_);
  for (const std::size_t k : priors_) {
    const CoordinatePrior& prior = *parametrisation_.coordinates()[k].prior;
    residuals[row] = (x[k] - prior.mean) / prior.std_error;
    if (jacobian != nullptr) {
      jacobian->row(row).setZero();
      (*jacobian)(row, static_cast<Eigen::Index>(k)) = 1.0 / prior.std_error;
    }
    ++row;
  }
}

}  // namespace isotach::calibration
