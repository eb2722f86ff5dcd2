// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/uncertainty.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "calibration/distributions.hpp"

namespace isotach::calibration {

namespace {

constexpr double kNullSingularValue = 1e-9;  // relative to the largest: no data see this direction
constexpr double kIdentified = 0.25;         // half width of the 95 % interval relative to the value
constexpr double kWeak = 1.0;
constexpr double kNullPart = 1e-6;  // of a unit null direction

/// Lag-1 autocorrelation of residuals, within each experiment, about zero.
double autocorrelation(const Eigen::VectorXd& residuals, const Experiments& experiments) {
  double products = 0.0;
  double squares = 0.0;
  Eigen::Index begin = 0;
  for (const auto& experiment : experiments) {
    const auto count = static_cast<Eigen::Index>(experiment->measured().size());
    for (Eigen::Index i = begin; i < begin + count; ++i) {
      squares += residuals[i] * residuals[i];
      if (i > begin) products += residuals[i] * residuals[i - 1];
    }
    begin += count;
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/// The residuals and Jacobian of one point, as ceres::Covariance wants to ask for them.
class Frozen final : public ceres::CostFunction {
 public:
  explicit Frozen(const Linearised& at) : at_(at) {
    set_num_residuals(static_cast<int>(at.residuals.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(at.jacobian.cols()));
  }
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = at_.residuals;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], at_.jacobian.rows(), at_.jacobian.cols()) = at_.jacobian;
    }
    return true;
  }

 private:
  const Linearised& at_;
};

/// The pseudo-inverse of J'J, or nothing where Ceres cannot form it.
std::optional<Eigen::MatrixXd> covariance_of(const Linearised& at, std::vector<double> x) {
  ceres::Problem problem;
  problem.AddResidualBlock(new Frozen(at), nullptr, x.data());
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = -1;  // as many directions as fall below the next line
  options.min_reciprocal_condition_number = kNullSingularValue * kNullSingularValue;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  const double* const block = x.data();
  const std::vector<std::pair<const double*, const double*>> blocks{{block, block}};
  if (!covariance.Compute(blocks, &problem)) return std::nullopt;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> result(at.jacobian.cols(),
                                                                                at.jacobian.cols());
  if (!covariance.GetCovarianceBlock(block, block, result.data())) return std::nullopt;
  return result;
}

/// Why a verdict was given, for a coordinate whose interval is known.
std::string words_for(Verdict verdict, const Coordinate& coordinate, double error, bool at_bound, bool null) {
  if (null) return "a change of others undoes its own exactly: no data of this kind can tell them apart";
  if (coordinate.prior && error > 0.7 * coordinate.prior->std_error) {
    return "it is what was known before: the data add little";
  }
  if (at_bound) return "its best value lies on its bound";
  switch (verdict) {
    case Verdict::identified:
      return "the data hold it";
    case Verdict::weak:
      return "the data hold it only loosely";
    case Verdict::undetermined:
      return "values over its whole range fit nearly as well";
    case Verdict::fixed:
    case Verdict::gauge:
      break;
  }
  return "";
}

/// What an interval in a coordinate means for its quantity.
struct Interval {
  double value, std_error, lower, upper;
  Verdict verdict;
  std::string words;
};

Interval interval_of(const Problem& problem, const std::vector<double>& x, const Uncertainty& uncertainty,
                     std::size_t k, std::optional<double> range) {
  const Parametrisation& parametrisation = problem.parametrisation();
  const Coordinate& coordinate = parametrisation.coordinates()[k];
  const auto i = static_cast<Eigen::Index>(k);
  const bool null = uncertainty.in_null_direction(k);
  const double error =
      null ? std::numeric_limits<double>::infinity() : std::sqrt(uncertainty.covariance(i, i));
  const double width = uncertainty.quantile() * error;
  Interval result{};
  result.value = coordinate.quantity(x[k]);
  result.std_error = coordinate.slope(x[k]) * error;
  result.lower = coordinate.quantity(std::max(x[k] - width, coordinate.lower));
  result.upper = coordinate.quantity(std::min(x[k] + width, coordinate.upper));
  const bool at_bound = parametrisation.at_bound(x, k);
  result.verdict =
      null ? Verdict::undetermined
           : judge(0.5 * (result.upper - result.lower), range.value_or(std::abs(result.value)), at_bound);
  result.words = words_for(result.verdict, coordinate, error, at_bound, null);
  return result;
}

}  // namespace

Verdict judge(double half_width, double range, bool at_bound) {
  const double relative = half_width / range;
  if (!(relative <= kWeak)) return Verdict::undetermined;
  if (relative > kIdentified || at_bound) return Verdict::weak;
  return Verdict::identified;
}

double range_of(model::ParameterId id, const model::Parameters<double>& parameters) {
  if (!model::may_be_zero(id)) return parameters[id];
  return 0.4 * (1.0 - parameters.kappa() / parameters.lambda());
}

double Uncertainty::quantile() const {
  return std::isfinite(degrees) ? student_t_quantile(0.975, degrees) : normal_quantile(0.975);
}

