// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cost of the stress update of many points in packs, and what share of the machine's arithmetic that is.
#include <benchmark/benchmark.h>

#include <cstdint>

#include "bench/counted.hpp"
#include "bench/slump_point.hpp"
#include "mpm/lanes.hpp"
#include "mpm/materials/vhp.hpp"
#include "tests/moving_points.hpp"

namespace {

using namespace isotach;
using model::Fabric;
using model::kPlane;

constexpr double kGiga = 1e9;

// Independent chains of fused multiply-adds, as many as hide their latency: what the arithmetic units can do.
double measured_peak_of(benchmark::State& state) {
  constexpr std::size_t kChains = 12;
  mpm::Packet chain[kChains];
  for (mpm::Packet& packet : chain) packet = Eigen::internal::pset1<mpm::Packet>(1.0);
  mpm::Packet factor = Eigen::internal::pset1<mpm::Packet>(0.999);
  const mpm::Packet term = Eigen::internal::pset1<mpm::Packet>(1e-3);
  constexpr int kTurns = 1000;
  for (auto _ : state) {
    for (int turn = 0; turn < kTurns; ++turn) {
#pragma GCC unroll 12
      for (std::size_t i = 0; i < kChains; ++i) chain[i] = Eigen::internal::pmadd(chain[i], factor, term);
    }
    benchmark::DoNotOptimize(factor);
  }
  double sum = 0.0;
  for (const mpm::Packet& packet : chain) sum += Eigen::internal::pfirst(packet);
  benchmark::DoNotOptimize(sum);
  return 2.0 * kTurns * kChains * mpm::kPacketSize * static_cast<double>(state.iterations());
}

void peak_of_multiply_add(benchmark::State& state) {
  const double operations = measured_peak_of(state);
  state.counters["GFlop/s"] = benchmark::Counter(operations / kGiga, benchmark::Counter::kIsRate);
}
BENCHMARK(peak_of_multiply_add);

/// Operations of one update: two rates, the midpoint step and the error estimate of the law itself.
bench::Operations operations_of_one_update() {
  using bench::Counted;
  const model::Law<double> law(bench::slump_mud());
  const auto plain_state = bench::slump_state<kPlane, Fabric::none>();
  const auto plain_rate = bench::slump_strain_rate<kPlane>();
  model::State<Counted, kPlane, Fabric::none> y;
  model::Mandel<Counted, kPlane> strain_rate;
  for (int k = 0; k < kPlane; ++k) {
    y.stress[k] = Counted(plain_state.stress[k]);
    strain_rate[k] = Counted(plain_rate[k]);
  }
  y.void_ratio = Counted(plain_state.void_ratio);
  Eigen::Matrix<Counted, 3, 1> spin;
  spin[0] = spin[1] = spin[2] = Counted(0.0);
  const Counted half(0.5 * bench::kStep);
  const Counted whole(bench::kStep);

  Counted::operations = {};
  const Counted norm = model::norm_of<Counted, kPlane>(strain_rate);
  auto f = law.rate(y, strain_rate, norm);
  model::add_corotation(f, y, spin);
  const auto y_half = advanced(y, f, half);
  auto f_half = law.rate(y_half, strain_rate, norm);
  model::add_corotation(f_half, y_half, spin);
  const auto end = advanced(y, f_half, whole);
  const model::Mandel<Counted, kPlane> difference = (f_half.stress - f.stress) * half;
  const Counted error = difference.squaredNorm() / end.stress.squaredNorm();
  benchmark::DoNotOptimize(error.value);
  return Counted::operations;
}

template <Fabric K>
void update_of_many_points(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const bool rotates = K == Fabric::omega;
  tests::MovingPoints particles(count, rotates);
  const std::size_t padded = particles.spin.size();
  particles.void_ratio.assign(padded, bench::kVoidRatio);
  for (std::size_t i = 0; i < padded; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(padded);
    particles.strain_rate[0][i] = bench::kRate * share;
    particles.strain_rate[1][i] = -bench::kRate * share;
    particles.strain_rate[3][i] = bench::kRate * (1.0 - share);
    particles.spin[i] = bench::kRate * share;
  }
  const auto mud = rotates ? bench::slump_mud(10.0, 0.3) : bench::slump_mud();
  const mpm::VhpMaterial material(mud, {bench::slump_tolerance().relative, 1e-3 * bench::kPressure, 300e3});
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t k = 0; k < 3; ++k) particles.stress[k].assign(padded, -bench::kPressure);
    state.ResumeTiming();
    if (tests::update(material, particles, bench::kStep).substepped > 0)
      state.SkipWithError("points left the common path");
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  if (!rotates) {
    const bench::Operations operations = operations_of_one_update();
    const double updates = static_cast<double>(state.iterations() * state.range(0));
    state.counters["flop"] = operations.simple + operations.quotients + operations.roots;
    state.counters["exp+log"] = operations.functions;
    state.counters["GFlop/s"] =
        benchmark::Counter(updates * operations.elementary() / kGiga, benchmark::Counter::kIsRate);
  }
}
BENCHMARK(update_of_many_points<Fabric::none>)->Arg(1440)->Arg(5760);
BENCHMARK(update_of_many_points<Fabric::omega>)->Arg(1440);

}  // namespace
