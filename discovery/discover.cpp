// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/discover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discovery/left_out.hpp"
#include "discovery/limits.hpp"
#include "discovery/meets_noise.hpp"
#include "discovery/oedometer_wandering.hpp"

namespace isotach::discovery {

namespace {

using calibration::FitFailure;
using Effects = std::vector<const effects::Effect*>;

constexpr auto kNoise = calibration::NoiseParts::lasting_and_white;
constexpr std::size_t kNeighbours = 3;  // of the smoother, on either side

/// What the mean of a value's neighbours leaves of it: what a curve drawn through the readings would reach.
double smoothed_gap(const calibration::OedometerFit& fit) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    if (fit.experiments[i]->held_out()) continue;
    const experiments::Values& r = fit.evaluation.scaled_residuals[i];
    for (std::size_t k = 0; k < r.size(); ++k) {
      const std::size_t from = k > kNeighbours ? k - kNeighbours : 0;
      const std::size_t to = std::min(r.size(), k + kNeighbours + 1);
      double sum = -r[k];
      for (std::size_t j = from; j < to; ++j) sum += r[j];
      const double left = r[k] - sum / std::max(1.0, static_cast<double>(to - from - 1));
      squares += left * left;
      count += 1.0;
    }
  }
  return std::sqrt(squares / count);
}

/// The work of one study.
class Search {
 public:
  Search(const datasets::Study& study, const DiscoverOptions& options) : study_(study), options_(options) {
    fit_options_.threads = options.threads;
    fit_options_.depth = calibration::Depth::answer;
    fit_options_.control = options.control;
    fit_options_.noise = kNoise;
  }

  tl::expected<Discovery, FitFailure> run() {
    tell(0.0, "fit of the base");
    auto base = fit_with(study_, study_.material, {}, fit_options_);
    if (!base) return tl::unexpected(base.error());
    found_.base.candidate = std::move(*base);
    found_.base.gap = gap_of(found_.base.candidate.fit);
    found_.disagreement = disagreement_of(found_.base.candidate.fit);
    found_.smoother = smoothed_gap(found_.base.candidate.fit);
    choose_effects();

    tell(0.1, "scores of the effects");
    const auto first = score(study_, found_.base.candidate, effects_, found_.base.candidate.fit.noise.weights,
                             options_.threads);
    if (!first) return tl::unexpected(first.error());
    if (auto failure = try_each(by_score(*first))) return tl::unexpected(*failure);
    if (auto failure = weigh()) return tl::unexpected(*failure);
    if (rejected() && !any_adequate()) {
      if (auto failure = try_pairs()) return tl::unexpected(*failure);
      if (auto failure = weigh()) return tl::unexpected(*failure);
    }
    if (auto failure = decide()) return tl::unexpected(*failure);
    if (auto failure = place()) return tl::unexpected(*failure);
    if (found_.chosen) {
      tell(0.95, "how well its amplitude is known");
      found_.amplitudes = amplitude_intervals(study_, found_.trials[*found_.chosen].candidate, kIntervalLevel,
                                              options_.threads, options_.control);
      if (auto interrupted = stopped()) return tl::unexpected(*interrupted);
    }
    propose_next();
    tell(1.0, "done");
    return std::move(found_);
  }

 private:
  void tell(double done, const std::string& what) const {
    if (options_.progress) options_.progress(done, what);
  }
  [[nodiscard]] std::optional<FitFailure> stopped() const {
    if (options_.control.stopped()) return FitFailure{"interrupted", true};
    return std::nullopt;
  }

  /// Those of the catalogue that the base does not have and that every test can have.
  void choose_effects() {
    for (const effects::Effect* effect : effects::catalogue()) {
      if (effect->test != effects::TestKind::oedometer) continue;
      if (study_.effects.has(*effect)) {
        found_.not_tried.emplace_back(effect, "the model has it already");
      } else if (std::find(options_.without.begin(), options_.without.end(), effect) !=
                 options_.without.end()) {
        found_.not_tried.emplace_back(effect, "left out on request");
      } else if (auto why = lacks(study_, *effect)) {
        found_.not_tried.emplace_back(effect, *why);
      } else {
        effects_.push_back(effect);
      }
    }
  }

