// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/made_study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/synthetic_oedometer.hpp"
#include "calibration/effect_sensitivity.hpp"

namespace isotach::bench {

namespace {

using datasets::OedometerTest;
using model::ParameterId;
using Readings = std::vector<std::vector<double>>;

const std::vector<ParameterId> kFree{ParameterId::e100, ParameterId::lambda, ParameterId::kappa,
                                     ParameterId::D_r,  ParameterId::I_v,    ParameterId::C_1};

/// The constants that truths scatter about: what the study says of the material.
model::Parameters<double> seed_mud() {
  model::ParameterValues<double> values;
  values.values = {1.358, 0.154, 0.0129, 0.03, 6.8e-7, 14.2 * std::numbers::pi / 180.0, 0.05};
  return *model::Parameters<double>::create(values);
}

/// What a laboratory knows of such muds, as datasets/mud-a has it: without bounds, fits of the poor protocol,
/// which leaves parameters open, wander to where the law costs a hundred times as much.
datasets::FitSettings fit_settings() {
  datasets::FitSettings fit;
  fit.oedometer = kFree;
  const auto bound = [&](ParameterId id, double lower, double upper) {
    fit.bounds[static_cast<std::size_t>(id)] = datasets::Bounds{lower, upper};
  };
  bound(ParameterId::e100, 0.5, 3.0);
  bound(ParameterId::lambda, 0.05, 0.3);
  bound(ParameterId::kappa, 0.004, 0.05);
  bound(ParameterId::I_v, 0.01, 0.1);
  bound(ParameterId::C_1, 0.0, 0.3);
  return fit;
}

tl::expected<Readings, std::string> exact_readings(const std::vector<OedometerTest>& tests,
                                                   const model::Parameters<double>& truth,
                                                   const Hidden& hidden) {
  Readings all;
  for (const OedometerTest& test : tests) {
    auto one = exact_log_stress(test, truth, hidden);
    if (!one) return tl::unexpected(one.error());
    all.push_back(std::move(*one));
  }
  return all;
}

/// The effect at zero, its shapes within a factor of two of their typical values.
effects::Chosen<double> with_random_shape(const effects::Effect& effect, std::mt19937_64& random) {
  effects::Chosen<double> chosen = effects::with_amplitude(effect, 0.0);
  for (std::size_t k = 1; k < effect.parameters.size(); ++k) {
    const effects::EffectParameter& info = effect.parameters[k];
    const double factor = std::exp2(2.0 * uniform(random) - 1.0);
    if (info.searched()) chosen.si[k] = std::clamp(factor * chosen.si[k], info.lower_si(), info.upper_si());
  }
  return chosen;
}

/// Everything about one study that its effects are measured by.
struct Setting {
  std::vector<OedometerTest> tests;
  model::Parameters<double> truth;
  Visibility visibility;

