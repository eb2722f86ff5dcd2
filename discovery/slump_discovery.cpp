// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "calibration/fit_slump.hpp"
#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"
#include "discovery/limits.hpp"
#include "discovery/slump_common_error.hpp"
#include "discovery/slump_disagreement.hpp"
#include "discovery/slump_next.hpp"
#include "discovery/slump_verdict.hpp"
#include "discovery/slump_wandering.hpp"

namespace isotach::discovery {

namespace {

using calibration::FitFailure;
using Effects = std::vector<const effects::Effect*>;

constexpr int kBaseEvaluations = 7;
constexpr int kTrialEvaluations = 6;
constexpr int kCorrectedEvaluations = 3;
constexpr double kShapeMove = 0.4;  // of a logarithm, for the difference by a shape

class SlumpSearch {
 public:
  SlumpSearch(const datasets::Study& study, const SlumpDiscoverOptions& options)
      : study_(study),
        options_(options),
        basis_{study,
               options.knowledge ? options.knowledge->parameters : study.material,
               {},
               {},
               {},
               {},
               options.threads,
               options.control.quiet()} {
    const experiments::Simulate simulate =
        options.simulate ? options.simulate : calibration::plain_simulation(options.control.stop);
    basis_.simulate = [this, simulate](const auto&... arguments) {
      ++simulations_;
      return simulate(arguments...);
    };
  }

  tl::expected<SlumpDiscovery, FitFailure> run() {
    if (auto failure = fit_base()) return tl::unexpected(*failure);
    if (auto failure = score_all()) return tl::unexpected(*failure);
    found_.by_gain = calibration::has_reference(study_);
    if (!meets_noise(found_.base.candidate) || (found_.by_gain && promises_much())) {
      if (auto failure = try_best()) return tl::unexpected(*failure);
      weigh(found_, null_);
      if (auto failure = try_pairs()) return tl::unexpected(*failure);
      weigh(found_, null_);
      if (auto failure = try_alone_again()) return tl::unexpected(*failure);
      weigh(found_, null_);
      auto wandering = let_wander(basis_, found_.base.candidate, common_,
                                  [this](double done) { tell(0.8 + 0.1 * done, "one slot at a time"); });
      if (!wandering) return tl::unexpected(wandering.error());
      found_.wandering = std::move(*wandering);
    }
    if (auto failure = compare()) return tl::unexpected(*failure);
    decide(found_);
    if (found_.verdict == Verdict::named || found_.verdict == Verdict::ambiguous) {
      rank_by_explanation(found_.base.candidate.tests, found_.base.simulations,
                          found_.trials.front().simulations, found_.disagreement);
    }
    if (found_.chosen) {
      found_.amplitudes =
          amplitude_intervals(found_.trials[*found_.chosen].candidate, found_.scale, kIntervalLevel);
    }
    if (found_.verdict == Verdict::ambiguous) {
      tell(0.95, "which test would decide");
      found_.next = tell_slumps_apart(basis_, found_.trials[found_.equivalent[0]].candidate,
                                      found_.trials[found_.equivalent[1]].candidate);
    }
    found_.simulations = simulations_;
    tell(1.0, "done");
    return std::move(found_);
  }

 private:
  void tell(double done, const std::string& what) const {
    if (options_.progress) options_.progress(done, what);
  }
  [[nodiscard]] static FitFailure interrupted() { return {"interrupted", true}; }

  std::optional<FitFailure> fit_base() {
    tell(0.0, "error of the simulations");
    auto error = calibration::measure_simulation_error(study_, basis_.start, basis_.simulate, basis_.threads);
    if (!error) return error.error();
    basis_.error = std::move(*error);
    tell(0.15, "fit of the base");
    if (options_.knowledge) basis_.priors = options_.knowledge->priors;
    SlumpCandidate base = slump_candidate(basis_, {});
    const std::vector<double> start = base.problem->parametrisation().start();
    auto corrections = corrections_at(base, start);
    if (!corrections) return corrections.error();
    basis_.corrections = std::move(*corrections);
    base = slump_candidate(basis_, {});
    auto common = common_error(basis_, base.tests);
    if (!common) return common.error();
    common_ = std::move(*common);
    auto at = base.problem->linearise(start);
    if (!at) return FitFailure{at.error().message, at.error().interrupted};
    base.at = {start, common_.whitened(std::move(at->residuals)), common_.whitened(std::move(at->jacobian))};
    if (auto failure = minimise(base, kBaseEvaluations)) return failure;
    if (auto failure = correct(base, kTrialEvaluations)) return failure;
    for (std::size_t i = 0; i < base.tests.size() && basis_.corrections.any(); ++i) {
      basis_.corrections.tests[i] = base.tests[i]->correction();
    }
    found_.base.candidate = std::move(base);
    return std::nullopt;
  }

