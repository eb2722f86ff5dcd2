// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How many different answers the starts of a multi-start came to.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace isotach::calibration {

/// Where a fit from one start ended.
struct Answer {
  Eigen::VectorXd x;  ///< coordinates
  double cost;        ///< half the sum of squared whitened residuals
};

/// Answers that are one.
struct Cluster {
  Eigen::VectorXd best;  ///< the coordinates of lowest cost
  double cost;           ///< of these
  std::size_t count;     ///< of answers, >= 1
};

/// Groups answers by single linkage: two are one if they are at most `radius` standard errors apart, or
/// joined by others that are. The distance sqrt((x - y)' J'J (x - y)) has J'J = `information` at the best
/// answer; along directions that the data do not see it is zero, so that a null direction does not multiply
/// answers. Where the information tells nothing (it is zero, or not finite), two answers are one if their
/// costs differ by at most radius^2/2, what moving by that distance costs at a minimum.
///
/// Sorted by cost. Throws std::invalid_argument for answers that are not finite or not of one size,
/// information of another size, and a radius that is not positive and finite.
[[nodiscard]] std::vector<Cluster> cluster_answers(std::vector<Answer> answers,
                                                   const Eigen::MatrixXd& information, double radius);

}  // namespace isotach::calibration
