// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/reference_numerics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/parallel.hpp"

namespace isotach::calibration {

bool has_reference(const datasets::Study& study) {
  return std::any_of(study.slump_tests.begin(), study.slump_tests.end(),
                     [](const auto& test) { return test.reference.has_value(); });
}

double reference_cost(const datasets::Study& study) {
  if (!has_reference(study)) return 0.0;
  const datasets::SlumpTest& test = study.slump_tests.front();
  const double finer = test.setup.numerics.cell_size / test.best_setup().numerics.cell_size;
  const double points = static_cast<double>(test.best_setup().numerics.points_per_cell) /
                        static_cast<double>(test.setup.numerics.points_per_cell);
  return finer * finer * finer * points;
}

tl::expected<Corrections, FitFailure> measure_corrections(
    const datasets::Study& study,
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests,
    const model::Parameters<double>& parameters, const std::vector<std::vector<double>>& locals, int threads,
    Corrected which) {
  Corrections corrections;
  if (!has_reference(study)) return corrections;
  using Run = tl::expected<mpm::SlumpResult, experiments::PredictionFailure>;
  std::vector<std::optional<Run>> runs(2 * tests.size());  // of the reference first: they take longer
  const auto wanted = [&](std::size_t i) { return which == Corrected::all_tests || !tests[i]->held_out(); };
  parallel_for(runs.size(), threads, [&](std::size_t k) {
    const std::size_t i = k % tests.size();
    if (!wanted(i)) return;
    runs[k] = k < tests.size() ? tests[i]->simulate_at_best(parameters, locals[i])
                               : tests[i]->simulate(parameters, locals[i]);
  });
  double squares[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < tests.size(); ++i) {
    corrections.tests.emplace_back();
    if (!wanted(i)) continue;
    const Run& best = *runs[i];
    const Run& quick = *runs[tests.size() + i];
    for (const Run* run : {&best, &quick}) {
      if (!*run && run->error().interrupted) return tl::unexpected(FitFailure{"interrupted", true});
    }
    if (!best || !quick) {
      ++corrections.failed;
      continue;
    }
    experiments::Values change = tests[i]->distances(*best);
    const experiments::Values before = tests[i]->distances(*quick);
    for (std::size_t p = 0; p < change.size(); ++p) {
      change[p] -= before[p];
      const std::size_t kind = tests[i]->mould_gone()[p] ? 0 : 1;
      squares[kind] += change[p] * change[p];
      counts[kind] += 1.0;
    }
    corrections.tests.back() = std::move(change);
  }
  if (counts[0] > 0.0) corrections.outline = std::sqrt(squares[0] / counts[0]);
  if (counts[1] > 0.0) corrections.lifting = std::sqrt(squares[1] / counts[1]);
  return corrections;
}

}  // namespace isotach::calibration