  /// From candidate.at to the least nearby.
  std::optional<FitFailure> minimise(SlumpCandidate& candidate, int evaluations) const {
    calibration::SecantOptions secants;
    secants.max_evaluations = evaluations;
    secants.map = [this](Eigen::VectorXd r) -> Eigen::VectorXd { return common_.whitened(std::move(r)); };
    auto fit = calibration::minimise_by_secants(*candidate.problem, candidate.at, secants, basis_.control);
    if (fit.interrupted) return interrupted();
    candidate.at = std::move(fit.at);
    conclude(candidate, common_.as_read(candidate.at.residuals));
    return std::nullopt;
  }

  /// From simulations to the study's reference numerics at x.
  [[nodiscard]] tl::expected<calibration::Corrections, FitFailure> corrections_at(
      const SlumpCandidate& candidate, const std::vector<double>& x) const {
    const auto& parametrisation = candidate.problem->parametrisation();
    std::vector<std::vector<double>> locals;
    for (const auto& test : candidate.tests) locals.push_back(parametrisation.local_of(*test, x));
    return calibration::measure_corrections(study_, candidate.tests, *parametrisation.at(x), locals,
                                            basis_.threads, calibration::Corrected::fitted_tests);
  }

  /// Corrects a candidate at its answer, where the study has reference numerics, and goes on from there.
  std::optional<FitFailure> correct(SlumpCandidate& candidate, int evaluations) const {
    if (!basis_.corrections.any()) return std::nullopt;
    auto corrections = corrections_at(candidate, candidate.at.coordinates);
    if (!corrections) return corrections.error();
    SlumpBasis basis = basis_;
    basis.corrections = std::move(*corrections);
    SlumpCandidate corrected = slump_candidate(basis, candidate.added);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(candidate.at.residuals.size());
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < candidate.tests.size(); ++i) {
      if (candidate.tests[i]->held_out()) continue;
      const auto& test = *corrected.tests[i];
      const auto count = static_cast<Eigen::Index>(test.measured().size());
      experiments::Values more = test.correction();
      const experiments::Values& before = candidate.tests[i]->correction();
      if (more.empty()) more.assign(test.mould_gone().size(), 0.0);
      for (std::size_t p = 0; p < before.size(); ++p) more[p] -= before[p];
      const experiments::Values seen = test.decorrelated(more);
      change.segment(row, count) = Eigen::Map<const Eigen::VectorXd>(seen.data(), count);
      row += count;
    }
    corrected.at = std::move(candidate.at);
    corrected.at.residuals += common_.whitened(std::move(change));
    candidate = std::move(corrected);
    return minimise(candidate, evaluations);
  }

  /// Whitened residuals at x.
  tl::expected<Eigen::VectorXd, experiments::PredictionFailure> residuals_at(
      const SlumpCandidate& candidate, const std::vector<double>& x) const {
    auto residuals = candidate.problem->residuals(x);
    if (!residuals) return tl::unexpected(residuals.error());
    return Eigen::VectorXd(common_.whitened(std::move(*residuals)));
  }

  std::optional<std::string> cannot_have(const effects::Effect& effect) const {
    if (study_.effects.has(effect)) return "the model has it already";
    for (const datasets::SlumpTest& test : study_.slump_tests) {
      if (auto reason = datasets::why_not(test.setup, effect)) return test.name + ": " + *reason;
    }
    return std::nullopt;
  }

