// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How well a candidate predicts each test from the others, its own uncertainty weighed.
#pragma once

#include <vector>

#include "discovery/candidate.hpp"

namespace isotach::discovery {

/// Sum over the fitted tests t of ln p(readings of t | readings of the others), but for a constant that all
/// candidates for the same tests and `weights` share: the log predictive density of leave-one-out
/// cross-validation (Gelman, Hwang and Vehtari, Stat. Comput. 24 (2014) 997-1016), in the metric of the noise
/// and of the prediction's own covariance. A model whose parameters the other tests leave open predicts
/// vaguely, and is held to no more than that; were the misfit compared alone, it would be held to a point.
///
///   p(t | others) = Z/Z_t,  ln Z = -cost(x) - 1/2 ln det(J'J + B),
///
/// x the least of the cost with all tests, or without t for Z_t; J there; B the inverse variance of a
/// coordinate that may lie anywhere within its bounds, so that one of which nothing is known counts as that.
/// In a linear model this is the normal density of t's readings about their prediction, exactly. Both are
/// sought from `candidate`'s answer.
///
/// `weights` are those of the fitted tests, as NoiseFit's; at least two tests are fitted.
[[nodiscard]] tl::expected<double, calibration::FitFailure> log_predictive_density(
    const datasets::Study& study, const Candidate& candidate,
    const std::vector<calibration::ExperimentWeights>& weights, int threads);

}  // namespace isotach::discovery
