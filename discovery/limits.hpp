// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Where discovery draws its lines, and why there.
#pragma once

#include <cstddef>

namespace isotach::discovery {

/// The base is rejected where noise alone would let some effect of the catalogue improve the fit as much in
/// less than so many cases (parametric bootstrap of the largest of all): a null in five hundred gets as far
/// as the other conditions of a name.
inline constexpr double kRejects = 0.002;
/// Replicates of that bootstrap: ten beyond the level.
inline constexpr int kReplicates = 5000;
/// What is left of an extended model may not look, at this level, as if a further effect were needed: looser
/// than kRejects, for a name should leave nothing behind.
inline constexpr double kLeavesNothing = 0.01;
/// Difference of BIC by which a name must be better than any other: 6 is "strong" by Kass & Raftery (1995),
/// odds of 20 to 1. It is asked with the shapes of effects charged and without: BIC's ln n for a parameter is
/// what n readings that determine it are worth, and a weak effect's shape is hardly determined, so that its
/// charge alone would make a rival lose that fits as well.
inline constexpr double kMargin = 6.0;
/// A stage is missed where noise alone would miss it by as much in so few cases; as fits have it for
/// independent noise.
inline constexpr double kStageRare = 1e-3;
/// Largest correlation from reading to reading, of the part that lasts, that is taken for the apparatus's
/// where stages are judged: beyond it residuals keep their side over ten readings, and that is misfit sooner
/// than noise.
inline constexpr double kNoiseCorrelation = 0.8;
/// A name is refused where tests left out of the fit are predicted worse with it than by the base: by the sum
/// over tests of the log predictive density, which weighs the uncertainty that the other tests leave in the
/// parameters (left_out.hpp). The base has been rejected by the data as a whole, so the burden is on the
/// refusal: with two tests, one of which alone does not hold the base's parameters, both predict vaguely, and
/// that says nothing against the name. An effect that one test calls for and another refutes is far below.
inline constexpr double kPredictsNoWorse = 0.0;
/// A constant of the material that ends at its bound counts as needed there where its release would gain so
/// much of chi-squared: the best value then lies two standard errors beyond what the study allows, where a
/// constant that the data leave open, or whose true value is the bound, hardly ever has it.
inline constexpr double kBeyondBound = 4.0;
/// Effects that are refitted, the best by score first: a score is taken at zero of the amplitude and may
/// misjudge a strong effect's rank, hardly by so many places.
inline constexpr std::size_t kRefitted = 6;
/// Effects that are tried two at a time.
inline constexpr std::size_t kPaired = 4;
/// The same of slump tests, where a fit is a dozen sets of simulations.
inline constexpr std::size_t kSlumpRefitted = 3;
inline constexpr std::size_t kSlumpPaired = 3;
/// Sigma, freed of what the base can do, by which an effect should show where its signature is taken: what
/// two simulations differ by for no reason is a part of one. An effect that its typical amplitude shows less
/// is taken at a larger one, of at most so many typical ones.
inline constexpr double kSlumpShows = 5.0;
inline constexpr double kSlumpLargest = 30.0;
/// A second effect is fitted beside another where noise would let some effect promise as much, to first
/// order, in so few cases: ten times kLeavesNothing, as promises are secants.
inline constexpr double kSlumpPromise = 0.1;
/// Knots of a function along which a slot wanders: each costs power against a drift or a bend, and what needs
/// more of them is seen better in the residuals.
inline constexpr std::size_t kWanderKnots = 4;
/// A direction of such functions is looked along where a change of the slot's plausible size shows by so many
/// sigma.
inline constexpr double kWanderShows = 1.0;
/// Share of its size to which a name's shape parameters are tried, and its inverse, in the score.
inline constexpr double kShapeStep = 3.0;

}  // namespace isotach::discovery
