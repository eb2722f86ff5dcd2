// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/random_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace isotach::verification {

namespace {

/// Mixes seed and index so that neighbouring indices have nothing in common (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

class Sampler {
 public:
  Sampler(std::uint64_t seed, std::uint64_t index) : engine_(mixed(seed ^ mixed(index))) {}

  [[nodiscard]] double uniform(double low, double high) {
    // by hand: the standard leaves the numbers of its distributions to the library
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  [[nodiscard]] double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  [[nodiscard]] int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  [[nodiscard]] bool one_in(int n) { return below(n) == 0; }

  /// Unit tensor in a random direction.
  [[nodiscard]] Vector6 direction() {
    for (;;) {
      Vector6 a;
      for (int i = 0; i < 6; ++i) a[i] = uniform(-1.0, 1.0);
      const double norm = a.norm();
      if (norm > 0.1 && norm < 1.0) return a / norm;
    }
  }
  [[nodiscard]] Vector6 deviatoric_direction() {
    for (;;) {
      const Vector6 a = model::deviator<double, 6>(direction());
      if (a.norm() > 0.1) return a.normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

model::Parameters<double> random_parameters(Sampler& sample) {
  using enum model::ParameterId;
  model::ParameterValues<double> values;
  values[lambda] = sample.log_uniform(0.02, 0.4);
  const double ratio = sample.log_uniform(0.03, 0.5);
  values[kappa] = ratio * values[lambda];
  values[I_v] = sample.log_uniform(0.01, 0.1);
  values[phi_c] = sample.uniform(10.0, 40.0) * std::numbers::pi / 180.0;
  values[D_r] = sample.log_uniform(1e-9, 1e-4);
  values[e100] = sample.uniform(0.5, 4.0);
  values[C_1] = sample.one_in(4) ? 0.0 : sample.uniform(0.0, 0.9 * (1.0 - ratio));
  if (sample.one_in(4)) {
    values[C_2] = sample.log_uniform(1.0, 100.0);
    values[C_3] = sample.uniform(0.0, 0.8);
  }
  return model::Parameters<double>::create(values).value();
}

/// |T*|/p at the critical state in a deviatoric direction: sqrt(3/2) |T*| = M p, M = F(T*/p) M_c.
double critical_ratio(const Law& law, const Vector6& direction) {
  double low = 0.0;
  double high = 3.0 / std::sqrt(1.5);  // q = 3p
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    Vector6 stress = direction * middle;
    stress.head<3>().array() -= 1.0;
    const double M = law.measures(stress).F * law.critical_ratio();
    (std::sqrt(1.5) * middle < M ? low : high) = middle;
  }
  return low;
}

State random_state(const Law& law, Sampler& sample) {
  for (;;) {
    const double p = sample.log_uniform(100.0, 1e6);
    const Vector6 direction = sample.deviatoric_direction();
    const double size = 0.95 * sample.uniform(0.0, 1.0) * critical_ratio(law, direction);
    State state{direction * (size * p), 0.0};
    state.stress.head<3>().array() -= p;
    if (law.parameters().rotates()) {
      // up to 0.6 of the least M, that of extension, so that the ellipse exists whatever the stress does at
      // first
      const double sin_phi = std::sin(law.parameters().phi_c());
      const double M_extension = 6.0 * sin_phi / (3.0 + sin_phi);
      state.omega =
          sample.deviatoric_direction() * (0.6 * sample.uniform(0.0, 1.0) * M_extension / std::sqrt(1.5));
    }
    const double ocr = sample.log_uniform(0.8, 50.0);
    state.void_ratio = law.void_ratio_at(ocr * law.measures(state).equivalent_pressure);
    if (state.void_ratio > 0.05 && state.void_ratio < 15.0 && law.in_domain(state)) return state;
  }
}

/// Unit strain rate: isochoric, nearly so, or any.
Vector6 strain_direction(Sampler& sample) {
  switch (sample.below(3)) {
    case 0:
      return sample.deviatoric_direction();
    case 1:
      return (sample.deviatoric_direction() + 0.1 * sample.direction()).normalized();
    default:
      return sample.direction();
  }
}

}  // namespace

Path random_path(std::uint64_t seed, std::uint64_t index) {
  Sampler sample(seed, index);
  const auto parameters = random_parameters(sample);
  const Law law(parameters);
  Path path{fmt::format("seed {} path {}", seed, index), parameters, random_state(law, sample), {}};
  const int segments = 1 + sample.below(4);
  const double length = sample.log_uniform(1e-4, 0.5);
  Vector6 direction = Vector6::Zero();
  for (int k = 0; k < segments; ++k) {
    if (k > 0 && sample.one_in(4)) {
      path.increments.push_back(
          integrators::strain_increment<double>(Vector6::Zero(), sample.log_uniform(1.0, 1e8)));
    }
    direction = k > 0 && sample.one_in(2) ? Vector6(-direction) : strain_direction(sample);
    const double rate = sample.log_uniform(1e-9, 1e3);
    path.increments.push_back(
        integrators::strain_increment<double>(direction * rate, length / segments / rate));
  }
  if (sample.one_in(4)) {
    path.increments.push_back(
        integrators::strain_increment<double>(Vector6::Zero(), sample.log_uniform(1.0, 1e8)));
  }
  return path;
}

}  // namespace isotach::verification