  /// What an effect does to residuals of the base, for each typical amplitude: by the difference over one, or
  /// over more where one hardly shows.
  tl::expected<Eigen::VectorXd, experiments::PredictionFailure> change_by(
      const effects::Effect& effect, const Projection& projection) const {
    const SlumpCandidate& base = found_.base.candidate;
    const SlumpCandidate with = slump_candidate(basis_, {&effect});
    auto residuals = residuals_at(with, continued(with, base.at.coordinates, 1.0));
    if (!residuals) return tl::unexpected(residuals.error());
    Eigen::VectorXd change = *residuals - base.at.residuals;
    const double shows = projection.freed(change).norm();
    const calibration::Coordinate& amplitude =
        with.problem->parametrisation().coordinates()[base.at.coordinates.size()];
    const double times = std::min({kSlumpShows / std::max(shows, 1e-3), kSlumpLargest, amplitude.upper});
    if (times <= 1.0) return change;
    residuals = residuals_at(with, continued(with, base.at.coordinates, times));
    if (!residuals) {
      if (residuals.error().interrupted) return tl::unexpected(residuals.error());
      return change;
    }
    return Eigen::VectorXd((*residuals - base.at.residuals) / times);
  }

  std::optional<FitFailure> score_all() {
    Effects effects;
    for (const effects::Effect* effect : effects::catalogue()) {
      if (effect->test != effects::TestKind::slump) continue;
      if (auto reason = cannot_have(*effect)) {
        found_.not_tried.emplace_back(effect, *reason);
      } else {
        effects.push_back(effect);
      }
    }
    const SlumpCandidate& base = found_.base.candidate;
    const Projection projection(base.at.jacobian);
    for (std::size_t k = 0; k < effects.size(); ++k) {
      tell(0.3 + 0.2 * static_cast<double>(k) / static_cast<double>(effects.size()),
           "what " + std::string(effects[k]->name) + " would do");
      const auto change = change_by(*effects[k], projection);
      if (!change) {
        if (change.error().interrupted) return interrupted();
        found_.not_tried.emplace_back(
            effects[k], "it could not be simulated at its typical strength: " + change.error().message);
        continue;
      }
      SlumpSignature found{effects[k], *change, {}, 0.0};
      found.signature = signature_of(effects[k], found.change, projection, base.at.residuals);
      const double length = projection.freed(found.change).norm();
      if (length > 0.0) found.amplitude = found.signature.z / length;
      found_.signatures.push_back(std::move(found));
    }
    std::vector<Signature> all;
    for (const SlumpSignature& one : found_.signatures) all.push_back(one.signature);
    null_.null_largest = largest_under_noise(all);
    return std::nullopt;
  }

  /// Whether noise would hardly let an effect's score be as large as the largest.
  [[nodiscard]] bool promises_much() const {
    double most = 0.0;
    for (const SlumpSignature& one : found_.signatures) most = std::max(most, gain_of(one.signature));
    return most > 0.0 && null_.p_value(most) < kRejects;
  }

  [[nodiscard]] const SlumpSignature* signature(const effects::Effect* effect) const {
    for (const SlumpSignature& one : found_.signatures) {
      if (one.effect == effect) return &one;
    }
    return nullptr;
  }

  /// Columns for the shapes of added effects, by a difference each where the amplitudes are not zero.
  std::optional<FitFailure> learn_shapes(SlumpCandidate& candidate) const {
    const auto& coordinates = candidate.problem->parametrisation().coordinates();
    for (std::size_t k = found_.base.candidate.at.coordinates.size(); k < coordinates.size(); ++k) {
      if (coordinates[k].effect->index == 0) continue;
      std::vector<double> x = candidate.at.coordinates;
      const double move = x[k] + kShapeMove > coordinates[k].upper ? -kShapeMove : kShapeMove;
      x[k] += move;
      const auto residuals = residuals_at(candidate, x);
      if (!residuals) {
        if (residuals.error().interrupted) return interrupted();
        continue;  // the shape stays
      }
      candidate.at.jacobian.col(static_cast<Eigen::Index>(k)) = (*residuals - candidate.at.residuals) / move;
    }
    return std::nullopt;
  }

