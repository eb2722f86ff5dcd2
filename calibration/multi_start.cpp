// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/multi_start.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/latin_hypercube.hpp"
#include "calibration/parallel.hpp"

namespace isotach::calibration {

namespace {

constexpr double kSameAnswer = 0.5;  // standard errors

}  // namespace

MultiStart multi_start(const Problem& problem, const std::vector<double>& first,
                       const Eigen::MatrixXd& information, const MultiStartOptions& options,
                       const OptimiserControl& control) {
  MultiStart result;
  result.starts = options.starts;
  const auto count = static_cast<std::size_t>(std::max(0, options.starts));
  std::mt19937_64 random(options.seed);
  const auto& coordinates = problem.parametrisation().coordinates();
  for (const auto& unit : latin_hypercube(count, first.size(), random)) {
    std::vector<double> x = first;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double range = coordinates[k].search_width(first[k]);
      const double half = coordinates[k].logarithmic ? options.spread : 0.5 * options.spread * range;
      const double lower = std::max(coordinates[k].lower, first[k] - half);
      const double upper = std::min(coordinates[k].upper, first[k] + half);
      x[k] = lower + unit[k] * (upper - lower);
    }
    result.from.push_back(std::move(x));
  }

  Problem serial = problem;
  serial.set_threads(1);
  std::vector<std::optional<OptimiserResult>> found(count);
  const OptimiserControl quiet = control.quiet();
  parallel_for(count, options.threads, [&](std::size_t i) {
    if (control.stopped()) return;
    // a start that the law cannot follow is drawn halfway towards the first one, which it can
    constexpr int kTries = 6;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      OptimiserResult answer = minimise_with_ceres(serial, result.from[i], {}, quiet);
      if (std::isfinite(answer.cost) && answer.evaluations > answer.failed_evaluations) {
        found[i] = std::move(answer);
        return;
      }
      for (std::size_t k = 0; k < first.size(); ++k) {
        result.from[i][k] = 0.5 * (result.from[i][k] + first[k]);
      }
    }
  });
  std::vector<Answer> answers;
  for (const auto& one : found) {
    if (!one) {
      ++result.failed;
      continue;
    }
    answers.push_back({Eigen::Map<const Eigen::VectorXd>(one->coordinates.data(),
                                                         static_cast<Eigen::Index>(one->coordinates.size())),
                       one->cost});
  }
  result.clusters = cluster_answers(std::move(answers), information, kSameAnswer);
  return result;
}

}  // namespace isotach::calibration
