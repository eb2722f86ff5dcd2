// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Error control over very many random strain paths: achieved error against the tolerance.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "verification/check.hpp"
#include "verification/path.hpp"

namespace isotach::verification {

/// How a random path ended.
enum class PathOutcome {
  complete,       ///< at its end
  pressure_gone,  ///< p fell below 1e-3 of its start
  domain_left,    ///< the reference itself leaves the law's domain (q = 3p, e = 0, the ellipse vanishes)
  failed,         ///< Fellin-Ostermann failed where the reference did not
  no_reference    ///< the reference gave up for another reason: nothing can be said
};

[[nodiscard]] const char* name(PathOutcome outcome);

/// One path's outcome.
struct PathRecord {
  std::uint64_t index = 0;
  PathOutcome outcome = PathOutcome::complete;
  double length = 0.0;      ///< integral |D| dt as far as it was followed
  double log_length = 0.0;  ///< sum of |change of ln|T|| from checkpoint to checkpoint
  double least_F = 1.0;     ///< at the checkpoints: small near q = 3p, where the law's domain ends
  double error = 0.0;       ///< largest achieved error at the checkpoints
  long substeps = 0;        ///< accepted
  long evaluations = 0;     ///< of the law
  std::string message{};    ///< of a failure
};

/// What to sample.
struct SamplingPlan {
  std::uint64_t seed = 1;
  std::size_t paths = 0;
  double tolerance = 1e-6;       ///< of Fellin-Ostermann, relative
  std::size_t cross_checks = 0;  ///< paths whose reference is checked by CVODE
  int threads = 1;
};

/// All records and what follows from them.
struct RandomPathStudy {
  SamplingPlan plan;
  std::vector<PathRecord> records;       ///< by index
  std::vector<double> reference_errors;  ///< CVODE against the reference, of the paths cross-checked
  bool stopped = false;

  /// Number of paths with that outcome.
  [[nodiscard]] std::size_t count(PathOutcome outcome) const;
  /// Achieved errors over the tolerance, sorted, of the paths that have one.
  [[nodiscard]] std::vector<double> errors_over_tolerance() const;
  /// The same over tolerance and path length in units of 0.1, or the tolerance alone where the path is
  /// shorter.
  [[nodiscard]] std::vector<double> errors_over_path() const;
  /// Index in `records` of the largest error.
  [[nodiscard]] std::size_t worst() const;
};

/// Follows one path by Fellin-Ostermann and by the reference, Rosenbrock at 1e-10, in parts; errors are taken
/// at the ends of parts, and the path ends where p falls below 1e-3 of its start.
[[nodiscard]] PathRecord examine(const Path& path, std::uint64_t index, double tolerance);

/// All paths of the plan. `progress(fraction)` may be called from any thread; ends early where `stop` is set.
[[nodiscard]] RandomPathStudy random_path_study(const SamplingPlan& plan,
                                                const std::function<void(double)>& progress,
                                                const std::atomic<bool>* stop);

/// No failures; 99.9 % of the paths with an error of at most 10 TOL; the reference good to a hundredth of
/// that.
[[nodiscard]] std::vector<Check> checks_of(const RandomPathStudy& study);

/// The q-quantile (0 to 1) of sorted numbers; NaN of none.
[[nodiscard]] double quantile(const std::vector<double>& sorted, double q);

}  // namespace isotach::verification
