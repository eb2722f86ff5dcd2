// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/noise_model.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>

#include "calibration/restricted_likelihood.hpp"

namespace isotach::calibration {

namespace {

constexpr double kLowestShare = 1e-4;  // of the residuals' root mean square
constexpr double kHighestShare = 10.0;
constexpr double kNegligible = 2e-3;  // of -2 ln likelihood

struct Candidate {
  double level = 0.0;
  double floor = 0.0;
  double value = std::numeric_limits<double>::infinity();
  double rho = 0.0;
};

/// The search for level and floor, both by their logarithm.
class Search {
 public:
  Search(const Channel& channel, RestrictedLikelihood& likelihood, double scale)
      : likelihood_(likelihood), lowest_(kLowestShare * scale), highest_(kHighestShare * scale) {
    if (channel.inverse_stress.size() > 0) {
      lowest_floor_ = lowest_ / channel.inverse_stress.maxCoeff();
      highest_floor_ = highest_ / channel.inverse_stress.minCoeff();
    }
  }

  /// With no floor: over the whole range of levels, then closer.
  void along_level() {
    constexpr int kPoints = 9;
    const double low = std::log(lowest_);
    const double step = (std::log(highest_) - low) / (kPoints - 1);
    int best = 0;
    double best_value = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kPoints; ++k) {
      const double value = try_point(std::exp(low + k * step), 0.0);
      if (value < best_value) {
        best = k;
        best_value = value;
      }
    }
    std::uintmax_t evaluations = 60;
    (void)boost::math::tools::brent_find_minima(
        [this](double x) { return try_point(std::exp(x), 0.0); }, low + std::max(best - 1, 0) * step,
        low + std::min(best + 1, kPoints - 1) * step, 26, evaluations);
  }

  /// Of level and floor together from a place, by BOBYQA.
  void from(double level, double floor) {
    nlopt::opt optimiser(nlopt::LN_BOBYQA, 2);
    optimiser.set_lower_bounds({std::log(lowest_), std::log(lowest_floor_)});
    optimiser.set_upper_bounds({std::log(highest_), std::log(highest_floor_)});
    optimiser.set_initial_step(0.5);
    optimiser.set_ftol_abs(1e-7);
    optimiser.set_xtol_abs(1e-6);
    optimiser.set_maxeval(150);
    optimiser.set_min_objective(
        [](const std::vector<double>& x, std::vector<double>&, void* search) {
          return static_cast<Search*>(search)->try_point(std::exp(x[0]), std::exp(x[1]));
        },
        this);
    std::vector<double> x{std::log(std::clamp(level, lowest_, highest_)),
                          std::log(std::clamp(floor, lowest_floor_, highest_floor_))};
    double value = 0.0;
    try {
      optimiser.optimize(x, value);
    } catch (const nlopt::roundoff_limited&) {
      // the best point so far is kept: no better can be had
    }
  }

  /// Leaves out of the best what costs next to nothing to leave out.
  void drop_negligible() {
    const Candidate full = best_;
    for (const auto& [level, floor] :
         {std::pair{0.0, 0.0}, std::pair{full.level, 0.0}, std::pair{0.0, full.floor}}) {
      const auto profile = likelihood_.at(level, floor);
      if (profile.value <= full.value + kNegligible) {
        best_ = {level, floor, profile.value, profile.rho};
        return;
      }
    }
  }

  [[nodiscard]] const Candidate& best() const { return best_; }

 private:
  double try_point(double level, double floor) {
    const auto profile = likelihood_.at(level, floor);
    if (profile.value < best_.value) best_ = {level, floor, profile.value, profile.rho};
    return std::min(profile.value, 1e300);  // BOBYQA's models want numbers
  }

