// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What accuracy costs: evaluations and time against achieved error, for every integrator on easy and stiff
// paths.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verification/named_paths.hpp"

namespace isotach::verification {

/// One run at one tolerance.
struct WorkPoint {
  double tolerance;
  double error;         ///< achieved, at the end of the path
  double microseconds;  ///< of the run, the least of several
  integrators::Statistics statistics;
};

struct WorkPrecision {
  NamedPath named;
  integrators::Method method;
  std::vector<WorkPoint> points;  ///< from loose to tight; failures left out
};

/// Every named path by every integrator, tolerances from 1e-2 (the reference: 1e-3) down.
[[nodiscard]] std::vector<WorkPrecision> work_precision_study(const std::function<void(double)>& progress);

}  // namespace isotach::verification
