// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cost of the stress update: one point by the scalar law and integrators, with and without its tangent.
#include <benchmark/benchmark.h>

#include "bench/slump_point.hpp"
#include "integrators/integrate.hpp"
#include "integrators/tangent.hpp"

namespace {

using namespace isotach;
using model::Fabric;

const char* const kNotOneSubstep = "the increment must be one substep";

template <int N, Fabric K>
void rate_of_one_point(benchmark::State& state) {
  const model::Law<double> law(bench::slump_mud());
  auto point = bench::slump_state<N, K>();
  const auto strain_rate = bench::slump_strain_rate<N>();
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(law.rate(point, strain_rate));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(rate_of_one_point<4, Fabric::none>);
BENCHMARK(rate_of_one_point<6, Fabric::none>);
BENCHMARK(rate_of_one_point<6, Fabric::omega>);

// What an explicit code asks of one point: two rates, the error estimate, four components.
void substep_of_one_plane_point(benchmark::State& state) {
  using State = model::State<double, model::kPlane, Fabric::none>;
  using Rate = model::StateRate<double, model::kPlane, Fabric::none>;
  const model::Law<double> law(bench::slump_mud());
  auto point = bench::slump_state<model::kPlane, Fabric::none>();
  auto strain_rate = bench::slump_strain_rate<model::kPlane>();
  const auto tolerance = bench::slump_tolerance();
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(strain_rate);
    State moved = point;
    double substep = 0.0;
    const double norm = model::norm_of<double, model::kPlane>(strain_rate);
    const auto done = integrators::fellin_ostermann_substeps(
        moved, bench::kStep, tolerance, substep,
        [&](const State& y, Rate& f) {
          if (!law.in_domain(y)) return false;
          f = law.rate(y, strain_rate, norm);
          return true;
        },
        [&law](const State& y) { return law.in_domain(y); }, [](double) {});
    if (done->accepted != 1) state.SkipWithError(kNotOneSubstep);
    benchmark::DoNotOptimize(moved);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(substep_of_one_plane_point);

template <Fabric K>
void increment_without_tangent(benchmark::State& state) {
  const model::Law<double> law(bench::slump_mud());
  auto point = bench::slump_state<model::kGeneral, K>();
  auto loading =
      integrators::strain_increment<double>(bench::slump_strain_rate<model::kGeneral>(), bench::kStep);
  const auto tolerance = bench::slump_tolerance();
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(loading);
    const auto done = integrators::integrate_fellin_ostermann(law, point, loading, tolerance);
    if (done->statistics.accepted != 1) state.SkipWithError(kNotOneSubstep);
    benchmark::DoNotOptimize(done);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(increment_without_tangent<Fabric::none>);
BENCHMARK(increment_without_tangent<Fabric::omega>);

template <Fabric K>
void increment_with_tangent(benchmark::State& state) {
  const model::Law<double> law(bench::slump_mud());
  auto point = bench::slump_state<model::kGeneral, K>();
  auto loading =
      integrators::strain_increment<double>(bench::slump_strain_rate<model::kGeneral>(), bench::kStep);
  const auto tolerance = bench::slump_tolerance();
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(loading);
    const auto done = integrators::integrate_with_tangent(law, point, loading, tolerance);
    if (done->result.statistics.accepted != 1) state.SkipWithError(kNotOneSubstep);
    benchmark::DoNotOptimize(done);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(increment_with_tangent<Fabric::none>);
BENCHMARK(increment_with_tangent<Fabric::omega>);

void increment_by_reference(benchmark::State& state) {
  const model::Law<double> law(bench::slump_mud());
  const auto point = bench::slump_state<model::kGeneral, Fabric::omega>();
  const auto loading =
      integrators::strain_increment<double>(bench::slump_strain_rate<model::kGeneral>(), bench::kStep);
  for (auto _ : state) benchmark::DoNotOptimize(integrators::integrate_cvode(law, point, loading, {}));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(increment_by_reference);

}  // namespace
