// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/limits.hpp"

namespace isotach::discovery {

namespace {

using Effects = std::vector<const effects::Effect*>;

bool contains(const Effects& all, const Effects& some) {
  return std::all_of(some.begin(), some.end(), [&](const effects::Effect* effect) {
    return std::find(all.begin(), all.end(), effect) != all.end();
  });
}

/// A pair stands first only where it is better by the margin than each of its effects alone.
void prefer_fewer(std::vector<SlumpTrial>& trials) {
  if (trials.empty() || trials.front().candidate.added.size() == 1) return;
  const SlumpCandidate& pair = trials.front().candidate;
  const auto single = std::find_if(trials.begin(), trials.end(), [&](const auto& trial) {
    return trial.candidate.added.size() == 1 && contains(pair.added, trial.candidate.added) &&
           trial.candidate.bic < pair.bic + kMargin;
  });
  if (single != trials.end()) std::rotate(trials.begin(), single, single + 1);
}

/// Adequacy by what fits with more effects gain over the trial, and how rarely noise would let them. Not by
/// what scores promise: they are secants over a typical amplitude, which noise far below it may follow and no
/// amplitude.
void judge(const SlumpDiscovery& found, const ScoreTest& null, SlumpTrial& trial) {
  const SlumpCandidate& candidate = trial.candidate;
  trial.adequacy.meets_noise = meets_noise(candidate);
  trial.adequacy.most = nullptr;
  double most = 0.0;
  for (const SlumpTrial& other : found.trials) {
    if (&other == &trial || !contains(other.candidate.added, candidate.added)) continue;
    const double gain = (candidate.chi_squared - other.candidate.chi_squared) / found.scale;
    if (gain <= most) continue;
    most = gain;
    for (const effects::Effect* effect : other.candidate.added) {
      if (!contains(candidate.added, {effect})) trial.adequacy.most = effect;
    }
  }
  trial.adequacy.p_value = most > 0.0 ? null.p_value(most) : 1.0;
  trial.adequate = trial.adequacy.meets_noise && trial.adequacy.p_value >= kLeavesNothing;
}

/// The best of the trials that do not have all effects of the first; null where there is none.
const SlumpTrial* rival(const SlumpDiscovery& found) {
  for (const SlumpTrial& trial : found.trials) {
    if (!contains(trial.candidate.added, found.trials.front().candidate.added)) return &trial;
  }
  return nullptr;
}

}  // namespace

bool meets_noise(const SlumpCandidate& candidate) {
  return std::all_of(candidate.gaps.begin(), candidate.gaps.end(),
                     [](double gap) { return gap <= calibration::kAdequate; });
}

void weigh(SlumpDiscovery& found, const ScoreTest& null) {
  const auto count = static_cast<double>(found.base.candidate.problem->value_count());
  std::vector<SlumpCandidate*> all{&found.base.candidate};
  for (SlumpTrial& trial : found.trials) all.push_back(&trial.candidate);
  double least = HUGE_VAL;
  for (const SlumpCandidate* one : all) {
    least = std::min(least, one->chi_squared / (count - static_cast<double>(one->at.coordinates.size())));
  }
  found.scale = std::max(1.0, least);
  for (SlumpCandidate* one : all) {
    one->bic =
        one->chi_squared / found.scale + static_cast<double>(one->at.coordinates.size()) * std::log(count);
  }
  std::stable_sort(found.trials.begin(), found.trials.end(),
                   [](const auto& a, const auto& b) { return a.candidate.bic < b.candidate.bic; });
  prefer_fewer(found.trials);
  judge(found, null, found.base);
  found.p_value = found.base.adequacy.p_value;
  for (SlumpTrial& trial : found.trials) judge(found, null, trial);
}

void decide(SlumpDiscovery& found) {
  found.base.adequacy.meets_noise = meets_noise(found.base.candidate);
  // The error of simulations is a measure, not a distribution. Where it is as large as the noise, some effect
  // of the catalogue nearly always improves the fit by more than noise would: then the size of the misfit
  // alone may reject the base. A reference's is a small part of the noise.
  found.base.adequate = found.base.adequacy.meets_noise &&
                        !(found.by_gain && found.base.adequacy.p_value < kRejects && !found.trials.empty());
  if (found.base.adequate) {
    found.verdict = Verdict::adequate;
    return;
  }
  found.verdict = Verdict::unknown;
  if (found.trials.empty()) return;
  const SlumpTrial* other = rival(found);
  if (other != nullptr) found.best_wrong = other->gap.fitted;
  const SlumpCandidate& base = found.base.candidate;
  const SlumpCandidate& best = found.trials.front().candidate;
  const auto require = [&](bool holds, std::string text) {
    found.conditions.push_back({std::move(text), holds});
    return holds;
  };
  bool good = require(
      found.trials.front().adequate,
      fmt::format("with {} the model meets every test, and no further effect is called for (p = {:.3g})",
                  name_of(best), found.trials.front().adequacy.p_value));
  good &= require(!best.at_bound, "its amplitude lies within its bounds and is not zero");
  const double lead = (other != nullptr ? std::min(base.bic, other->candidate.bic) : base.bic) - best.bic;
  const bool leads = require(lead >= kMargin,
                             fmt::format("its BIC is lower than that of any explanation without it, the base "
                                         "included, by {:.1f} ({} asked)",
                                         lead, kMargin));
  if (base.gaps.size() > 1) {
    const double gain = left_out_density(best, found.scale) - left_out_density(base, found.scale);
    good &= require(
        gain >= kPredictsNoWorse,
        fmt::format("tests left out of the fit are predicted no worse with it (log density {:+.1f})", gain));
  }
  if (!good) return;
  if (leads) {
    found.verdict = Verdict::named;
    found.chosen = 0;
    return;
  }
  for (std::size_t k = 0; k < found.trials.size(); ++k) {
    const SlumpCandidate& one = found.trials[k].candidate;
    const bool more = one.added.size() > best.added.size();
    if (!more && one.bic < best.bic + kMargin) found.equivalent.push_back(k);
  }
  if (found.equivalent.size() < 2) {
    found.equivalent.clear();
    return;
  }
  found.verdict = Verdict::ambiguous;
}

}  // namespace isotach::discovery
