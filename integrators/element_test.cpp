// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stages split into rows, each integrated from where the last one ended.
#include "integrators/element_test.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace isotach::integrators {

tl::expected<std::vector<ElementRow>, ElementFailure> run_element_test(const model::Law<double>& law,
                                                                       const model::State<double>& start,
                                                                       const std::vector<Stage>& stages,
                                                                       const Options& options) {
  for (const Stage& stage : stages) {
    if (stage.rows < 1) throw std::invalid_argument("stage \"" + stage.name + "\": rows must be >= 1");
    if (!(stage.increment.duration >= 0.0 && std::isfinite(stage.increment.duration))) {
      throw std::invalid_argument("stage \"" + stage.name + "\": duration must be >= 0 and finite");
    }
  }
  std::vector<ElementRow> rows;
  if (!model::Law<double>::in_domain(start)) {
    return tl::unexpected(ElementFailure{0, 0.0, Failure{FailureKind::outside_domain, 0.0, start}, rows});
  }
  model::State<double> state = start;
  model::Mandel<double> strain = model::Mandel<double>::Zero();
  rows.push_back({0.0, 0, strain, state, law.overconsolidation_ratio(state)});
  double stage_start = 0.0;
  for (std::size_t s = 0; s < stages.size(); ++s) {
    Increment<double> increment = stages[s].increment;
    const double duration = increment.duration;
    increment.duration = duration / stages[s].rows;
    for (int row = 1; row <= stages[s].rows; ++row) {
      const auto result = integrate(law, state, increment, options);
      if (!result) {
        const double time = rows.back().time + result.error().time;
        return tl::unexpected(ElementFailure{s, time, result.error(), std::move(rows)});
      }
      state = result->state;
      strain += result->strain;
      rows.push_back({stage_start + duration * row / stages[s].rows, s, strain, state,
                      law.overconsolidation_ratio(state)});
    }
    stage_start += duration;
  }
  return rows;
}

}  // namespace isotach::integrators
