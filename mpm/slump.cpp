// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/slump.hpp"

#include <cmath>

#include "mpm/slump_run.hpp"

namespace isotach::mpm {

namespace {

constexpr int kHistoryRows = 300;
constexpr double kEarliestHistory = 0.02;  // s; rows are dense early, when the slump is fast
constexpr long kStepsBetweenChecks = 256;

/// Times of history rows: geometric from kEarliestHistory to the end, and the output times.
std::vector<double> history_times(const std::vector<double>& outputs) {
  const double end = outputs.back();
  std::vector<double> times = outputs;
  const double first = std::min(kEarliestHistory, end);
  for (int i = 0; i <= kHistoryRows; ++i)
    times.push_back(first * std::pow(end / first, double(i) / kHistoryRows));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  while (times.back() > end) times.pop_back();
  return times;
}

double energy(const HistoryRow& row) {
  return row.kinetic + row.potential + row.stress_work + row.boundary_work;
}

}  // namespace

tl::expected<SlumpResult, SlumpFailure> run_slump(const model::Parameters<double>& parameters,
                                                  const SlumpSetup& setup, const RunOptions& options) {
  SlumpRun run(parameters, setup);
  SlumpResult result;
  result.initial = run.initial();
  result.cell_size = run.cell_size();
  result.points = run.particles().count;
  const HistoryRow start = run.history_row();
  const double outline_volume_0 = run.outline().volume();
  result.history.push_back(start);

  std::size_t next_output = 0;
  for (const double target : (options.history ? history_times(setup.times) : setup.times)) {
    while (run.time() < target) {
      if (auto failure = run.step(target)) return tl::unexpected(*failure);
      if (run.steps() % kStepsBetweenChecks == 0) {
        if (options.stop != nullptr && options.stop->load()) {
          return tl::unexpected(
              SlumpFailure{SlumpFailure::Kind::interrupted, run.time(), 0.0, 0.0, "the run was interrupted"});
        }
        if (options.progress) options.progress(run.time());
      }
    }
    result.history.push_back(run.history_row());
    const HistoryRow& row = result.history.back();
    result.volume_error = std::max(result.volume_error, std::abs(row.volume / start.volume - 1.0));
    result.energy_error =
        std::max(result.energy_error, std::abs(energy(row) - energy(start)) / start.potential);
    if (next_output < setup.times.size() && target == setup.times[next_output]) {
      result.outlines.push_back(run.outline());
      const Outline& outline = result.outlines.back();
      if (outline.points.size() < 3) {
        return tl::unexpected(SlumpFailure{SlumpFailure::Kind::no_outline, run.time(), 0.0, 0.0,
                                           "no outline from base to axis could be traced"});
      }
      result.outline_volume_error =
          std::max(result.outline_volume_error, std::abs(outline.volume() / outline_volume_0 - 1.0));
      if (options.snapshots) result.snapshots.push_back(run.snapshot());
      ++next_output;
    }
  }
  result.steps = run.steps();
  result.particle_steps = static_cast<double>(run.steps()) * static_cast<double>(result.points);
  result.substepped = run.substepped();
  result.floored = run.floored();
  return result;
}

}  // namespace isotach::mpm
