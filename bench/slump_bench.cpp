// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cost of a particle step and of the whole slump of test 1, and of a step against the number of points.
#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <vector>

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

/// Gives the points of a run that has not begun places off their lattice and the motion of a slump, |D|
/// = 1.2/s: the hours that a fine grid would need to get there are no part of what is measured.
struct SetInMotion {
  void operator()(mpm::Engine& engine) const {
    constexpr double kRate = 1.0;    // 1/s
    constexpr double kShift = 0.25;  // of a point's width
    mpm::Particles& q = engine.particles(0);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-kShift, kShift);
    const double width = 0.5 * engine.grid().cell_size();
    for (std::size_t i = 0; i < q.count; ++i) {
      q.r[i] += width * shift(random);
      q.z[i] += width * shift(random);
      q.c_rr[i] = 0.5 * kRate;
      q.c_zz[i] = -kRate;
      q.velocity_r[i] = q.c_rr[i] * q.r[i];
      q.velocity_z[i] = q.c_zz[i] * q.z[i];
    }
  }
};

double bytes_of_arrays(mpm::Particles particles) {
  double bytes = 0.0;
  particles.for_each_array(
      [&](const mpm::PointArray& array) { bytes += sizeof(double) * double(array.size()); });
  return bytes;
}

/// Memory in use (bytes).
double resident() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * double(sysconf(_SC_PAGESIZE));
}

/// The most that was in use so far (bytes).
double peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

// A step against the number of points: cells in micrometres, threads. Both kinds of bytes are a point's:
// those of the points' arrays, and those that the process grew by at most, grid and start included; the
// latter only means something while each size is larger than all before it. Substeps of the law cost several
// times a step of it, so `substepped` says in how many per cent of the updates the motion asked for them.
void step_of_many(benchmark::State& state) {
  datasets::SlumpFile test = test_1(1e-6 * static_cast<double>(state.range(0)));
  test.setup.numerics.inertia_scaling = 1.0;
  test.setup.numerics.threads = static_cast<int>(state.range(1));
  const double before = resident();
  mpm::SlumpRun run(test.material, test.setup);
  SetInMotion set_in_motion;
  run.visit(set_in_motion);
  if (run.step(HUGE_VAL)) state.SkipWithError("the run failed");  // sorts the points, makes the threads
  const long before_timing = run.substepped();
  for (auto _ : state) {
    if (run.step(HUGE_VAL)) state.SkipWithError("the run failed");
  }
  const auto points = static_cast<double>(run.particles().count);
  const long substepped = run.substepped() - before_timing;
  state.counters["substepped"] = 100.0 * double(substepped) / (points * double(state.iterations()));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.particles().count));
  state.counters["points"] = points;
  state.counters["process_bytes"] = (peak() - before) / points;
  state.counters["array_bytes"] = bytes_of_arrays(run.particles()) / points;
}
// 8, 26, 83, 264 and 528 cells across the mould's radius; the time of one thread is its own, that of two the
// clock's
BENCHMARK(step_of_many)->Args({4875, 1})->Iterations(640)->Unit(benchmark::kMillisecond);
BENCHMARK(step_of_many)->Args({1500, 1})->Iterations(320)->Unit(benchmark::kMillisecond);
BENCHMARK(step_of_many)->Args({470, 1})->Iterations(64)->Unit(benchmark::kMillisecond);
BENCHMARK(step_of_many)->Args({148, 1})->Iterations(32)->Unit(benchmark::kMillisecond);
BENCHMARK(step_of_many)->Args({148, 2})->Iterations(32)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(step_of_many)->Args({74, 1})->Iterations(8)->Unit(benchmark::kMillisecond);

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