  [[nodiscard]] std::optional<double> shown(const Hidden& hidden) const {
    const auto readings = exact_readings(tests, truth, hidden);
    if (!readings) return std::nullopt;
    return visibility.left_of(*readings).norm;
  }
};

/// Gives the effect the amplitude that shows as asked.
Sought set_amplitude(const Setting& setting, effects::Chosen<double>& chosen, double wanted,
                     std::mt19937_64& random) {
  const effects::EffectParameter& info = chosen.effect->parameters[0];
  const double sign = info.lower < 0.0 && uniform(random) < 0.5 ? -1.0 : 1.0;
  const auto shown = [&](double amplitude) {
    effects::Chosen<double> tried = chosen;
    tried.si[0] = amplitude;
    return setting.shown({{tried}, {}});
  };
  const Sought sought = seek_visibility(shown, sign * info.typical_si(), sign * info.upper_si(), wanted);
  chosen.si[0] = sought.amplitude;
  return sought;
}

Sought set_amplitude(const Setting& setting, Outside& outside, double wanted, std::mt19937_64& random) {
  const OutsideInfo& info = info_of(outside.kind);
  const double sign = info.either_sign && uniform(random) < 0.5 ? -1.0 : 1.0;
  const auto shown = [&](double amplitude) { return setting.shown({{}, Outside{outside.kind, amplitude}}); };
  const Sought sought = seek_visibility(shown, sign * info.typical, sign * info.most, wanted);
  outside.amplitude = sought.amplitude;
  return sought;
}

/// What an effect's amplitude does to the fitted tests, at zero, whitened; nothing where it cannot.
std::optional<Eigen::VectorXd> signature_of(const Setting& setting,
                                            const calibration::OedometerExperiments& experiments,
                                            const effects::Chosen<double>& shape) {
  const auto on = effects::Values<double>::create({shape});
  if (!on) return std::nullopt;
  const effects::ParameterRef amplitude{shape.effect, 0};
  const std::vector<std::vector<double>> locals(experiments.size());
  const auto all =
      calibration::linearise_by_effects(experiments, setting.truth, locals, *on, {&amplitude, 1}, 1);
  if (!all) return std::nullopt;
  std::vector<Eigen::VectorXd> changes;
  for (const auto& one : *all) changes.emplace_back(one.jacobian.col(0));
  return setting.visibility.white(changes);
}

double left_beside_another(const Setting& setting, const Hidden& hidden, const Eigen::VectorXd& white) {
  calibration::OedometerExperiments experiments;
  for (const std::size_t i : setting.visibility.fitted()) {
    experiments.push_back(std::make_shared<experiments::OedometerExperiment>(setting.tests[i]));
  }
  double least = white.norm();
  for (const effects::Effect* effect : effects::catalogue()) {
    if (effect->test != effects::TestKind::oedometer) continue;
    if (std::any_of(hidden.effects.begin(), hidden.effects.end(),
                    [&](const auto& one) { return one.effect == effect; })) {
      continue;
    }
    // along its shapes a strong effect bends: all of them together are what a fit can reach
    std::vector<Eigen::VectorXd> directions;
    const auto add = [&](const effects::Chosen<double>& shape) {
      if (auto signature = signature_of(setting, experiments, shape)) directions.push_back(*signature);
    };
    add(effects::with_amplitude(*effect, 0.0));
    for (std::size_t k = 1; k < effect->parameters.size(); ++k) {
      if (!effect->parameters[k].searched()) continue;
      for (const double factor : {0.5, 2.0}) {
        effects::Chosen<double> shape = effects::with_amplitude(*effect, 0.0);
        shape.si[k] *= factor;
        add(shape);
      }
    }
    least = std::min(least, setting.visibility.norm_beside(white, directions));
  }
  return least;
}

void add_noise(OedometerTest& test, const std::vector<double>& log_stress, ReadingNoise noise,
               std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const std::vector<double> errors = noise.draw(log_stress.size(), random);
  for (std::size_t i = 0; i < log_stress.size(); ++i) {
    test.record.rows[i].axial_stress = std::exp(log_stress[i] + errors[i]);
    test.record.rows[i].axial_strain += kStrainNoise * normal(random);
  }
  constexpr double kAlmostNoFloor = 1.0;
  test.noise = {noise.level, kAlmostNoFloor, kStrainNoise};
}

}  // namespace

Sought seek_visibility(const std::function<std::optional<double>(double)>& visibility, double typical,
                       double most, double wanted) {
  constexpr int kTries = 30;
  constexpr double kLeastStep = 1e-3;  // of the logarithm
  Sought best{0.0, 0.0, false};
  // bounds of ln |amplitude|: below, it shows less than asked; above, more, or it cannot be had
  double amplitude = typical;
  std::optional<double> below;
  std::optional<double> above;
  for (int k = 0; k < kTries; ++k) {
    const double place = std::log(std::abs(amplitude));
    const auto shown = visibility(amplitude);
    if (shown && std::abs(*shown - wanted) < std::abs(best.visibility - wanted)) {
      best = {amplitude, *shown, std::abs(*shown - wanted) <= kVisibilityTolerance * wanted};
    }
    if (best.reached) return best;
    double next = shown && *shown > 0.0 ? place + std::log(wanted / *shown) : place - std::log(2.0);
    if (shown && *shown < wanted) {
      if (amplitude == most) return best;
      below = place;
    } else {
      above = place;
    }
    if (below && above) {
      if (*above - *below < kLeastStep) return best;
      // every other step halves: where the curve bends, ratios alone would step to and fro
      if (k % 2 == 1 || !(next > *below && next < *above)) next = 0.5 * (*below + *above);
    }
    amplitude = std::copysign(std::min(std::exp(next), std::abs(most)), typical);
  }
  return best;
}

tl::expected<MadeStudy, std::string> make_study(const Case& one, std::uint64_t seed) {
  std::seed_seq mixed{seed, static_cast<std::uint64_t>(one.number)};
  std::mt19937_64 random(mixed);
  const model::Parameters<double> truth = random_parameters(random);
  std::vector<OedometerTest> tests = blank_tests(one.programme, truth, random);
  const auto base = exact_readings(tests, truth, {});
  if (!base) return tl::unexpected(base.error());
  const ReadingNoise noise{one.noise};
  try {
    const Setting setting{tests, truth, Visibility(tests, *base, truth, kFree, noise)};
    MadeStudy made{{"synthetic", {}, seed_mud(), {}, {}, {}, {}, {}}, truth, {}, 0.0, true, {}, 0.0};
    std::vector<Sought> sought;
    for (const effects::Effect* effect : one.effects) {
      made.hidden.effects.push_back(with_random_shape(*effect, random));
      sought.push_back(set_amplitude(setting, made.hidden.effects.back(), one.visibility, random));
    }
    if (one.outside) {
      made.hidden.outside = Outside{*one.outside, 0.0};
      sought.push_back(set_amplitude(setting, *made.hidden.outside, one.visibility, random));
    }
    for (const Sought& found : sought) {
      made.reached = made.reached && found.reached;
      made.visibility =
          made.visibility > 0.0 ? std::min(made.visibility, found.visibility) : found.visibility;
    }
    const auto readings = exact_readings(tests, truth, made.hidden);
    if (!readings) return tl::unexpected(readings.error());
    made.left = setting.visibility.left_of(*readings);
    if (!sought.empty()) made.beside_another = left_beside_another(setting, made.hidden, made.left.white);
    for (std::size_t i = 0; i < tests.size(); ++i) add_noise(tests[i], (*readings)[i], noise, random);
    made.study.fit = fit_settings();
    made.study.oedometer_tests = std::move(tests);
    return made;
  } catch (const std::runtime_error& error) {
    return tl::unexpected(std::string(error.what()));
  }
}

}  // namespace isotach::bench
