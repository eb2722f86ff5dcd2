// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which test would tell two explanations apart: tests already made, changed in height or rate.
#pragma once

#include <optional>
#include <string>

#include "discovery/candidate.hpp"

namespace isotach::discovery {

struct NextExperiment {
  std::string test;    ///< the test that is repeated
  std::string change;  ///< in words: "at twice the height"
  double separation;   ///< of the two predictions, root of the sum of squares in units of noise
  double now;          ///< the same for the test as it was made
};

/// The variation of a fitted test in which the predictions of `a` and `b`, each at its own parameters, differ
/// most; nothing where none could be predicted.
[[nodiscard]] std::optional<NextExperiment> tell_apart(const datasets::Study& study, const Candidate& a,
                                                       const Candidate& b);

}  // namespace isotach::discovery
