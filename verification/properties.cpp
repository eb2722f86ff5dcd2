// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/properties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "calibration/parallel.hpp"
#include "verification/random_path.hpp"

namespace isotach::verification {

namespace {

constexpr double kLength = 0.02;  // strain to which paths of the properties are cut: rounding must not grow

/// A rotation that differs from path to path.
Eigen::Matrix3d rotation(std::uint64_t index) {
  const auto x = static_cast<double>(index);
  return Eigen::Quaterniond(1.0, std::sin(x), std::cos(2.3 * x), std::sin(0.7 * x + 1.0))
      .normalized()
      .matrix();
}

Vector6 turned(const Vector6& a, const Eigen::Matrix3d& Q) {
  return model::mandel_from_matrix<double>(Q * model::matrix_from_mandel<double, 6>(a) * Q.transpose());
}

/// The path cut to kLength of strain in all.
Path short_path(std::uint64_t seed, std::uint64_t index) {
  Path path = random_path(seed, index);
  const double scale = std::min(1.0, kLength / driven_strain(path));
  for (auto& increment : path.increments) increment.duration *= scale;
  return path;
}

Options tight() {
  return options_of(integrators::Method::fellin_ostermann, 1e-8);
}

/// Relative difference of two paths' ends, zero where both fail alike.
double difference(const Path& a, const Path& b, const std::function<Vector6(const Vector6&)>& map) {
  const auto end_a = follow(a, tight());
  const auto end_b = follow(b, tight());
  if (end_a.has_value() != end_b.has_value()) return std::numeric_limits<double>::infinity();
  if (!end_a) return 0.0;
  return (map(end_a->state.stress) - end_b->state.stress).norm() / end_b->state.stress.norm();
}

double objectivity(std::uint64_t seed, std::uint64_t index) {
  const Path path = short_path(seed, index);
  const Eigen::Matrix3d Q = rotation(index);
  Path other = path;
  other.start.stress = turned(path.start.stress, Q);
  other.start.omega = turned(path.start.omega, Q);
  for (auto& increment : other.increments) increment.strain_rate = turned(increment.strain_rate, Q);
  return difference(path, other, [&Q](const Vector6& stress) { return turned(stress, Q); });
}

double gauge(std::uint64_t seed, std::uint64_t index) {
  const Path path = short_path(seed, index);
  Path other = path;
  auto values = path.parameters.values();
  const double f = std::pow(10.0, 2.0 * std::sin(static_cast<double>(index)));
  values[model::ParameterId::D_r] *= f;
  values[model::ParameterId::e100] =
      (1.0 + path.parameters.e100()) * std::pow(f, path.parameters.lambda() * path.parameters.I_v()) - 1.0;
  const auto moved = model::Parameters<double>::create(values);
  if (!moved) return 0.0;  // e100 would not be positive
  other.parameters = *moved;
  return difference(path, other, [](const Vector6& stress) { return stress; });
}

double stiffness_symmetry(std::uint64_t seed, std::uint64_t index) {
  const Path path = random_path(seed, index);
  const Law law(path.parameters);
  const auto at = law.measures(path.start);
  Eigen::Matrix<double, 6, 6> stiffness;
  for (int j = 0; j < 6; ++j) stiffness.col(j) = law.stiffness_times(at, Vector6(Vector6::Unit(j)));
  return (stiffness - stiffness.transpose()).norm() / stiffness.norm();
}

/// Stress and p_B times c at the same strain rate: the stress rate is times c.
double homogeneity(std::uint64_t seed, std::uint64_t index) {
  const Path path = random_path(seed, index);
  const Law law(path.parameters);
  const double c = 3.7;
  State scaled = path.start;
  scaled.stress *= c;
  scaled.void_ratio = law.void_ratio_at(c * law.preconsolidation_pressure(path.start.void_ratio));
  const Vector6 strain_rate = path.increments.front().strain_rate;
  const Vector6 once = law.rate(path.start, strain_rate).stress;
  const Vector6 times_c = law.rate(scaled, strain_rate).stress;
  // in units of the two parts of the rate, which may all but cancel
  const auto at = law.measures(path.start);
  const double size =
      law.stiffness_times(at, strain_rate).norm() +
      law.stiffness_times(at, at.m).norm() * law.viscous_rate(at.equivalent_pressure, path.start.void_ratio);
  return (times_c - c * once).norm() / (c * size);
}

/// -T:D_vis/(|T||D_vis|): at most zero where viscous flow dissipates.
double negative_dissipation(std::uint64_t seed, std::uint64_t index) {
  const Path path = random_path(seed, index);
  const Law law(path.parameters);
  return -path.start.stress.dot(law.measures(path.start).m) / path.start.stress.norm();
}

/// |q/(M p) - 1| after isochoric shear over a strain of 10, from any start.
double critical_state(std::uint64_t seed, std::uint64_t index) {
  constexpr double kStrain = 10.0;
  Path path = random_path(seed, index);
  auto values = path.parameters.values();
  values[model::ParameterId::C_2] = 0.0;
  values[model::ParameterId::C_3] = 0.0;
  path.parameters = model::Parameters<double>::create(values).value();
  path.start.omega.setZero();
  Increment<double> shear = path.increments.front();
  const double rate = shear.strain_rate.norm();
  shear.strain_rate = model::deviator<double, 6>(shear.strain_rate).normalized() * rate;
  shear.duration = kStrain / rate;
  path.increments = {shear};
  const auto end = follow(path, options_of(integrators::Method::rosenbrock, 1e-8));
  if (!end) return std::numeric_limits<double>::infinity();
  const Law law(path.parameters);
  const auto at = law.measures(end->state);
  const double q = std::sqrt(1.5) * model::deviator<double, 6>(end->state.stress).norm();
  return std::abs(q / (at.F * law.critical_ratio() * at.p) - 1.0);
}

/// 1 where states with and without Omega do not give the same bytes, for materials that do not rotate.
double forms_differ(std::uint64_t seed, std::uint64_t index) {
  const Path path = short_path(seed, index);
  if (path.parameters.rotates()) return 0.0;
  const Law law(path.parameters);
  State inclined = path.start;
  auto upright = model::in_form<model::Fabric::none>(path.start);
  for (const auto& increment : path.increments) {
    const auto a = integrators::integrate_fellin_ostermann(law, inclined, increment, {});
    const auto b = integrators::integrate_fellin_ostermann(law, upright, increment, {});
    if (a.has_value() != b.has_value()) return 1.0;
    if (!a) return 0.0;
    if (a->state.stress != b->state.stress || a->state.void_ratio != b->state.void_ratio) return 1.0;
    inclined = a->state;
    upright = b->state;
  }
  return 0.0;
}

}  // namespace

std::vector<Check> property_checks(std::uint64_t seed, std::size_t count, int threads,
                                   const std::atomic<bool>* stop) {
  struct Property {
    const char* name;
    double (*measure)(std::uint64_t, std::uint64_t);
    double tolerance;
    const char* note;
  };
  const Property properties[] = {
      {"objectivity: the path in turned axes", objectivity, 1e-9, "|dT|/|T|, Fellin-Ostermann at 1e-8"},
      {"gauge (e100, D_r): the path in another gauge", gauge, 1e-8, "|dT|/|T|, Fellin-Ostermann at 1e-8"},
      {"symmetry of the stiffness", stiffness_symmetry, 1e-14, "|E - E^T|/|E|"},
      {"homogeneity: stress and p_B scaled by 3.7", homogeneity, 1e-10,
       "|dT/dt| against 3.7 times, of its parts"},
      {"viscous dissipation: largest -T:D_vis/(|T||D_vis|)", negative_dissipation, 0.0,
       "must not be positive"},
      {"critical state as an attractor: q/(M p) - 1 after isochoric shear", critical_state, 1e-4,
       "any start, strain 10, Rosenbrock at 1e-8"},
      {"isotropic form: paths whose bytes differ", forms_differ, 0.0, "states with and without Omega"}};
  std::vector<Check> checks;
  for (const Property& property : properties) {
    std::vector<double> values(count);
    calibration::parallel_for(count, threads, [&](std::size_t i) {
      if (stop == nullptr || !stop->load()) values[i] = property.measure(seed, i);
    });
    double worst = *std::max_element(values.begin(), values.end());
    // dissipation: any negative number is as good as zero
    if (property.measure == negative_dissipation) worst = std::max(worst, 0.0);
    checks.push_back({"properties", property.name, "", 0.0, worst, property.tolerance, property.note});
  }
  return checks;
}

}  // namespace isotach::verification
