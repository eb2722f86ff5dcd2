// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which test would tell two explanations apart: tests already made, changed in height, rate or stages.
#pragma once

#include <optional>
#include <string>

#include "discovery/candidate.hpp"

namespace isotach::discovery {

struct NextExperiment {
  std::string test;    ///< the test that is repeated
  std::string change;  ///< in words: "at twice the height"
  double separation;   ///< of the two predictions, in standard deviations of noise and of what is not known
  double now;          ///< the same were the test repeated as it was made
};

/// The variation of a fitted test that would tell explanations a and b apart best; nothing where none could
/// be predicted. With f their predictions of the test, N the noise that it states and J C J' what the present
/// tests leave open of each prediction (C the inverse of information_of),
///
///   separation^2 = (f_a - f_b)' (N + J_a C_a J_a' + J_b C_b J_b')^-1 (f_a - f_b),
///
/// the criterion of Box and Hill, Technometrics 9 (1967) 57-71, for two models: a difference that either
/// explanation could take up by other parameters counts for nothing. `weights` are those of the fitted tests.
[[nodiscard]] std::optional<NextExperiment> tell_apart(
    const datasets::Study& study, const Candidate& a, const Candidate& b,
    const std::vector<calibration::ExperimentWeights>& weights, int threads);

/// The test as the variation of that name has it, its new readings with the last stress read in place of
/// their own; nothing where there is no such variation or the test cannot have it.
[[nodiscard]] std::optional<datasets::OedometerTest> varied(const datasets::OedometerTest& test,
                                                            const std::string& change);

}  // namespace isotach::discovery
