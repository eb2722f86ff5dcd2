// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cost of the stress update: one point by the scalar law and integrator, and many points in packs.
#include <benchmark/benchmark.h>

#include <cmath>

#include "integrators/integrate.hpp"
#include "mpm/stress_update.hpp"

namespace {

using namespace isotach;

model::Parameters<double> seed_parameters() {
  model::ParameterValues<double> values;
  using enum model::ParameterId;
  values[e100] = 1.358;
  values[lambda] = 0.154;
  values[kappa] = 0.0129;
  values[I_v] = 0.02;
  values[D_r] = 6.8e-7;
  values[phi_c] = 14.2 * std::numbers::pi / 180.0;
  values[C_1] = 0.03;
  return *model::Parameters<double>::create(values);
}

constexpr double kVoidRatio = 3.891;
constexpr double kPressure = 584.0;  // Pa
constexpr double kRate = 0.1;        // 1/s
constexpr double kStep = 2e-4;       // s

void rate_of_one_point(benchmark::State& state) {
  const model::Law<double> law(seed_parameters());
  model::State<double> point{model::unit_tensor<double>() * -kPressure, kVoidRatio};
  point.stress[0] *= 1.2;
  model::Mandel<double> strain_rate = model::Mandel<double>::Zero();
  strain_rate[0] = -kRate;
  strain_rate[1] = kRate;
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(law.rate(point, strain_rate));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(rate_of_one_point);

void increment(benchmark::State& state, integrators::Method method) {
  const model::Law<double> law(seed_parameters());
  const model::State<double> point{model::unit_tensor<double>() * -kPressure, kVoidRatio};
  model::Mandel<double> strain_rate = model::Mandel<double>::Zero();
  strain_rate[0] = -kRate;
  strain_rate[1] = kRate;
  integrators::Options options;
  options.method = method;
  const auto loading = integrators::strain_increment<double>(strain_rate, kStep);
  for (auto _ : state) benchmark::DoNotOptimize(integrators::integrate(law, point, loading, options));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(increment, fellin_ostermann, integrators::Method::fellin_ostermann);
BENCHMARK_CAPTURE(increment, cvode, integrators::Method::cvode);

void stress_update_of_many_points(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  mpm::Particles particles;
  particles.count = count;
  const std::size_t padded = mpm::Particles::padded(count, mpm::Lanes::kCount);
  particles.for_each_array([padded](std::vector<double>& array) { array.assign(padded, 0.0); });
  particles.void_ratio.assign(padded, kVoidRatio);
  for (std::size_t i = 0; i < padded; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(padded);
    particles.strain_rate[0][i] = kRate * share;
    particles.strain_rate[1][i] = -kRate * share;
    particles.strain_rate[3][i] = kRate * (1.0 - share);
    particles.spin[i] = kRate * share;
  }
  const mpm::StressUpdate update(seed_parameters(), 3e-3, 1e-3 * kPressure);
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t k = 0; k < 3; ++k) particles.stress[k].assign(padded, -kPressure);
    state.ResumeTiming();
    benchmark::DoNotOptimize(update.update(particles, kStep));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(stress_update_of_many_points)->Arg(1440);

}  // namespace
