// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What rank 0 does beside simulating: a row in the journal and the messages of a simulation.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>

#include "cluster/message.hpp"
#include "datasets/study.hpp"
#include "journal/journal.hpp"
#include "mpm/code_version.hpp"

namespace isotach {
namespace {

/// slump-1 of mud-a at the study's start and its simulation.
struct Example {
  cluster::Task task;
  journal::Simulation simulation;
};

const Example& example() {
  static const Example made = [] {
    const datasets::Study study = datasets::read_study(ISOTACH_SOURCE_DIR "/datasets/mud-a/study.toml");
    const mpm::SlumpSetup& setup = study.slump_tests.front().setup;
    return Example{{study.material, setup, 3600.0}, journal::simulate(study.material, setup, {})};
  }();
  return made;
}

/// The same material with another I_v, and so another key, for each number.
model::Parameters<double> material_number(long number) {
  model::ParameterValues<double> values = example().task.parameters.values();
  values[model::ParameterId::I_v] *= 1.0 + 1e-9 * static_cast<double>(number);
  return model::Parameters<double>::create(values).value();
}

/// Rows on the disk, one after the other; the file lies in the working folder.
void journal_rows(benchmark::State& state, journal::JournalMode mode, journal::Synchronous synchronous) {
  const std::filesystem::path file = "journal-bench.sqlite";
  const Example& row = example();
  std::filesystem::remove(file);
  {
    journal::JournalOptions options;
    options.mode = mode;
    options.synchronous = synchronous;
    journal::Journal journal(file, options);
    long number = 0;
    for (auto _ : state) {
      journal.put({row.simulation,
                   journal::Inputs(material_number(number++), row.task.setup, mpm::code_version()), "slump-1",
                   row.task.time_limit});
    }
  }
  state.SetItemsProcessed(state.iterations());
  std::filesystem::remove(file);
}
BENCHMARK_CAPTURE(journal_rows, rollback_full, journal::JournalMode::rollback, journal::Synchronous::full)
    ->UseRealTime();
BENCHMARK_CAPTURE(journal_rows, rollback_off, journal::JournalMode::rollback, journal::Synchronous::off)
    ->UseRealTime();
BENCHMARK_CAPTURE(journal_rows, wal_full, journal::JournalMode::wal, journal::Synchronous::full)
    ->UseRealTime();
BENCHMARK_CAPTURE(journal_rows, wal_normal, journal::JournalMode::wal, journal::Synchronous::normal)
    ->UseRealTime();

/// Both messages of a simulation, written and read.
void messages(benchmark::State& state) {
  std::string task;
  std::string answer;
  for (auto _ : state) {
    task = cluster::bytes_of(example().task);
    answer = cluster::bytes_of(example().simulation);
    benchmark::DoNotOptimize(cluster::task_of(task));
    benchmark::DoNotOptimize(cluster::simulation_of(answer));
  }
  state.counters["task_bytes"] = static_cast<double>(task.size());
  state.counters["answer_bytes"] = static_cast<double>(answer.size());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(messages);

}  // namespace
}  // namespace isotach
