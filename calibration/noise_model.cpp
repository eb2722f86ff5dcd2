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
  double serial_share = 1.0;
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
        best_ = {level, floor, profile.value, profile.rho, 1.0};
        return;
      }
    }
  }

  /// Gives part of the best one's variance to white noise where that is worth it.
  void split() {
    const Candidate single = best_;
    if (single.rho > kLargestSplitRho) return;
    Candidate split = coarse_split(single);
    constexpr double kInReach = 1.0;  // what level and floor, as yet those of the autoregression, may gain
    if (split.value < single.value + kInReach) split = finest_split(split);
    best_ = split.value < single.value - kSplitGain ? split : single;
  }

  [[nodiscard]] const Candidate& best() const { return best_; }

 private:
  double try_point(double level, double floor) {
    const auto profile = likelihood_.at(level, floor);
    if (profile.value < best_.value) best_ = {level, floor, profile.value, profile.rho, 1.0};
    return std::min(profile.value, kNoNumber);
  }

  /// The best share for each of some rho, with the level and floor given.
  Candidate coarse_split(const Candidate& single) {
    Candidate best;
    for (const double rho : {0.4, 0.6, 0.75, kLargestSplitRho}) {
      constexpr int kBits = 6;
      std::uintmax_t evaluations = 10;
      const auto [share, value] = boost::math::tools::brent_find_minima(
          [&](double trial) { return likelihood_.at(single.level, single.floor, rho, trial); }, 0.0, 1.0,
          kBits, evaluations);
      if (value < best.value) best = {single.level, single.floor, value, rho, share};
    }
    return best;
  }

  /// Of all numbers together, by BOBYQA; a level or floor of zero stays so.
  Candidate finest_split(const Candidate& from) {
    split_ = from;
    std::vector<double> x{from.rho, from.serial_share};
    std::vector<double> lower{0.0, 0.0};
    std::vector<double> upper{kLargestSplitRho, 1.0};
    const auto add = [&](double value, double lowest, double highest) {
      if (value == 0.0) return;
      x.push_back(std::log(value));
      lower.push_back(std::log(lowest));
      upper.push_back(std::log(highest));
    };
    add(from.level, lowest_, highest_);
    add(from.floor, lowest_floor_, highest_floor_);
    nlopt::opt optimiser(nlopt::LN_BOBYQA, static_cast<unsigned>(x.size()));
    optimiser.set_lower_bounds(lower);
    optimiser.set_upper_bounds(upper);
    optimiser.set_initial_step(0.1);
    optimiser.set_ftol_abs(1e-7);
    optimiser.set_xtol_abs(1e-6);
    optimiser.set_maxeval(300);
    optimiser.set_min_objective([](const std::vector<double>& at, std::vector<double>&,
                                   void* search) { return static_cast<Search*>(search)->try_split(at); },
                                this);
    double value = 0.0;
    try {
      optimiser.optimize(x, value);
    } catch (const nlopt::roundoff_limited&) {
      // the best point so far is kept
    }
    return split_;
  }

  double try_split(const std::vector<double>& x) {
    std::size_t next = 2;
    const double level = split_.level == 0.0 ? 0.0 : std::exp(x[next++]);
    const double floor = split_.floor == 0.0 ? 0.0 : std::exp(x[next]);
    const double value = likelihood_.at(level, floor, x[0], x[1]);
    if (value < split_.value) split_ = {level, floor, value, x[0], x[1]};
    return std::min(value, kNoNumber);
  }

  static constexpr double kNoNumber = 1e300;  // BOBYQA's models want numbers

  RestrictedLikelihood& likelihood_;
  double lowest_;
  double highest_;
  double lowest_floor_ = 0.0;
  double highest_floor_ = 0.0;
  Candidate best_;
  Candidate split_;
};

Eigen::VectorXd standard_deviations(const NoiseModel& model, const Channel& channel) {
  Eigen::ArrayXd variance = channel.known_variance.array() + model.level * model.level;
  if (channel.inverse_stress.size() > 0) variance += (model.floor * channel.inverse_stress.array()).square();
  return variance.sqrt();
}

/// Standard deviations of a model that is within its ranges, for a channel that is consistent.
Eigen::VectorXd checked_deviations(const NoiseModel& model, const Channel& channel) {
  require_consistent_noise(channel, channel.known_variance.size());
  if (!(model.level >= 0.0 && model.floor >= 0.0 && model.rho >= 0.0 && model.rho <= kLargestRho &&
        model.serial_share >= 0.0 && model.serial_share <= 1.0 && std::isfinite(model.level) &&
        std::isfinite(model.floor))) {
    throw std::invalid_argument("a noise model with level, floor, rho or serial_share out of range");
  }
  const Eigen::VectorXd sd = standard_deviations(model, channel);
  if (!(sd.minCoeff() > 0.0)) throw std::invalid_argument("a noise model that leaves a value without noise");
  return sd;
}

}  // namespace

NoiseModel estimate_noise(const Channel& channel, const Eigen::MatrixXd& other_information,
                          const Eigen::VectorXd& other_gradient, const NoiseModel& start, NoiseParts parts) {
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
  if (parts == NoiseParts::lasting_and_white) search.split();
  const Candidate& best = search.best();
  if (!std::isfinite(best.value)) {
    throw std::invalid_argument("the restricted likelihood of a channel could not be computed anywhere");
  }
  NoiseModel model{best.level, best.floor, best.rho, -0.5 * best.value, 0.0, best.serial_share};
  model.effective_count = effective_count(model, channel);
  return model;
}

double effective_count(const NoiseModel& model, const Channel& channel) {
  const Eigen::Index count = channel.residuals.size();
  Eigen::VectorXd ones = Eigen::VectorXd::Ones(count);
  SerialFilter(model.rho, model.serial_share, count, channel.chain_starts).apply(ones);
  return ones.squaredNorm();
}

Whitening::Whitening(const NoiseModel& model, const Channel& channel)
    : sd_(checked_deviations(model, channel)),
      filter_(model.rho, model.serial_share, sd_.size(), channel.chain_starts),
      log_determinant_(2.0 * sd_.array().log().sum() + filter_.log_determinant()) {}

void Whitening::whiten(Eigen::Ref<Eigen::MatrixXd> values) const {
  if (values.rows() != sd_.size()) {
    throw std::invalid_argument("values to whiten are not as many as the channel's");
  }
  values.array().colwise() /= sd_.array();
  filter_.apply(values);
}

}  // namespace isotach::calibration
