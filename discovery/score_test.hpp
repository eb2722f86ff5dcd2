// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What each effect of the catalogue would do to residuals, at zero of its amplitude: Rao's score test.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "discovery/linear_model.hpp"

namespace isotach::discovery {

/// An effect's signature: d residuals/d amplitude, whitened, freed of what the base's parameters can do.
struct Signature {
  const effects::Effect* effect;
  Eigen::VectorXd unit;   ///< of unit norm; zero where the base can do all of it
  double absorbed = 0.0;  ///< share of the signature's norm that the base's parameters take up, in [0, 1]
  double z = 0.0;  ///< how many standard deviations of noise the residuals lie along it, signed: positive
                   ///< where the admissible amplitude improves the fit
};

struct ScoreTest {
  std::vector<Signature> signatures;  ///< of every effect several, by its shape
  /// The largest of z^2 of the signatures of one effect, in the order of `effects`.
  std::vector<const effects::Effect*> effects;
  std::vector<double> best;
  /// Probability that noise makes the largest of all as large, by parametric bootstrap; at least
  /// 1/(kReplicates + 1), which stands for "less than that".
  [[nodiscard]] double p_value(double largest) const;
  std::vector<double> null_largest;  ///< sorted, of the bootstrap
};

/// Of a change that an effect makes of `residuals`.
[[nodiscard]] Signature signature_of(const effects::Effect* effect, const Eigen::VectorXd& change,
                                     const Projection& base, const Eigen::VectorXd& residuals);

/// The largest of the signatures' z^2 under noise, each with its admissible sign: kReplicates of them,
/// sorted.
[[nodiscard]] std::vector<double> largest_under_noise(const std::vector<Signature>& signatures);
/// z^2, zero where z has a sign that the effect's amplitude cannot have.
[[nodiscard]] double gain_of(const Signature& signature);

/// Scores of `effects` on top of `model`, by `weights` (of the fitted tests, as NoiseFit's).
[[nodiscard]] tl::expected<ScoreTest, calibration::FitFailure> score(
    const datasets::Study& study, const Candidate& model, const std::vector<const effects::Effect*>& effects,
    const std::vector<calibration::ExperimentWeights>& weights, int threads);

/// A probability of that bootstrap as text: "p = 0.03", or "p < 0.0002" where no replicate came as far and
/// the number is only what so many of them can tell.
[[nodiscard]] std::string p_words(double p);

/// |cosine| of the best signatures of two effects.
[[nodiscard]] double likeness(const ScoreTest& test, const effects::Effect& a, const effects::Effect& b);

}  // namespace isotach::discovery
