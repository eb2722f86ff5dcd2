// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/joint_fit.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <tuple>

namespace isotach::calibration {

namespace {

constexpr double kErrors = 5.0;       // of the box beyond each answer, in that fit's standard errors
constexpr double kLeastLog = 0.01;    // of the box beyond each answer, of logarithms
constexpr double kLeastShare = 0.03;  // and of the range of other coordinates
constexpr std::size_t kPointsPerCoordinate = 6;  // near the answer a linear trend will do

bool has(const std::vector<model::ParameterId>& list, model::ParameterId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

/// Widens [lower, upper] to hold an answer and some of its standard errors.
void take_in(const FitResult& result, const Coordinate& coordinate, double& lower, double& upper) {
  for (std::size_t k = 0; k < result.coordinates.size(); ++k) {
    if (result.coordinates[k].id != coordinate.id) continue;
    const auto i = static_cast<Eigen::Index>(k);
    const double least =
        coordinate.logarithmic ? kLeastLog : kLeastShare * (coordinate.upper - coordinate.lower);
    const double error = result.uncertainty.in_null_direction(k)
                             ? 0.0
                             : std::sqrt(std::max(0.0, result.uncertainty.covariance(i, i)));
    const double half = std::max(least, kErrors * error);
    lower = std::min(lower, result.main.coordinates[k] - half);
    upper = std::max(upper, result.main.coordinates[k] + half);
  }
}

CoordinateBox box_about(const Parametrisation& parametrisation, const FitResult& oedometer,
                        const FitResult& slump) {
  CoordinateBox box;
  for (const Coordinate& coordinate : parametrisation.coordinates()) {
    double lower = HUGE_VAL;
    double upper = -HUGE_VAL;
    take_in(oedometer, coordinate, lower, upper);
    take_in(slump, coordinate, lower, upper);
    box.lower.push_back(std::max(lower, coordinate.lower));
    box.upper.push_back(std::min(upper, coordinate.upper));
  }
  return box;
}

/// Costs of the first experiments of a problem and of the rest.
std::pair<double, double> parts(const Eigen::VectorXd& residuals, std::size_t first) {
  const auto count = static_cast<Eigen::Index>(first);
  return {0.5 * residuals.head(count).squaredNorm(),
          0.5 * residuals.tail(residuals.size() - count).squaredNorm()};
}

std::size_t values_of(const Experiments& experiments) {
  std::size_t count = 0;
  for (const auto& experiment : experiments) {
    if (!experiment->held_out()) count += experiment->measured().size();
  }
  return count;
}

}  // namespace

tl::expected<JointFit, FitFailure> fit_jointly(const datasets::Study& study, const OedometerFit& oedometer,
                                               const SlumpFit& slump, const JointFitOptions& options) {
  std::vector<model::ParameterId> wanted = study.fit.oedometer;
  for (const model::ParameterId id : study.fit.slump) {
    if (!has(wanted, id)) wanted.push_back(id);
  }
  const model::Parameters<double>& start = *oedometer.result.parameters;
  const experiments::Simulate simulate =
      options.simulate ? options.simulate : plain_simulation(options.control.stop);
  SlumpExperiments slumps;
  for (std::size_t i = 0; i < study.slump_tests.size(); ++i) {
    if (study.slump_tests[i].hold_out) continue;
    datasets::SlumpTest found = study.slump_tests[i];
    found.setup.mud = datasets::with_values(found.setup.mud, study.fit.slump_mud, slump.mud);
    slumps.push_back(std::make_shared<experiments::SlumpExperiment>(
        std::move(found),
        experiments::SlumpModel{
            simulate, slump.simulation_error.of(i), slump.effects, {}, {}, slump.corrections.of(i)}));
  }
  const CoordinateSettings settings{study.fit.bounds, study.fit.priors, study.fit.oedometer_effects};
  Problem simulated({slumps.begin(), slumps.end()},
                    Parametrisation(start, wanted, {study.fit.bounds, {}}, oedometer.result.gauge),
                    options.threads);
  simulated.set_common_error(common_error_of(slumps, slump.simulation_error));

  JointFit fit;
  TrainingSet set;
  const CoordinateBox box = box_about(simulated.parametrisation(), oedometer.result, slump.result);
  const std::size_t dimension = box.lower.size();
  add_points(simulated, box,
             std::max(kPointsPerCoordinate * dimension, SlumpSurrogate::least_points(dimension)),
             options.seed, options.threads, options.control, set);
  const OptimiserControl quiet = options.control.quiet();
  if (quiet.stopped()) return tl::unexpected(FitFailure{"interrupted", true});
  if (set.points.size() < SlumpSurrogate::least_points(dimension)) {
    return tl::unexpected(FitFailure{
        "too few points of the joint fit could be simulated; the last failure: " + set.last_failure, false});
  }
  fit.points = set.points.size() + set.failed;
  fit.failed = set.failed;
  fit.surrogate = std::make_shared<SlumpSurrogate>(simulated, box, set);
  const Problem slump_alone = with_surrogate(simulated, fit.surrogate);

  Experiments all(oedometer.experiments.begin(), oedometer.experiments.end());
  const std::size_t oedometer_values = values_of(all);
  all.insert(all.end(), slump_alone.fitted().begin(), slump_alone.fitted().end());
  Problem joint(all, Parametrisation(start, wanted, settings, oedometer.result.gauge, all), options.threads);
  std::vector<ExperimentWeights> weights = oedometer.noise.weights;
  weights.resize(joint.fitted().size());
  joint.set_weights(weights);
  joint.set_common_error(slump_alone.common_error().below(static_cast<Eigen::Index>(oedometer_values)));

  FitResult& result = fit.result;
  result.free = joint.parametrisation().free();
  result.coordinates = joint.parametrisation().coordinates();
  result.gauge = oedometer.result.gauge;
  result.gauged = joint.parametrisation().gauged();
  result.main = minimise_with_ceres(joint, joint.parametrisation().start(), {}, quiet);
  if (quiet.stopped()) return tl::unexpected(FitFailure{"interrupted", true});
  const auto residuals = joint.residuals(result.main.coordinates);
  if (!residuals) return tl::unexpected(FitFailure{residuals.error().message, residuals.error().interrupted});
  std::tie(fit.oedometer_cost, fit.slump_cost) = parts(*residuals, oedometer_values);
  if (!result.main.converged)
    result.warnings.push_back("the joint fit did not converge: " + result.main.termination);
  auto uncertainty = estimate_uncertainty(joint, result.main.coordinates, Correlation::independent);
  if (!uncertainty) return tl::unexpected(FitFailure{uncertainty.error().message});
  result.uncertainty = std::move(*uncertainty);
  result.correlation = correlation_of(result.uncertainty.covariance);
  result.estimates = estimate_parameters(joint, result.main.coordinates, result.uncertainty);
  result.parameters = *joint.parametrisation().at(result.main.coordinates);

  // each kind by itself: the oedometer's answer, and the slumps' with what both share
  fit.oedometer_least = oedometer.result.main.cost;
  CeresOptions held;
  for (std::size_t k = 0; k < dimension; ++k) {
    const auto id = *slump_alone.parametrisation().coordinates()[k].id;
    if (has(study.fit.slump, id)) {
      ++fit.shared;
    } else {
      held.held.push_back(k);
    }
  }
  fit.slump_least = minimise_with_ceres(slump_alone, slump_alone.parametrisation().start(), held, quiet).cost;
  const auto excess = [](double least, std::size_t values) {
    return std::max(1.0, 2.0 * least / static_cast<double>(std::max<std::size_t>(values, 1)));
  };
  fit.rise =
      2.0 * (fit.oedometer_cost - fit.oedometer_least) / excess(fit.oedometer_least, oedometer_values) +
      2.0 * (fit.slump_cost - fit.slump_least) / excess(fit.slump_least, simulated.value_count());
  fit.rise = std::max(0.0, fit.rise);
  fit.p_value =
      boost::math::cdf(boost::math::complement(boost::math::chi_squared(std::max(1, fit.shared)), fit.rise));
  return fit;
}

}  // namespace isotach::calibration
