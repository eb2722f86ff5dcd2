// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cost of a particle step and of the whole slump of test 1, at two cell sizes, on one thread.
#include <benchmark/benchmark.h>

#include "datasets/slump_file.hpp"
#include "mpm/slump.hpp"
#include "mpm/slump_run.hpp"

namespace {

using namespace isotach;

datasets::SlumpFile test_1(double cell_size) {
  auto test = datasets::read_slump_file(ISOTACH_SOURCE_DIR "/datasets/checks/slump-test-1.toml");
  test.setup.numerics.cell_size = cell_size;
  return test;
}

// Steps of a flow in full motion: the counter is particle steps a second. Cells in micrometres: 3000 make
// some 2400 points, 750 some 39 000.
void particle_step(benchmark::State& state) {
  datasets::SlumpFile test = test_1(1e-6 * static_cast<double>(state.range(0)));
  test.setup.numerics.inertia_scaling = 1.0;
  mpm::SlumpRun run(test.material, test.setup);
  const double moving = state.range(0) < 1000 ? 0.05 : 0.3;  // s
  while (run.time() < moving) {
    if (run.step(moving)) state.SkipWithError("the run failed");
  }
  for (auto _ : state) {
    if (run.step(HUGE_VAL)) state.SkipWithError("the run failed");
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.particles().count));
}
BENCHMARK(particle_step)->Arg(8000)->Arg(4000)->Arg(3000)->Arg(750)->Unit(benchmark::kMicrosecond);

// items_per_second is particle steps a second over the whole run of 30 s, substeps and outlines included.
void whole_slump(benchmark::State& state) {
  const datasets::SlumpFile test = test_1(1e-3 * static_cast<double>(state.range(0)));
  double particle_steps = 0.0;
  for (auto _ : state) {
    const auto result = mpm::run_slump(test.material, test.setup);
    if (!result) {
      state.SkipWithError(result.error().message.c_str());
      break;
    }
    particle_steps += result->particle_steps;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(particle_steps));
}
BENCHMARK(whole_slump)->Arg(8)->Arg(4)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
