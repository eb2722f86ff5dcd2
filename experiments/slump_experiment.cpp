// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/slump_experiment.hpp"

#include <algorithm>

#include "experiments/outline_distance.hpp"

namespace isotach::experiments {

SlumpExperiment::SlumpExperiment(datasets::SlumpTest test, Simulate simulate)
    : test_(std::move(test)), simulate_(std::move(simulate)) {
  for (std::size_t k = 0; k < test_.outlines.size(); ++k) {
    const datasets::Outline& outline = test_.outlines[k];
    double top = 0.0;
    for (const auto& point : outline.points) top = std::max(top, point.z);
    const bool gone = test_.setup.mould.rim(outline.time) >= top;
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
      zeros_.push_back(0.0);
      noise_.push_back(gone ? test_.noise.outline : test_.noise.lifting);
      mould_gone_.push_back(gone);
      outline_index_.push_back(k);
    }
  }
}

double SlumpExperiment::cost() const {
  return test_.setup.mould.fill_height * test_.setup.mould.diameter * test_.setup.times.back();
}

tl::expected<mpm::SlumpResult, PredictionFailure> SlumpExperiment::simulate(
    const model::Parameters<double>& parameters) const {
  auto result = simulate_(test_.name, parameters, test_.setup);
  if (!result) {
    return tl::unexpected(PredictionFailure{test_.name + ": " + result.error().message,
                                            result.error().status == mpm::RunStatus::interrupted});
  }
  return std::move(*result);
}

Values SlumpExperiment::distances(const mpm::SlumpResult& result) const {
  Values values;
  values.reserve(zeros_.size());
  for (std::size_t k = 0; k < test_.outlines.size(); ++k) {
    for (const auto& point : test_.outlines[k].points) {
      values.push_back(signed_distance({point.r, point.z}, result.outlines[k].points));
    }
  }
  return values;
}

tl::expected<Values, PredictionFailure> SlumpExperiment::predict(const model::Parameters<double>& parameters,
                                                                 std::span<const double> /*local*/) const {
  const auto result = simulate(parameters);
  if (!result) return tl::unexpected(result.error());
  return distances(*result);
}

}  // namespace isotach::experiments
