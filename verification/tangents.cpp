// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/tangents.hpp"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/parallel.hpp"
#include "integrators/tangent.hpp"
#include "verification/random_path.hpp"
#include "verification/random_paths.hpp"

namespace isotach::verification {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using integrators::Tolerance;

constexpr double kTolerance = 1e-6;

/// Strain of the increment of path `index`: 1e-5 to 1e-2, evenly in the logarithm.
double strain_of(std::uint64_t index) {
  constexpr double kGolden = 0.6180339887498949;
  const double share = static_cast<double>(index) * kGolden;
  return std::pow(10.0, -5.0 + 3.0 * (share - std::floor(share)));
}

/// All in Jets of width six: the parameters too.
std::optional<Matrix6> tangent_by_jets(const model::Parameters<double>& parameters, const State& start,
                                       const Increment<double>& increment, const Tolerance& tolerance) {
  using Jet = ceres::Jet<double, 6>;
  const model::Law<Jet> law(parameters.cast<Jet>());
  Increment<Jet> jets = increment.cast<Jet>();
  for (int i = 0; i < 6; ++i) jets.strain_rate[i].v[i] = 1.0;
  const auto end = integrators::integrate_fellin_ostermann(law, model::cast<Jet>(start), jets, tolerance);
  if (!end) return std::nullopt;
  Matrix6 tangent;
  for (int i = 0; i < 6; ++i) tangent.row(i) = end->state.stress[i].v.transpose() / increment.duration;
  return tangent;
}

/// Central differences with Richardson's extrapolation of the stress that `integrate` gives; step relative to
/// |D|.
template <class Integrate>
std::optional<Matrix6> tangent_by_differences(const Increment<double>& increment, double step,
                                              Integrate&& integrate) {
  Matrix6 tangent;
  const double size = increment.strain_rate.norm();
  for (int j = 0; j < 6; ++j) {
    const auto difference = [&](double h) -> std::optional<Vector6> {
      Increment<double> up = increment;
      Increment<double> down = increment;
      up.strain_rate[j] += h * size;
      down.strain_rate[j] -= h * size;
      const auto a = integrate(up);
      const auto b = integrate(down);
      if (!a || !b) return std::nullopt;
      return Vector6((a->state.stress - b->state.stress) / (2.0 * h * size * increment.duration));
    };
    const auto wide = difference(step);
    const auto narrow = difference(0.5 * step);
    if (!wide || !narrow) return std::nullopt;
    tangent.col(j) = (4.0 * *narrow - *wide) / 3.0;
  }
  return tangent;
}

double relative(const Matrix6& got, const Matrix6& expected) {
  return (got - expected).norm() / expected.norm();
}

std::optional<TangentRecord> compare(std::uint64_t seed, std::uint64_t index) {
  const Path path = random_path(seed, index);
  const Law law(path.parameters);
  Increment<double> increment = path.increments.front();
  const double strain = strain_of(index);
  increment.duration = strain / increment.strain_rate.norm();
  Tolerance tolerance;
  tolerance.relative = kTolerance;
  Tolerance one_substep;
  one_substep.relative = 1e30;

  const auto tangent = integrators::integrate_with_tangent(law, path.start, increment, tolerance);
  const auto single = integrators::integrate_with_tangent(law, path.start, increment, one_substep);
  if (!tangent || !single) return std::nullopt;
  const auto jets = tangent_by_jets(path.parameters, path.start, increment, tolerance);
  // steps: truncation ~ h^4 against round-off ~ 1e-16/h of the map, 1e-12/h of the reference
  const auto discrete = tangent_by_differences(increment, 1e-3, [&](const Increment<double>& moved) {
    return integrators::integrate_fellin_ostermann(law, path.start, moved, one_substep);
  });
  const auto exact = tangent_by_differences(increment, 3e-3, [&](const Increment<double>& moved) {
    return integrators::integrate(law, path.start, moved, options_of(integrators::Method::rosenbrock, 1e-12));
  });
  if (!jets || !discrete || !exact) return std::nullopt;
  return TangentRecord{index, strain, relative(tangent->tangent, *jets), relative(single->tangent, *discrete),
                       relative(tangent->tangent, *exact)};
}

std::vector<double> sorted(const TangentStudy& study, double TangentRecord::*field) {
  std::vector<double> values;
  for (const TangentRecord& record : study.records) values.push_back(record.*field);
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace

TangentStudy tangent_study(std::uint64_t seed, std::size_t count, int threads,
                           const std::atomic<bool>* stop) {
  std::vector<std::optional<TangentRecord>> records(count);
  calibration::parallel_for(count, threads, [&](std::size_t i) {
    if (stop == nullptr || !stop->load()) records[i] = compare(seed, i);
  });
  TangentStudy study{kTolerance, {}};
  for (const auto& record : records) {
    if (record) {
      study.records.push_back(*record);
    } else {
      ++study.skipped;
    }
  }
  return study;
}

std::vector<Check> checks_of(const TangentStudy& study) {
  const char* const group = "tangent";
  const char* const scheme = "fellin-ostermann 1e-06";
  return {
      {group, "median relative error against Jets of another route", scheme, 0.0,
       quantile(sorted(study, &TangentRecord::jets), 0.5), 1e-8, "exact: the derivative of the discrete map"},
      {group, "median relative error against differences of the discrete map", scheme, 0.0,
       quantile(sorted(study, &TangentRecord::differences), 0.5), 1e-8,
       "exact, to the accuracy of differences; one substep"},
      {group, "median relative error against the tangent of the exact solution", scheme, 0.0,
       quantile(sorted(study, &TangentRecord::exact_solution), 0.5), 1e-3,
       "an approximation as good as the map itself"}};
}

}  // namespace isotach::verification
