// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/cross_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace isotach::verification {

namespace {

constexpr double kTolerance = 1e-6;
constexpr int kRows = 80;              // of an increment
constexpr double kFirstOfHold = 1e-7;  // first row of a hold, of its duration

double p_of(const State& state) {
  return model::trace<double, 6>(state.stress) / -3e3;
}
double q_of(const State& state) {
  const double q = std::sqrt(1.5) * model::deviator<double, 6>(state.stress).norm() / 1e3;
  return state.stress[0] > state.stress[1] ? -q : q;
}

/// End of row k = 1 .. kRows of an increment, as a share of its duration: even, or in a hold even in ln t.
double share(bool hold, int k) {
  const double part = static_cast<double>(k) / kRows;
  return hold ? std::pow(kFirstOfHold, 1.0 - part) : part;
}

CrossCheckCurve curve_of(const NamedPath& named) {
  CrossCheckCurve curve{named, kTolerance, {}};
  const Law law(named.path.parameters);
  const std::array<Options, 3> options{reference_options(),
                                       options_of(integrators::Method::fellin_ostermann, kTolerance),
                                       options_of(integrators::Method::rosenbrock, kTolerance)};
  std::array<State, 3> states{named.path.start, named.path.start, named.path.start};
  Vector6 strain = Vector6::Zero();
  double start = 0.0;
  const auto add_row = [&](double time) {
    curve.rows.push_back({time, -strain[0], std::sqrt(2.0) * strain[3], p_of(states[0]), q_of(states[0]),
                          states[0].void_ratio, p_of(states[1]), q_of(states[1]),
                          achieved_error(states[1], states[0]), achieved_error(states[2], states[0])});
  };
  add_row(0.0);
  for (const auto& increment : named.path.increments) {
    double before = 0.0;
    for (int k = 1; k <= kRows; ++k) {
      Increment<double> row = increment;
      const double after = share(named.over_time, k);
      row.duration = (after - before) * increment.duration;
      before = after;
      for (std::size_t i = 0; i < states.size(); ++i) {
        const auto end = integrators::integrate(law, states[i], row, options[i]);
        if (!end) {
          curve.failure = end.error().message();
          return curve;
        }
        states[i] = end->state;
        if (i == 0) strain += end->strain;
      }
      add_row(start + after * increment.duration);
    }
    start += increment.duration;
  }
  return curve;
}

}  // namespace

std::vector<CrossCheckCurve> cross_check_curves() {
  std::vector<CrossCheckCurve> curves;
  for (const NamedPath& named : named_paths()) curves.push_back(curve_of(named));
  return curves;
}

std::vector<Check> checks_of(const std::vector<CrossCheckCurve>& curves) {
  std::vector<Check> checks;
  for (const CrossCheckCurve& curve : curves) {
    double explicit_error = curve.failure.empty() ? 0.0 : std::nan("");
    double implicit_error = explicit_error;
    for (const CrossCheckRow& row : curve.rows) {
      explicit_error = std::max(explicit_error, row.fellin_ostermann_error);
      implicit_error = std::max(implicit_error, row.rosenbrock_error);
    }
    const double strain = std::max(driven_strain(curve.named.path), 0.1);
    const double allowed = 10.0 * curve.tolerance * strain / 0.1;
    const char* const note = "largest achieved error along the path against cvode 1e-12";
    checks.push_back(
        {"cross-check", curve.named.path.name, "fellin-ostermann 1e-06", 0.0, explicit_error, allowed, note});
    checks.push_back(
        {"cross-check", curve.named.path.name, "rosenbrock 1e-06", 0.0, implicit_error, allowed, note});
  }
  return checks;
}

}  // namespace isotach::verification
