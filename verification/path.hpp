// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A path of the verification: a material point led through increments, and its end by any integrator.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "integrators/integrate.hpp"

namespace isotach::verification {

using integrators::Increment;
using integrators::Options;
using Law = model::Law<double>;
using State = model::State<double>;
using Vector6 = model::Mandel<double>;

struct Path {
  std::string name;
  model::Parameters<double> parameters;
  State start;
  std::vector<Increment<double>> increments;
};

/// Where a path ended.
struct PathEnd {
  State state;
  Vector6 strain;                      ///< logarithmic, since the start
  integrators::Statistics statistics;  ///< of all increments
};

/// A path that could not be followed to its end.
struct PathFailure {
  std::size_t increment;  ///< index
  integrators::Failure failure;
};

/// Follows the path; each increment is an integration of its own.
[[nodiscard]] tl::expected<PathEnd, PathFailure> follow(const Path& path, const Options& options);

/// Options with the relative tolerance of the method set, and with it the absolute one of stress: 1 Pa times
/// it, as in achieved_error().
[[nodiscard]] Options options_of(integrators::Method method, double relative_tolerance);

/// What stands for exact: CVODE at a relative 1e-12.
[[nodiscard]] Options reference_options();

/// max(|dT|/max(|T|, 1 Pa), |de|) of `got` against `reference`.
[[nodiscard]] double achieved_error(const State& got, const State& reference);

/// Length of strain, the time integral of |D|, of strain-driven increments; others add nothing.
[[nodiscard]] double driven_strain(const Path& path);

/// Stress (Pa, tension positive) of principal stresses in kPa, compression positive.
[[nodiscard]] Vector6 principal_stress_kPa(double s11, double s22, double s33);

/// Increment at principal strain rates (1/s), compression positive.
[[nodiscard]] Increment<double> principal_strain(double d11, double d22, double d33, double duration);

/// All stresses held for a time (s).
[[nodiscard]] Increment<double> stress_hold(double duration);

}  // namespace isotach::verification