  /// The base with effects, none of them there yet; columns of shapes are zero.
  [[nodiscard]] SlumpCandidate beginning(const Effects& added) const {
    const SlumpCandidate& base = found_.base.candidate;
    SlumpCandidate candidate = slump_candidate(basis_, added);
    candidate.at.coordinates = continued(candidate, base.at.coordinates, 0.0);
    candidate.at.residuals = base.at.residuals;
    const auto& coordinates = candidate.problem->parametrisation().coordinates();
    candidate.at.jacobian =
        Eigen::MatrixXd::Zero(base.at.jacobian.rows(), static_cast<Eigen::Index>(coordinates.size()));
    candidate.at.jacobian.leftCols(base.at.jacobian.cols()) = base.at.jacobian;
    for (std::size_t k = base.at.coordinates.size(); k < coordinates.size(); ++k) {
      if (coordinates[k].effect->index == 0) {
        candidate.at.jacobian.col(static_cast<Eigen::Index>(k)) =
            signature(coordinates[k].effect->effect)->change;
      }
    }
    return candidate;
  }

  /// From a candidate without corrections of its own to the least nearby of the one that has them.
  std::optional<FitFailure> settle(SlumpCandidate& candidate) const {
    if (auto failure = minimise(candidate, kTrialEvaluations)) return failure;
    return correct(candidate, kCorrectedEvaluations);
  }

  [[nodiscard]] static bool has_shapes(const SlumpCandidate& candidate) {
    const auto& coordinates = candidate.problem->parametrisation().coordinates();
    return std::any_of(coordinates.begin(), coordinates.end(),
                       [](const auto& one) { return one.effect && one.effect->index > 0; });
  }

  std::optional<FitFailure> try_set(const Effects& added) {
    SlumpCandidate candidate = beginning(added);
    if (has_shapes(candidate)) {
      if (auto failure = minimise(candidate, kTrialEvaluations)) return failure;
      if (auto failure = learn_shapes(candidate)) return failure;
    }
    if (auto failure = settle(candidate)) return failure;
    SlumpTrial trial;
    trial.candidate = std::move(candidate);
    found_.trials.push_back(std::move(trial));
    return std::nullopt;
  }