bool Uncertainty::in_null_direction(std::size_t coordinate) const {
  for (const Eigen::VectorXd& direction : null_directions) {
    if (std::abs(direction[static_cast<Eigen::Index>(coordinate)]) > kNullPart) return true;
  }
  return false;
}

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::identified:
      return "identified";
    case Verdict::weak:
      return "weak";
    case Verdict::undetermined:
      return "undetermined";
    case Verdict::fixed:
      return "fixed";
    case Verdict::gauge:
      return "gauge";
  }
  return "";
}

tl::expected<Uncertainty, experiments::PredictionFailure> estimate_uncertainty(const Problem& problem,
                                                                               const std::vector<double>& x,
                                                                               Correlation correlation) {
  const auto linearised = problem.linearise(x);
  if (!linearised) return tl::unexpected(linearised.error());
  // all of V: with fewer data than coordinates the rest of it spans what they do not see
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(linearised->jacobian, Eigen::ComputeFullV);
  const auto& singular = svd.singularValues();
  const Eigen::Index count = linearised->jacobian.cols();
  Uncertainty result;
  for (Eigen::Index k = 0; k < count; ++k) {
    const bool seen = k < singular.size() && singular[k] > kNullSingularValue * singular[0];
    if (!seen) result.null_directions.emplace_back(svd.matrixV().col(k));
  }
  auto covariance = covariance_of(*linearised, x);
  if (!covariance) {
    return tl::unexpected(
        experiments::PredictionFailure{"the covariance of the parameters cannot be formed"});
  }
  result.covariance = std::move(*covariance);
  if (correlation == Correlation::whitened) return result;
  const auto data = static_cast<double>(linearised->residuals.size());
  const double degrees = std::max(1.0, data - static_cast<double>(count));
  const double reduced = linearised->residuals.squaredNorm() / degrees;
  double inflation2 = std::max(1.0, reduced);
  if (correlation == Correlation::serial) {
    result.autocorrelation = std::clamp(autocorrelation(linearised->residuals, problem.fitted()), 0.0, 0.99);
    inflation2 *= (1.0 + result.autocorrelation) / (1.0 - result.autocorrelation);
  }
  result.inflation = std::sqrt(inflation2);
  result.covariance *= inflation2;
  return result;
}

std::vector<ParameterEstimate> estimate_parameters(const Problem& problem, const std::vector<double>& x,
                                                   const Uncertainty& uncertainty) {
  const Parametrisation& parametrisation = problem.parametrisation();
  const auto tangent = parametrisation.tangent(x);
  std::vector<ParameterEstimate> estimates;
  if (!tangent) return estimates;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const auto& parameter : model::kParameterTable) {
    estimates.push_back(
        {parameter.id, tangent->parameters[parameter.id], kNone, kNone, kNone, Verdict::fixed, {}});
  }
  const auto& free = parametrisation.free();
  for (std::size_t k = 0; k < free.size(); ++k) {
    const Interval interval = interval_of(problem, x, uncertainty, k, range_of(free[k], tangent->parameters));
    estimates[static_cast<std::size_t>(free[k])] = {free[k],        interval.value, interval.std_error,
                                                    interval.lower, interval.upper, interval.verdict,
                                                    interval.words};
  }
  if (parametrisation.gauged()) {
    // D_r follows from the others: its error by the chain rule
    ParameterEstimate& estimate = estimates[static_cast<std::size_t>(model::ParameterId::D_r)];
    const Eigen::RowVectorXd row =
        tangent->derivative.row(static_cast<Eigen::Index>(model::ParameterId::D_r));
    estimate.std_error = std::sqrt((row * uncertainty.covariance * row.transpose())(0, 0));
    estimate.ci95_lower = estimate.value - uncertainty.quantile() * estimate.std_error;
    estimate.ci95_upper = estimate.value + uncertainty.quantile() * estimate.std_error;
    estimate.verdict = Verdict::gauge;
    estimate.words = "it follows from the others by the gauge";
  }
  return estimates;
}

std::vector<LocalEstimate> estimate_locals(const Problem& problem, const std::vector<double>& x,
                                           const Uncertainty& uncertainty) {
  std::vector<LocalEstimate> estimates;
  const auto& coordinates = problem.parametrisation().coordinates();
  for (std::size_t k = problem.parametrisation().free().size(); k < coordinates.size(); ++k) {
    const Interval interval = interval_of(problem, x, uncertainty, k, std::nullopt);
    estimates.push_back({coordinates[k].name, interval.value, interval.std_error, interval.lower,
                         interval.upper, interval.verdict, interval.words, coordinates[k].effect,
                         coordinates[k].shared});
  }
  return estimates;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd correlation = covariance;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
      correlation(i, j) /= std::sqrt(covariance(i, i) * covariance(j, j));
    }
  }
  return correlation;
}

std::vector<TestSummary> summarise_tests(const Experiments& experiments, const Evaluation& evaluation) {
  std::vector<TestSummary> tests;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const auto& scaled = evaluation.scaled_residuals[i];
    experiments::Values plain(scaled.size());
    for (std::size_t k = 0; k < scaled.size(); ++k) plain[k] = scaled[k] * experiments[i]->noise()[k];
    tests.push_back({experiments[i]->name(), experiments[i]->held_out(), scaled.size(),
                     experiments::root_mean_square(plain), experiments::root_mean_square(scaled)});
  }
  return tests;
}

}  // namespace isotach::calibration
