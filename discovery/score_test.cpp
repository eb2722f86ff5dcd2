// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/score_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/limits.hpp"
#include "discovery/noise_replicates.hpp"

namespace isotach::discovery {

namespace {

constexpr double kNothingLeft = 1e-6;  // of a signature's norm: round-off of the projection
constexpr unsigned kSeed = 1;

/// The effect with its shape parameters at a factor of their typical values, at amplitude zero.
std::vector<effects::Chosen<double>> shapes_of(const effects::Effect& effect) {
  std::vector<effects::Chosen<double>> shapes{effects::with_amplitude(effect, 0.0)};
  for (std::size_t k = 1; k < effect.parameters.size(); ++k) {
    const effects::EffectParameter& info = effect.parameters[k];
    if (!info.searched()) continue;
    for (const double factor : {kShapeStep, 1.0 / kShapeStep}) {
      effects::Chosen<double> shape = effects::with_amplitude(effect, 0.0);
      shape.si[k] =
          std::clamp(factor * info.typical_si(), info.lower_si() + 1e-3 * info.typical_si(), info.upper_si());
      shapes.push_back(shape);
    }
  }
  return shapes;
}

bool one_sided(const effects::Effect& effect) {
  return effect.parameters[0].lower >= 0.0;
}

/// Whether an effect's signature may count: with its sign, unless both are admissible.
double counted(const Signature& signature, double z) {
  return one_sided(*signature.effect) ? std::max(z, 0.0) : std::abs(z);
}

const Signature* best_signature(const ScoreTest& test, const effects::Effect& effect) {
  const Signature* best = nullptr;
  for (const Signature& signature : test.signatures) {
    if (signature.effect != &effect) continue;
    if (best == nullptr || counted(signature, signature.z) > counted(*best, best->z)) best = &signature;
  }
  return best;
}

}  // namespace

std::vector<double> largest_under_noise(const std::vector<Signature>& signatures) {
  const auto n = static_cast<Eigen::Index>(signatures.size());
  if (n == 0) return {};
  Eigen::MatrixXd all(signatures.front().unit.size(), n);
  for (Eigen::Index k = 0; k < n; ++k) all.col(k) = signatures[static_cast<std::size_t>(k)].unit;
  std::vector<double> largest;
  Eigen::VectorXd noise(n);
  for_noise_along(all, kSeed, [&](const Eigen::VectorXd& z) {
    double most = 0.0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double size = counted(signatures[static_cast<std::size_t>(k)], z[k]);
      most = std::max(most, size * size);
    }
    largest.push_back(most);
  });
  std::sort(largest.begin(), largest.end());
  return largest;
}

Signature signature_of(const effects::Effect* effect, const Eigen::VectorXd& change, const Projection& base,
                       const Eigen::VectorXd& residuals) {
  const double norm = change.norm();
  const Eigen::VectorXd left = base.freed(change);
  Signature found{effect, Eigen::VectorXd::Zero(change.size()), 1.0, 0.0};
  if (norm > 0.0 && left.norm() > kNothingLeft * norm) {
    found.absorbed = std::sqrt(std::max(0.0, 1.0 - left.squaredNorm() / (norm * norm)));
    found.unit = left.normalized();
    found.z = -found.unit.dot(residuals);
  }
  return found;
}

double gain_of(const Signature& signature) {
  const double size = counted(signature, signature.z);
  return size * size;
}

double ScoreTest::p_value(double largest) const {
  const auto above = null_largest.end() - std::lower_bound(null_largest.begin(), null_largest.end(), largest);
  return replicated_p(above, null_largest.size());
}

std::string p_words(double p) {
  constexpr double kLeast = 1.0 / (kReplicates + 1.0);
  constexpr double kRoundOff = 1e-9;
  return p > kLeast * (1.0 + kRoundOff) ? fmt::format("p = {:.2g}", p) : fmt::format("p < {:.1g}", kLeast);
}

tl::expected<ScoreTest, calibration::FitFailure> score(
    const datasets::Study& study, const Candidate& model, const std::vector<const effects::Effect*>& effects,
    const std::vector<calibration::ExperimentWeights>& weights, int threads) {
  const calibration::OedometerFit& fit = model.fit;
  const auto linear = LinearModel::of(study, model, weights, fit.result.main.coordinates, threads);
  if (!linear) return tl::unexpected(linear.error());

  ScoreTest test;
  for (const effects::Effect* effect : effects) {
    double best = 0.0;
    for (const effects::Chosen<double>& shape : shapes_of(*effect)) {
      const auto on = fit.effects.with(shape);
      if (!on) continue;  // a shape beyond its bounds
      const effects::ParameterRef amplitude{effect, 0};
      const auto all = calibration::linearise_by_effects(fit.experiments, *fit.result.parameters, fit.locals,
                                                         *on, {&amplitude, 1}, threads);
      if (!all) return tl::unexpected(calibration::FitFailure{all.error().message});
      std::vector<experiments::Linearisation> fitted;
      for (std::size_t i = 0; i < all->size(); ++i) {
        if (!fit.experiments[i]->held_out()) fitted.push_back((*all)[i]);
      }
      Signature found =
          signature_of(effect, linear->weighted(fitted).col(0), linear->parameters(), linear->residuals());
      best = std::max(best, gain_of(found));
      test.signatures.push_back(std::move(found));
    }
    test.effects.push_back(effect);
    test.best.push_back(best);
  }
  test.null_largest = largest_under_noise(test.signatures);
  return test;
}

double likeness(const ScoreTest& test, const effects::Effect& a, const effects::Effect& b) {
  const Signature* one = best_signature(test, a);
  const Signature* other = best_signature(test, b);
  return one == nullptr || other == nullptr ? 0.0 : std::abs(one->unit.dot(other->unit));
}

}  // namespace isotach::discovery