  std::optional<FitFailure> try_best() {
    std::vector<const SlumpSignature*> sorted;
    for (const SlumpSignature& one : found_.signatures) sorted.push_back(&one);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) {
      return gain_of(a->signature) > gain_of(b->signature);
    });
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      if (k >= kSlumpRefitted) {
        found_.not_tried.emplace_back(sorted[k]->effect, "others score higher");
        continue;
      }
      if (gain_of(sorted[k]->signature) == 0.0) {
        found_.not_tried.emplace_back(sorted[k]->effect, "it would have to act the other way round");
        continue;
      }
      tell(0.5 + 0.2 * static_cast<double>(k) / static_cast<double>(kSlumpRefitted),
           "fit with " + std::string(sorted[k]->effect->name));
      if (auto failure = try_set({sorted[k]->effect})) return failure;
    }
    return std::nullopt;
  }

  /// Whether noise would hardly let an effect promise as much as `more` does beside a fitted one.
  [[nodiscard]] bool promises_beside(const SlumpCandidate& fitted, const effects::Effect* more) const {
    const Signature beside =
        signature_of(more, signature(more)->change, Projection(fitted.at.jacobian), fitted.at.residuals);
    return null_.p_value(gain_of(beside)) < kSlumpPromise;
  }

  std::optional<FitFailure> try_pairs() {
    std::vector<Effects> pairs;
    const std::size_t count = std::min(kSlumpPaired, found_.trials.size());
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        const effects::Effect* more = found_.trials[b].candidate.added.front();
        const SlumpCandidate& fitted = found_.trials[a].candidate;
        if (promises_beside(fitted, more)) pairs.push_back({fitted.added.front(), more});
      }
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      tell(0.7 + 0.1 * static_cast<double>(k) / static_cast<double>(pairs.size()),
           fmt::format("fit with {} and {}", pairs[k][0]->name, pairs[k][1]->name));
      if (auto failure = try_set(pairs[k])) return failure;
    }
    return std::nullopt;
  }

  /// Fits each effect of a pair that stands first alone once more, from the pair's answer: beside one whose
  /// search stopped short the other would look needed.
  std::optional<FitFailure> try_alone_again() {
    const SlumpCandidate pair = found_.trials.front().candidate;
    if (pair.added.size() < 2) return std::nullopt;
    for (const effects::Effect* effect : pair.added) {
      SlumpCandidate alone = beginning({effect});
      alone.at.coordinates = matched(alone.problem->parametrisation().coordinates(),
                                     pair.problem->parametrisation().coordinates(), pair.at.coordinates);
      auto residuals = residuals_at(alone, alone.at.coordinates);
      if (!residuals) {
        if (residuals.error().interrupted) return interrupted();
        continue;
      }
      alone.at.residuals = std::move(*residuals);
      if (auto failure = learn_shapes(alone)) return failure;
      if (auto failure = settle(alone)) return failure;
      for (SlumpTrial& trial : found_.trials) {
        const bool better = alone.chi_squared < trial.candidate.chi_squared;
        if (trial.candidate.added == alone.added && better) trial.candidate = alone;
      }
    }
    return std::nullopt;
  }

  /// Simulations of all tests, held-out ones too, of the base and the best; where they disagree.
  std::optional<FitFailure> compare() {
    tell(0.9, "comparison of all tests");
    if (auto failure = simulate_all(found_.base)) return failure;
    found_.disagreement = slump_disagreement(found_.base.candidate.tests, found_.base.simulations);
    found_.smoother = smoothed_outline_gap(found_.base.candidate.tests, found_.base.simulations);
    for (SlumpTrial& trial : found_.trials) {
      trial.gap = {trial.candidate.gap, std::nan("")};
    }
    if (found_.trials.empty()) return std::nullopt;
    if (auto failure = simulate_all(found_.trials.front())) return failure;
    const SlumpTrial& best = found_.trials.front();
    for (const SlumpDisagreement& now : slump_disagreement(best.candidate.tests, best.simulations)) {
      for (SlumpDisagreement& before : found_.disagreement) {
        if (before.test == now.test && before.zone == now.zone && before.to == now.to) {
          before.mean_by_best = now.mean;
        }
      }
    }
    return std::nullopt;
  }

  std::optional<FitFailure> simulate_all(SlumpTrial& trial) {
    const SlumpCandidate& candidate = trial.candidate;
    std::vector<tl::expected<mpm::SlumpResult, experiments::PredictionFailure>> runs(candidate.tests.size());
    calibration::parallel_for(runs.size(), basis_.threads, [&](std::size_t i) {
      const auto& test = *candidate.tests[i];
      runs[i] = test.simulate_at_best(*candidate.parameters, candidate.problem->parametrisation().local_of(
                                                                 test, candidate.at.coordinates));
    });
    double squares = 0.0;
    double count = 0.0;
    trial.simulations.clear();
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto& test = *candidate.tests[i];
      if (!runs[i]) {
        if (runs[i].error().interrupted || !test.held_out()) {
          return FitFailure{runs[i].error().message, runs[i].error().interrupted};
        }
        found_.warnings.push_back("held out and not compared: " + runs[i].error().message);
        trial.simulations.emplace_back();
        continue;
      }
      if (test.held_out()) {
        for (const double r : test.decorrelated(test.distances(*runs[i]))) {
          squares += r * r;
          count += 1.0;
        }
      }
      trial.simulations.push_back(std::move(*runs[i]));
    }
    trial.gap = {candidate.gap, count > 0.0 ? std::sqrt(squares / count) : std::nan("")};
    return std::nullopt;
  }

  const datasets::Study& study_;
  const SlumpDiscoverOptions& options_;
  SlumpBasis basis_;
  calibration::CommonError common_;
  std::atomic<long> simulations_{0};
  ScoreTest null_;  ///< how much noise lets the best of all effects gain
  SlumpDiscovery found_;
};

}  // namespace

MaterialKnowledge knowledge_of(const calibration::OedometerFit& fit) {
  MaterialKnowledge knowledge{*fit.result.parameters, {}};
  for (const calibration::ParameterEstimate& estimate : fit.result.estimates) {
    if (estimate.verdict != calibration::Verdict::identified &&
        estimate.verdict != calibration::Verdict::weak) {
      continue;
    }
    if (!std::isfinite(estimate.std_error) || !(estimate.std_error > 0.0)) continue;
    knowledge.priors[static_cast<std::size_t>(estimate.id)] =
        datasets::Prior{estimate.value, estimate.std_error};
  }
  return knowledge;
}

tl::expected<SlumpDiscovery, FitFailure> discover_slump(const datasets::Study& study,
                                                        const SlumpDiscoverOptions& options) {
  return SlumpSearch(study, options).run();
}

}  // namespace isotach::discovery