  static Effects by_score(const ScoreTest& scores) {
    std::vector<std::size_t> order(scores.effects.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return scores.best[a] > scores.best[b]; });
    Effects sorted;
    for (const std::size_t k : order) sorted.push_back(scores.effects[k]);
    return sorted;
  }

  std::optional<FitFailure> try_set(const Effects& added) {
    if (auto interrupted = stopped()) return interrupted;
    calibration::OedometerFitOptions near = fit_options_;
    near.start_from_data = false;
    auto candidate = fit_with(study_, *found_.base.candidate.fit.result.parameters, added, near);
    if (!candidate) {
      if (candidate.error().interrupted) return candidate.error();
      std::string names;
      for (const effects::Effect* effect : added) names += std::string(effect->name) + " ";
      found_.not_tried.emplace_back(added.back(),
                                    names + "could not be fitted: " + candidate.error().message);
      return std::nullopt;
    }
    Trial trial;
    trial.gap = gap_of(candidate->fit);
    trial.candidate = std::move(*candidate);
    found_.trials.push_back(std::move(trial));
    return std::nullopt;
  }

  std::optional<FitFailure> try_each(const Effects& sorted) {
    const std::size_t count = std::min(kRefitted, sorted.size());
    for (std::size_t k = 0; k < count; ++k) {
      tell(0.15 + 0.45 * static_cast<double>(k) / static_cast<double>(count),
           "fit with " + std::string(sorted[k]->name));
      if (auto failure = try_set({sorted[k]})) return failure;
    }
    for (std::size_t k = count; k < sorted.size(); ++k) {
      found_.not_tried.emplace_back(sorted[k], "others score higher");
    }
    return std::nullopt;
  }

  std::optional<FitFailure> try_pairs() {
    const std::size_t count = std::min(kPaired, found_.trials.size());
    Effects single;
    for (std::size_t k = 0; k < count; ++k) single.push_back(found_.trials[k].candidate.added.front());
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        tell(0.65 + 0.2 * static_cast<double>(a) / static_cast<double>(count),
             fmt::format("fit with {} and {}", single[a]->name, single[b]->name));
        if (auto failure = try_set({single[a], single[b]})) return failure;
      }
    }
    return std::nullopt;
  }

  /// BIC of all by one noise, the base's rejection, and whether each trial is adequate.
  std::optional<FitFailure> weigh() {
    std::vector<Candidate*> all{&found_.base.candidate};
    for (Trial& trial : found_.trials) all.push_back(&trial.candidate);
    weigh_alike(study_, all, options_.threads);
    std::stable_sort(found_.trials.begin(), found_.trials.end(),
                     [](const Trial& a, const Trial& b) { return a.candidate.bic < b.candidate.bic; });
    const calibration::OedometerFit& noise =
        found_.trials.empty() ? found_.base.candidate.fit : found_.trials.front().candidate.fit;
    auto scores = score(study_, found_.base.candidate, effects_, noise.noise.weights, options_.threads);
    if (!scores) return scores.error();
    found_.scores = std::move(*scores);
    auto wandering = let_wander(study_, found_.base.candidate, noise.noise.weights, options_.threads);
    if (!wandering) return wandering.error();
    found_.wandering = std::move(*wandering);
    const double gain = found_.trials.empty()
                            ? 0.0
                            : found_.base.candidate.chi_squared - found_.trials.front().candidate.chi_squared;
    found_.p_value = found_.scores.p_value(gain);
    found_.base.adequacy.meets_noise = meets_noise(found_.base.candidate.fit, noise.noise);
    found_.base.adequacy.p_value = found_.p_value;
    found_.base.adequacy.wanders = found_.wandering.p_value;
    found_.base.adequate = !rejected();
    for (Trial& trial : found_.trials) {
      if (trial.candidate.bic > found_.trials.front().candidate.bic + kMargin) break;
      if (auto failure = judge(trial)) return failure;
    }
    return std::nullopt;
  }

  std::optional<FitFailure> judge(Trial& trial) {
    Effects others;
    for (const effects::Effect* effect : effects_) {
      const Effects& added = trial.candidate.added;
      if (std::find(added.begin(), added.end(), effect) == added.end()) others.push_back(effect);
    }
    const auto left =
        score(study_, trial.candidate, others, trial.candidate.fit.noise.weights, options_.threads);
    if (!left) return left.error();
    trial.adequacy.meets_noise = meets_noise(trial.candidate.fit, trial.candidate.fit.noise);
    trial.adequacy.most = nullptr;
    trial.adequacy.p_value = 1.0;
    if (!left->best.empty()) {
      const auto most = std::max_element(left->best.begin(), left->best.end());
      trial.adequacy.most = left->effects[static_cast<std::size_t>(most - left->best.begin())];
      trial.adequacy.p_value = left->p_value(*most);
    }
    const auto wandering =
        let_wander(study_, trial.candidate, trial.candidate.fit.noise.weights, options_.threads);
    if (!wandering) return wandering.error();
    trial.adequacy.wanders = wandering->p_value;
    trial.adequate = trial.adequacy.meets_noise && trial.adequacy.p_value >= kLeavesNothing &&
                     trial.adequacy.wanders >= kLeavesNothing;
    return std::nullopt;
  }

  [[nodiscard]] bool rejected() const {
    return !found_.base.adequacy.meets_noise || found_.p_value < kRejects ||
           found_.wandering.p_value < kRejects;
  }
  [[nodiscard]] bool any_adequate() const {
    return std::any_of(found_.trials.begin(), found_.trials.end(),
                       [](const Trial& trial) { return trial.adequate; });
  }

  /// By how much the log predictive density of tests left out is higher with the trial's effects than by the
  /// base, by the trial's noise.
  tl::expected<double, FitFailure> predicts_better(const Trial& trial) const {
    const auto& weights = trial.candidate.fit.noise.weights;
    const auto with = log_predictive_density(study_, trial.candidate, weights, options_.threads);
    if (!with) return with;
    const auto base = log_predictive_density(study_, found_.base.candidate, weights, options_.threads);
    if (!base) return base;
    return *with - *base;
  }

  /// By how much the best trial's BIC is lower than another's, with the shapes of effects charged or not, as
  /// is less.
  [[nodiscard]] double lead_over(const Candidate& other) const {
    const Candidate& best = found_.trials.front().candidate;
    return std::min(other.bic - best.bic, other.bic_without_shapes - best.bic_without_shapes);
  }

  std::optional<FitFailure> decide() {
    if (found_.trials.size() > 1) found_.best_wrong = found_.trials[1].gap.fitted;
    if (!rejected()) {
      found_.verdict = Verdict::adequate;
      return std::nullopt;
    }
    const Trial& best = found_.trials.front();
    double lead = lead_over(found_.base.candidate);
    for (std::size_t k = 1; k < found_.trials.size(); ++k) {
      lead = std::min(lead, lead_over(found_.trials[k].candidate));
    }
    const auto require = [this](bool holds, std::string text) {
      found_.conditions.push_back({std::move(text), holds});
      return holds;
    };
    bool good = require(
        best.adequate,
        fmt::format("with {} the model meets every test and stage, no further effect is called for ({}), and "
                    "letting a constant or a reading wander helps no more than noise would ({})",
                    name_of(best.candidate), p_words(best.adequacy.p_value), p_words(best.adequacy.wanders)));
    good &= require(!best.candidate.at_bound, "its amplitude lies within its bounds and is not zero");
    const auto& beyond = best.candidate.beyond_bounds;
    good &= require(beyond.empty(),
                    beyond.empty() ? std::string("no constant of the material is held at a bound with it")
                                   : fmt::format("no constant of the material is held at a bound with it, "
                                                 "but {} would go beyond",
                                                 fmt::join(beyond, " and ")));
    if (!good) {
      found_.verdict = Verdict::unknown;
      return std::nullopt;
    }
    const bool leads = require(
        lead >= kMargin, fmt::format("its BIC is lower than that of any other, the base included, by {:.1f} "
                                     "({} asked, with shapes charged and without)",
                                     lead, kMargin));
    const auto fitted = std::count_if(study_.oedometer_tests.begin(), study_.oedometer_tests.end(),
                                      [](const auto& test) { return !test.hold_out; });
    if (fitted < 2) {
      require(false, "there is a second test to try it on: one test alone names nothing");
    } else {
      tell(0.9, "each test as the others predict it");
      if (auto interrupted = stopped()) return interrupted;
      const auto gain = predicts_better(best);
      const std::string words = "tests left out of the fit are predicted no worse with it";
      const bool better = gain ? require(*gain >= kPredictsNoWorse,
                                         fmt::format("{} (log predictive density {:+.1f})", words, *gain))
                               : require(false, words + ": " + gain.error().message);
      if (leads) {
        found_.verdict = better ? Verdict::named : Verdict::unknown;
        if (better) found_.chosen = 0;
        return std::nullopt;
      }
    }
    for (std::size_t k = 0; k < found_.trials.size(); ++k) {
      const Trial& trial = found_.trials[k];
      if (lead_over(trial.candidate) < kMargin) found_.equivalent.push_back(k);
    }
    if (found_.equivalent.size() < 2 && !leads) {  // too little better than the base, and nothing beside it
      found_.equivalent.clear();
      found_.verdict = Verdict::unknown;
      return std::nullopt;
    }
    found_.verdict = Verdict::ambiguous;
    return std::nullopt;
  }

  /// Where the base fails, by the best trial where it is an explanation. Stages of one test are set beside
  /// those of another: which is missed by more should not turn on how well each test's own noise could be
  /// estimated, so that tests whose noise is stated alike have one here.
  std::optional<FitFailure> place() {
    if (found_.verdict != Verdict::named && found_.verdict != Verdict::ambiguous) return std::nullopt;
    const Candidate& best = found_.trials.front().candidate;
    const auto noise =
        calibration::fit_noise(calibration::problem_of(study_, best.fit, best.free, options_.threads),
                               best.fit.result.main.coordinates, {kNoise, true});
    if (!noise) return FitFailure{"noise: " + noise.error().message};
    return rank_by_explanation(study_, found_.base.candidate, best, noise->weights, options_.threads,
                               found_.disagreement);
  }

  /// The test that would part the best two explanations, where they are more than one and none is named.
  void propose_next() {
    const bool meets = !found_.trials.empty() && found_.trials.front().adequacy.meets_noise;
    if (found_.verdict != Verdict::ambiguous && !(found_.verdict == Verdict::unknown && meets)) return;
    const Candidate& best = found_.trials.front().candidate;
    const Candidate& other = found_.trials.size() > 1 ? found_.trials[1].candidate : found_.base.candidate;
    found_.next = tell_apart(study_, best, other, best.fit.noise.weights, options_.threads);
  }

  const datasets::Study& study_;
  const DiscoverOptions& options_;
  calibration::OedometerFitOptions fit_options_;
  Effects effects_;
  Discovery found_;
};

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "adequate";
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::unknown:
      return "unknown";
  }
  return "";
}

tl::expected<Discovery, FitFailure> discover_oedometer(const datasets::Study& study,
                                                       const DiscoverOptions& options) {
  return Search(study, options).run();
}

}  // namespace isotach::discovery
