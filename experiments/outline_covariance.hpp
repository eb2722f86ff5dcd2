// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What is uncertain in the distance between a measured and a simulated outline, and how it is shared.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "experiments/outline_stations.hpp"

namespace isotach::experiments {

/// An error that neighbouring places and times share: its correlation is exp(-|difference of places|/along)
/// exp(-|ln(t1/t2)|/in_time), t1 and t2 counted from 0.1 s before the lift.
struct SharedError {
  double outline = 0.0;  ///< standard deviation (m) once the rim has left the mud
  double lifting = 0.0;  ///< and before
  double along = 0.2;    ///< in parts of the outline's length, > 0
  double in_time = 1.0;  ///< in ln t, > 0
  /// Standard deviation of each outline of a test (m), in the place of the first two; empty: those.
  std::vector<double> sizes = {};

  /// Of an outline; `gone` says whether the rim had left the mud.
  [[nodiscard]] double size_of(std::size_t of_outline, bool gone) const {
    if (!sizes.empty()) return sizes[of_outline];
    return gone ? outline : lifting;
  }
};

/// All errors of an outline.
struct OutlineErrors {
  double reading = 0.0;    ///< standard deviation of a point by itself (m)
  SharedError measuring;   ///< of the measured outline as a whole: scale, tilt, axis, mould
  SharedError simulation;  ///< of the simulation: cells, places of the points
};

/// Covariance of the stations' values (m2); `gone` says of each station whether the rim had left the mud.
[[nodiscard]] Eigen::MatrixXd station_covariance(std::span<const OutlineStation> stations,
                                                 const std::vector<bool>& gone, const OutlineErrors& errors);

}  // namespace isotach::experiments
