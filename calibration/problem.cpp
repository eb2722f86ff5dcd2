// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/problem.hpp"

#include <numeric>

#include "calibration/parallel.hpp"

namespace isotach::calibration {

namespace {

/// Runs f(i) for all experiments in parallel and returns the results, or the first failure in their order.
template <class Result, class F>
tl::expected<std::vector<Result>, experiments::PredictionFailure> for_all(std::size_t count, int threads,
                                                                          F&& f) {
  std::vector<tl::expected<Result, experiments::PredictionFailure>> results(count);
  parallel_for(count, threads, [&](std::size_t i) { results[i] = f(i); });
  std::vector<Result> values;
  values.reserve(count);
  for (auto& result : results) {
    if (!result) return tl::unexpected(result.error());
    values.push_back(std::move(*result));
  }
  return values;
}

}  // namespace

double Evaluation::cost() const {
  double sum = 0.0;
  for (const auto& residuals : scaled_residuals) {
    sum += std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
  }
  return 0.5 * sum;
}

tl::expected<Evaluation, experiments::PredictionFailure> evaluate_all(
    const Experiments& experiments, const model::Parameters<double>& parameters, int threads) {
  auto all = for_all<experiments::Values>(
      experiments.size(), threads,
      [&](std::size_t i) -> tl::expected<experiments::Values, experiments::PredictionFailure> {
        const auto values = experiments[i]->predict(parameters);
        if (!values) return tl::unexpected(values.error());
        return experiments[i]->scaled_residuals(*values);
      });
  if (!all) return tl::unexpected(all.error());
  return Evaluation{std::move(*all)};
}

Problem::Problem(const Experiments& experiments, Parametrisation parametrisation, int threads)
    : parametrisation_(std::move(parametrisation)), threads_(threads) {
  for (const auto& experiment : experiments) {
    if (experiment->held_out()) continue;
    fitted_.push_back(experiment);
    residual_count_ += experiment->measured().size();
  }
}

tl::expected<Evaluation, experiments::PredictionFailure> Problem::evaluate(
    const std::vector<double>& x) const {
  const auto parameters = parametrisation_.at(x);
  if (!parameters) return tl::unexpected(experiments::PredictionFailure{parameters.error()});
  return evaluate_all(fitted_, *parameters, threads_);
}

tl::expected<Linearised, experiments::PredictionFailure> Problem::linearise(
    const std::vector<double>& x) const {
  const auto tangent = parametrisation_.tangent(x);
  if (!tangent) return tl::unexpected(experiments::PredictionFailure{tangent.error()});
  // the gauge makes D_r move along with the coordinates
  std::vector<model::ParameterId> moving = parametrisation_.free();
  if (parametrisation_.gauged()) moving.push_back(model::ParameterId::D_r);
  Eigen::MatrixXd chain(static_cast<Eigen::Index>(moving.size()), tangent->derivative.cols());
  for (std::size_t k = 0; k < moving.size(); ++k) {
    chain.row(static_cast<Eigen::Index>(k)) = tangent->derivative.row(static_cast<Eigen::Index>(moving[k]));
  }

  const auto all = for_all<experiments::Linearisation>(fitted_.size(), threads_, [&](std::size_t i) {
    return fitted_[i]->linearise(tangent->parameters, moving);
  });
  if (!all) return tl::unexpected(all.error());

  Linearised result;
  result.residuals.resize(static_cast<Eigen::Index>(residual_count_));
  result.jacobian.resize(static_cast<Eigen::Index>(residual_count_), chain.cols());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < fitted_.size(); ++i) {
    const experiments::Values residuals = fitted_[i]->scaled_residuals((*all)[i].values);
    const Eigen::MatrixXd jacobian = (*all)[i].jacobian * chain;
    for (std::size_t k = 0; k < residuals.size(); ++k, ++row) {
      result.residuals[row] = residuals[k];
      result.jacobian.row(row) = jacobian.row(static_cast<Eigen::Index>(k)) / fitted_[i]->noise()[k];
    }
  }
  return result;
}

}  // namespace isotach::calibration
