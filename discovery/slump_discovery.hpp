// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Does the model suffice for a study's slump tests? If not: where does it fail, what is missing, how sure,
// and what would decide?
#pragma once

#include <limits>

#include "discovery/discover.hpp"
#include "discovery/slump_candidate.hpp"

namespace isotach::discovery {

/// A part of a slump's outline, by the share of its length from the toe.
enum class Zone { toe, flank, top };
[[nodiscard]] std::string_view name_of(Zone zone);

/// Where the base disagrees with the data: a zone of the outlines at one time.
struct SlumpDisagreement {
  std::string test;
  bool held_out;
  Zone zone;
  bool lifting;  ///< the rim is still below the top of the mud
  double from;   ///< s, the outline before
  double to;     ///< s, the outline
  double mean;   ///< m, of measured less simulated, outwards
  double score;  ///< root of the sum of squares beyond that of noise, in units of noise
  /// Root of the sum of squares of what an explanation changes there, in units of the noise and of what
  /// simulations are unsure of: nearly free of noise. Nothing where there is no explanation, or the test is
  /// held out.
  std::optional<double> explained = std::nullopt;
  /// The mean (m) with the best trial; NaN without one.
  double mean_by_best = std::numeric_limits<double>::quiet_NaN();
};

/// A set of effects that was tried.
struct SlumpTrial {
  SlumpCandidate candidate;
  Adequacy adequacy;
  Gap gap;
  bool adequate = false;
  std::vector<mpm::SlumpResult> simulations;  ///< of all tests, where they were asked for
};

/// What an effect at its typical strength does to residuals, freed of what the base's parameters can do.
struct SlumpSignature {
  const effects::Effect* effect;
  Eigen::VectorXd change;  ///< of residuals for the typical amplitude
  Signature signature;
  double amplitude = 0.0;  ///< that improves the fit most, by linearisation, in typical ones
};

struct SlumpDiscovery {
  Verdict verdict = Verdict::adequate;
  SlumpTrial base;
  /// Whether an effect's gain can reject the base, and not the size of the misfit alone: where the study has
  /// reference numerics.
  bool by_gain = false;
  /// That noise lets some effect gain as much as those that were fitted; NaN where none was.
  double p_value = std::numeric_limits<double>::quiet_NaN();
  double scale = 1.0;  ///< of the residuals' variance, by the best candidate; at least 1
  std::vector<SlumpSignature> signatures;
  std::vector<SlumpTrial> trials;  ///< by BIC, the best first
  std::vector<std::pair<const effects::Effect*, std::string>> not_tried;
  std::optional<std::size_t> chosen;
  std::vector<AmplitudeInterval> amplitudes;  ///< of what is chosen
  std::vector<std::size_t> equivalent;
  std::vector<Condition> conditions;
  std::vector<SlumpDisagreement> disagreement;  ///< ranked
  /// Gap of the best trial without the first's effects (fitted tests); NaN where there is none.
  double best_wrong = std::numeric_limits<double>::quiet_NaN();
  double smoother = 0.0;
  std::optional<NextExperiment> next;
  std::optional<Wandering> wandering;  ///< slots let wander on the base, where effects were tried
  long simulations = 0;
  std::vector<std::string> warnings;

  /// What was chosen, else the base.
  [[nodiscard]] const SlumpTrial& answer() const { return chosen ? trials[*chosen] : base; }
};

/// What oedometer tests say of the material beforehand.
struct MaterialKnowledge {
  model::Parameters<double> parameters;
  std::array<std::optional<datasets::Prior>, model::kParameterCount> priors;
};
/// That of a fit whose model meets its data: its answer, and the standard errors of what it determined.
[[nodiscard]] MaterialKnowledge knowledge_of(const calibration::OedometerFit& fit);

struct SlumpDiscoverOptions {
  int threads = 1;
  calibration::OptimiserControl control;
  experiments::Simulate simulate;              ///< where empty, mpm::run_slump until control.stop
  std::optional<MaterialKnowledge> knowledge;  ///< where absent, fits start from the study's material
  std::function<void(double, const std::string&)> progress;
};

/// Fits the base to the slump tests that are not held out, then the effects that score best.
[[nodiscard]] tl::expected<SlumpDiscovery, calibration::FitFailure> discover_slump(
    const datasets::Study& study, const SlumpDiscoverOptions& options);

}  // namespace isotach::discovery
