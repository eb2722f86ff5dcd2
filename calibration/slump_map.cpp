// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/slump_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isotach::calibration {

namespace {

constexpr double kBoxHalfWidth = 5.0;       // of the first box, in standard errors
constexpr double kLeastBoxHalfWidth = 0.1;  // of a logarithm; of other coordinates a share of their range
constexpr double kMostOfRange = 0.5;        // the first box is no wider than so much of the range
constexpr std::size_t kPointsPerCoordinate = 10;
constexpr int kMostGrowths = 3;
constexpr double kGrowth = 1.0;  // of the box's width, on the side that is too near
constexpr std::size_t kMapCells = 40;

double bounded(double x, const Coordinate& coordinate) {
  return std::clamp(x, coordinate.lower, coordinate.upper);
}

CoordinateBox first_box(const Problem& problem, const std::vector<double>& answer,
                        const Uncertainty& uncertainty) {
  CoordinateBox box;
  for (std::size_t k = 0; k < answer.size(); ++k) {
    const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
    const auto i = static_cast<Eigen::Index>(k);
    const double range = coordinate.search_width(answer[k]);
    const double least = coordinate.logarithmic ? kLeastBoxHalfWidth : kLeastBoxHalfWidth * range;
    const double error =
        uncertainty.in_null_direction(k) ? HUGE_VAL : std::sqrt(uncertainty.covariance(i, i));
    const double half =
        std::clamp(kBoxHalfWidth * error, std::min(least, kMostOfRange * range), kMostOfRange * range);
    box.lower.push_back(bounded(answer[k] - half, coordinate));
    box.upper.push_back(bounded(answer[k] + half, coordinate));
  }
  return box;
}

/// The least of the surrogate's misfit.
OptimiserResult best_of(const Problem& problem, const std::vector<double>& from,
                        const OptimiserControl& quiet) {
  NloptOptions options;
  options.first_step = options.first_step_C_1 = 0.02;
  options.restarts = 2;
  return minimise_with_nlopt(problem, from, options, quiet);
}

/// Widens the box where an interval or the answer comes too near to a side that is no bound. Returns whether
/// it did.
bool widen(const Problem& problem, const SlumpMap& map, CoordinateBox& box) {
  bool widened = false;
  for (const Profile& profile : map.profiles) {
    const std::size_t k = profile.coordinate;
    const Coordinate& coordinate = problem.parametrisation().coordinates()[k];
    const double width = box.upper[k] - box.lower[k];
    if (profile.lower < box.lower[k] && box.lower[k] > coordinate.lower) {
      box.lower[k] = bounded(box.lower[k] - kGrowth * width, coordinate);
      widened = true;
    }
    if (profile.upper > box.upper[k] && box.upper[k] < coordinate.upper) {
      box.upper[k] = bounded(box.upper[k] + kGrowth * width, coordinate);
      widened = true;
    }
  }
  return widened;
}

MisfitMap misfit_map(const Problem& on_surrogate, const SlumpMap& map, const CoordinateBox& box,
                     const OptimiserControl& quiet) {
  MisfitMap result;
  result.second = 1;
  for (std::size_t i = 0; i <= kMapCells; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kMapCells);
    result.x.push_back(box.lower[0] + share * (box.upper[0] - box.lower[0]));
    result.y.push_back(box.lower[1] + share * (box.upper[1] - box.lower[1]));
  }
  const auto n = static_cast<Eigen::Index>(kMapCells + 1);
  result.rise = Eigen::MatrixXd::Constant(n, n, std::nan(""));
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      std::vector<double> x = map.best;
      x[0] = result.x[static_cast<std::size_t>(i)];
      x[1] = result.y[static_cast<std::size_t>(j)];
      double cost = 0.0;
      if (x.size() > 2) {
        CeresOptions held;
        held.held = {0, 1};
        held.max_iterations = 20;
        cost = minimise_with_ceres(on_surrogate, x, held, quiet).cost;
      } else {
        const auto residuals = on_surrogate.residuals(x);
        if (!residuals) continue;
        cost = cost_of(*residuals);
      }
      result.rise(i, j) = 2.0 * (cost - map.cost);
    }
  }
  return result;
}

/// Searches of other kinds on the surrogate.
std::vector<OptimiserResult> other_routes(const Problem& on_surrogate, const std::vector<double>& answer,
                                          const CoordinateBox& box, unsigned seed,
                                          const OptimiserControl& quiet) {
  std::vector<OptimiserResult> routes;
  routes.push_back(minimise_with_ceres(on_surrogate, answer, {}, quiet));
  GlobalOptions global;
  global.lower = box.lower;
  global.upper = box.upper;
  global.seed = seed;
  global.max_evaluations = 600;
  for (const GlobalSearch search : {GlobalSearch::crs2, GlobalSearch::esch}) {
    routes.push_back(search_globally(on_surrogate, search, answer, global, quiet));
  }
  return routes;
}

}  // namespace

tl::expected<SlumpMap, FitFailure> map_slump(const Problem& problem, const std::vector<double>& answer,
                                             const Uncertainty& uncertainty, const SlumpMapOptions& options) {
  const OptimiserControl quiet = options.control.quiet();
  const std::size_t count =
      std::max(kPointsPerCoordinate * answer.size(), SlumpSurrogate::least_points(answer.size()));
  const double threshold = std::pow(uncertainty.quantile() * uncertainty.inflation, 2.0);
  SlumpMap map;
  TrainingSet set;
  CoordinateBox box = first_box(problem, answer, uncertainty);
  for (int round = 0;; ++round) {
    add_points(problem, box, count, options.seed + static_cast<unsigned>(round), options.threads,
               options.control, set);
    if (quiet.stopped()) return tl::unexpected(FitFailure{"interrupted", true});
    if (set.points.size() < SlumpSurrogate::least_points(answer.size())) {
      return tl::unexpected(
          FitFailure{fmt::format("{} of {} points of the map could not be simulated; the last: {}",
                                 set.failed, set.failed + set.points.size(), set.last_failure),
                     false});
    }
    map.surrogate = std::make_shared<SlumpSurrogate>(problem, box, set);
    const Problem on_surrogate = with_surrogate(problem, map.surrogate);
    const OptimiserResult best = best_of(on_surrogate, answer, quiet);
    map.best = best.coordinates;
    map.cost = best.cost;
    map.profiles.clear();
    for (std::size_t k = 0; k < answer.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double error = uncertainty.in_null_direction(k) ? std::numeric_limits<double>::infinity()
                                                            : std::sqrt(uncertainty.covariance(i, i));
      map.profiles.push_back(profile(on_surrogate, map.best, k, error, threshold, quiet));
    }
    if (quiet.stopped()) return tl::unexpected(FitFailure{"interrupted", true});
    map.enlarged = round;
    if (round < kMostGrowths && widen(problem, map, box)) continue;
    if (answer.size() > 1) map.maps.push_back(misfit_map(on_surrogate, map, box, quiet));
    map.routes = other_routes(on_surrogate, answer, box, options.seed, quiet);
    map.points = set.points.size() + set.failed;
    map.failed = set.failed;
    map.training = std::move(set.points);
    return map;
  }
}

}  // namespace isotach::calibration
