// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Profile likelihood of a coordinate: the least misfit when it is held elsewhere, and the interval that
// follows.
#pragma once

#include <vector>

#include "calibration/optimisers.hpp"

namespace isotach::calibration {

/// How a profile ends on one side.
enum class ProfileEnd {
  crossed,       ///< it rises through the threshold: there the interval ends
  bound,         ///< the bound of the coordinate comes first
  open,          ///< it stays below the threshold as far as was looked
  unpredictable  ///< beyond the last point nothing can be predicted
};

[[nodiscard]] std::string_view name_of(ProfileEnd end);

struct ProfilePoint {
  double x;      ///< of the coordinate
  double delta;  ///< twice the cost above the least
};

struct Profile {
  std::size_t coordinate = 0;
  double threshold = 0.0;            ///< of delta, at the ends of the 95 % interval
  std::vector<ProfilePoint> points;  ///< by increasing x, the optimum among them
  double lower = 0.0;                ///< of the coordinate: where it crosses, or the last place looked at
  double upper = 0.0;
  ProfileEnd lower_end = ProfileEnd::open;
  ProfileEnd upper_end = ProfileEnd::open;
  /// A point with a lower cost than the optimum's, if one was met: the optimum was none.
  std::optional<std::vector<double>> better;
};

/// Profiles coordinate k about the optimum x. `std_error` is its Gauss-Newton standard error, which may be
/// infinite; the interval ends where delta is `threshold`.
[[nodiscard]] Profile profile(const Problem& problem, const std::vector<double>& x, std::size_t k,
                              double std_error, double threshold, const OptimiserControl& control);

}  // namespace isotach::calibration
