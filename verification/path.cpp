// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/path.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::verification {

tl::expected<PathEnd, PathFailure> follow(const Path& path, const Options& options) {
  const Law law(path.parameters);
  PathEnd end{path.start, Vector6::Zero(), {}};
  for (std::size_t k = 0; k < path.increments.size(); ++k) {
    const auto result = integrators::integrate(law, end.state, path.increments[k], options);
    if (!result) return tl::unexpected(PathFailure{k, result.error()});
    end.state = result->state;
    end.strain += result->strain;
    end.statistics += result->statistics;
  }
  return end;
}

Options options_of(integrators::Method method, double relative_tolerance) {
  constexpr double kLeastStress = 1.0;  // Pa; smaller stresses are controlled as if they were this
  Options options;
  options.method = method;
  options.fellin_ostermann.relative = relative_tolerance;
  options.fellin_ostermann.absolute_stress = relative_tolerance * kLeastStress;
  options.rosenbrock.relative = relative_tolerance;
  options.rosenbrock.absolute_stress = relative_tolerance * kLeastStress;
  options.cvode.relative = relative_tolerance;
  options.cvode.absolute_stress = relative_tolerance * kLeastStress;
  return options;
}

Options reference_options() {
  return options_of(integrators::Method::cvode, 1e-12);
}

double achieved_error(const State& got, const State& reference) {
  const double stress = (got.stress - reference.stress).norm() / std::max(reference.stress.norm(), 1.0);
  return std::max(stress, std::abs(got.void_ratio - reference.void_ratio));
}

double driven_strain(const Path& path) {
  double length = 0.0;
  for (const auto& increment : path.increments) {
    if (increment.strain_driven()) length += increment.strain_rate.norm() * increment.duration;
  }
  return length;
}

Vector6 principal_stress_kPa(double s11, double s22, double s33) {
  Vector6 stress;
  stress << -s11, -s22, -s33, 0.0, 0.0, 0.0;
  return stress * 1e3;
}

Increment<double> principal_strain(double d11, double d22, double d33, double duration) {
  Vector6 strain_rate;
  strain_rate << -d11, -d22, -d33, 0.0, 0.0, 0.0;
  return integrators::strain_increment<double>(strain_rate, duration);
}

Increment<double> stress_hold(double duration) {
  Increment<double> hold;
  hold.duration = duration;
  hold.stress_controlled.fill(true);
  return hold;
}

}  // namespace isotach::verification
