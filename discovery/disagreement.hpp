// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where a model disagrees with the data: the stages of the tests, ranked.
#pragma once

#include <optional>
#include <vector>

#include "discovery/candidate.hpp"

namespace isotach::discovery {

/// Where the base disagrees with the data: one stage of a test.
struct Disagreement {
  std::string test;
  bool held_out;
  calibration::StageCheck stage;
  double score;  ///< root of the sum of squares beyond that of noise, in units of noise
  /// The same of what an explanation changes there and the base's parameters do not take up: nearly free of
  /// noise; nothing where there is no explanation, or the test is held out.
  std::optional<double> explained;
};

/// The stages of all tests by score, the worst first.
[[nodiscard]] std::vector<Disagreement> disagreement_of(const calibration::OedometerFit& base);

/// Ranks the stages of fitted tests by what `explanation` changes in them, before those of tests held out:
/// its effects at its own answer, by `weights`, with the least squares of what the base's parameters can do
/// there taken away. Residuals of the base name the stage where its parameters gave way, by its own idea of
/// the noise, and noise names one where the effect is weak.
[[nodiscard]] std::optional<calibration::FitFailure> rank_by_explanation(
    const datasets::Study& study, const Candidate& base, const Candidate& explanation,
    const std::vector<calibration::ExperimentWeights>& weights, int threads,
    std::vector<Disagreement>& places);

}  // namespace isotach::discovery
