// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Does the model suffice for a study's oedometer tests? If not: where does it fail, what is missing, how
// sure, and what would decide?
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "discovery/amplitude_interval.hpp"
#include "discovery/candidate.hpp"
#include "discovery/disagreement.hpp"
#include "discovery/next_experiment.hpp"
#include "discovery/score_test.hpp"
#include "discovery/wandering.hpp"

namespace isotach::discovery {

enum class Verdict {
  adequate,   ///< the base meets the data to within their noise
  named,      ///< effects are missing, and these are they
  ambiguous,  ///< something is missing, which more than one effect explains, or one that no second test tries
  unknown     ///< something is missing that no effect of the catalogue explains
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

/// Whether a model meets the data.
struct Adequacy {
  bool meets_noise = false;               ///< every test and stage within its stated noise
  double p_value = 0.0;                   ///< that noise makes any effect look so useful on top of it
  const effects::Effect* most = nullptr;  ///< the effect that looks so; null where there is none
  double wanders = 0.0;                   ///< p that noise lets a slot wander so far on top of it
};

/// A set of effects that was tried.
struct Trial {
  Candidate candidate;
  Adequacy adequacy;
  Gap gap;
  bool adequate = false;
};

/// A reason for or against a name.
struct Condition {
  std::string text;
  bool holds;
};

struct Discovery {
  Verdict verdict = Verdict::adequate;
  Trial base;
  ScoreTest scores;           ///< of all effects, on the base, by the best candidate's noise
  double p_value = 0.0;       ///< that noise makes any effect look so useful on the base
  Wandering wandering;        ///< slots let wander on the base, by the best candidate's noise
  std::vector<Trial> trials;  ///< by BIC, the best first
  std::vector<std::pair<const effects::Effect*, std::string>> not_tried;  ///< and why
  std::optional<std::size_t> chosen;                                      ///< of the trials, where named
  std::vector<AmplitudeInterval> amplitudes;                              ///< of what is chosen
  /// Trials that the data cannot tell apart, where ambiguous; the best alone where but one test is fitted.
  std::vector<std::size_t> equivalent;
  std::vector<Condition> conditions;       ///< of a name, on the best trial
  std::vector<Disagreement> disagreement;  ///< ranked, by the best trial where that is an explanation
  /// Gap of the best trial that is not the first (fitted tests); NaN where there is none.
  double best_wrong = std::numeric_limits<double>::quiet_NaN();
  double smoother = 0.0;  ///< gap that a smoother of the base's residuals leaves
  /// Where ambiguous, or unknown though the best trial meets the noise that the study states.
  std::optional<NextExperiment> next;

  /// What was chosen, else the base.
  [[nodiscard]] const Trial& answer() const { return chosen ? trials[*chosen] : base; }
};

struct DiscoverOptions {
  int threads = 1;
  calibration::OptimiserControl control;
  /// Effects of the catalogue that are not considered.
  std::vector<const effects::Effect*> without{};
  /// Fraction of the work done, and what is being done; may be empty.
  std::function<void(double, const std::string&)> progress;
};

[[nodiscard]] tl::expected<Discovery, calibration::FitFailure> discover_oedometer(
    const datasets::Study& study, const DiscoverOptions& options);

}  // namespace isotach::discovery