  RestrictedLikelihood& likelihood_;
  double lowest_;
  double highest_;
  double lowest_floor_ = 0.0;
  double highest_floor_ = 0.0;
  Candidate best_;
};

Eigen::VectorXd standard_deviations(const NoiseModel& model, const Channel& channel) {
  Eigen::ArrayXd variance = channel.known_variance.array() + model.level * model.level;
  if (channel.inverse_stress.size() > 0) variance += (model.floor * channel.inverse_stress.array()).square();
  return variance.sqrt();
}

double effective_count(double rho, const Channel& channel) {
  double result = 0.0;
  const auto& starts = channel.chain_starts;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const std::size_t end =
        k + 1 < starts.size() ? starts[k + 1] : static_cast<std::size_t>(channel.residuals.size());
    const auto m = static_cast<double>(end - starts[k]);
    result += (m - (m - 2.0) * rho) / (1.0 + rho);
  }
  return result;
}

}  // namespace

NoiseModel estimate_noise(const Channel& channel, const Eigen::MatrixXd& other_information,
                          const Eigen::VectorXd& other_gradient, const NoiseModel& start) {
  RestrictedLikelihood likelihood(channel, other_information, other_gradient, start);
  const bool has_floor = channel.inverse_stress.size() > 0;
  // residuals without any misfit still have some noise: a millionth of what was supposed
  const double count = static_cast<double>(channel.residuals.size());
  const double supposed = standard_deviations(start, channel).norm();
  const double scale = std::max(channel.residuals.norm(), 1e-6 * supposed) / std::sqrt(count);

  Search search(channel, likelihood, scale);
  if (has_floor) {
    // the floor that makes, in the mean square, all of the scatter
    const double floor = scale * std::sqrt(count) / channel.inverse_stress.norm();
    search.from(start.level, start.floor);
    search.from(scale, 0.3 * floor);
    search.from(0.3 * scale, floor);
  } else {
    search.along_level();
  }
  search.drop_negligible();
  const Candidate& best = search.best();
  if (!std::isfinite(best.value)) {
    throw std::invalid_argument("the restricted likelihood of a channel could not be computed anywhere");
  }
  return {best.level, best.floor, best.rho, -0.5 * best.value, effective_count(best.rho, channel)};
}

Whitening::Whitening(const NoiseModel& model, const Channel& channel) {
  const Eigen::Index n = channel.known_variance.size();
  require_consistent_noise(channel, n);
  if (!(model.level >= 0.0 && model.floor >= 0.0 && model.rho >= 0.0 && model.rho <= kLargestRho &&
        std::isfinite(model.level) && std::isfinite(model.floor))) {
    throw std::invalid_argument("a noise model with level, floor or rho out of range");
  }
  sd_ = standard_deviations(model, channel);
  if (!(sd_.minCoeff() > 0.0)) throw std::invalid_argument("a noise model that leaves a value without noise");
  const double innovation = std::sqrt(1.0 - model.rho * model.rho);
  weight_ = (innovation * sd_).cwiseInverse();
  previous_.setZero(n);
  previous_.tail(n - 1) = (-model.rho) * weight_.head(n - 1);
  for (const std::size_t start : channel.chain_starts) {
    const auto first = static_cast<Eigen::Index>(start);
    weight_[first] = 1.0 / sd_[first];
    previous_[first] = 0.0;
  }
  const auto chains = static_cast<double>(channel.chain_starts.size());
  log_determinant_ =
      2.0 * (sd_.array().log().sum() + (static_cast<double>(n) - chains) * std::log(innovation));
}

void Whitening::whiten(Eigen::Ref<Eigen::MatrixXd> values) const {
  const Eigen::Index n = sd_.size();
  if (values.rows() != n) throw std::invalid_argument("values to whiten are not as many as the channel's");
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    // from the end, so that the value before is still as it was
    for (Eigen::Index i = n - 1; i > 0; --i) {
      values(i, column) = weight_[i] * values(i, column) + previous_[i] * values(i - 1, column);
    }
    values(0, column) *= weight_[0];
  }
}

}  // namespace isotach::calibration
