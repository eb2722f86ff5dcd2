// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Writing of [material] so that the same doubles are read back.
#include "reports/parameters_toml.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "calibration/uncertainty.hpp"
#include "reports/estimates.hpp"

namespace isotach::reports {
namespace {

using calibration::ParameterEstimate;
using calibration::Verdict;

/// The shortest decimal near `value` that `does(read)` accepts once it is read, or one of all digits.
template <class Does>
std::string shortest_decimal(double value, Does&& does) {
  std::string text;
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    text = fmt::format("{:.{}g}", value, digits);
    double read = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    if (does(read)) break;
  }
  // TOML tells floats from integers by the point or the exponent
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// The shortest decimal that a reader of the key turns into exactly this SI value. Where a change of unit
/// leaves none, the nearest there is.
std::string exact_decimal(const model::ParameterInfo& info, double si) {
  return shortest_decimal(si / info.to_si, [&](double read) { return info.to_si * read == si; });
}

/// Where a value came from; `fitted_by` names the fit.
std::string origin(const ParameterEstimate& si, std::string_view fitted_by) {
  const ParameterEstimate estimate = in_key_unit(si);
  switch (estimate.verdict) {
    case Verdict::fixed:
      return "not fitted: as the study gives it";
    case Verdict::gauge:
      return fmt::format("{}, set by the gauge, +- {:.2g}", fitted_by, estimate.std_error);
    case Verdict::identified:
    case Verdict::weak:
      return fmt::format("{}, +- {:.2g} ({})", fitted_by, estimate.std_error,
                         calibration::name_of(estimate.verdict));
    case Verdict::undetermined:
      return fmt::format("{}, but the data do not determine it", fitted_by);
  }
  return {};
}

struct Origin {
  ParameterEstimate estimate;
  std::string_view fitted_by;
};

std::string render(const RunInfo& run, const std::vector<Origin>& origins, model::LodeDependence lode,
                   const std::vector<std::string>& notes) {
  std::string text =
      fmt::format("# Written by isotach {} {} from {}.\n", run.command, run.version, input_name(run.input));
  text +=
      "# Usable as the [material], and [effects] where it has them, of a study or a test; +- is one standard "
      "error.\n";
  for (const std::string& note : notes) text += fmt::format("# {}\n", note);
  text += "\n[material]\n";
  for (const auto& [estimate, fitted_by] : origins) {
    const model::ParameterInfo& info = model::info(estimate.id);
    text += fmt::format("{} = {}  # {}; {}\n", info.key, exact_decimal(info, estimate.value), info.meaning,
                        origin(estimate, fitted_by));
  }
  if (lode == model::LodeDependence::none) text += "lode_dependence = \"none\"\n";
  return text;
}

/// The shortest decimal that `to_si` times it turns into exactly this SI value.
std::string effect_decimal(const effects::EffectParameter& parameter, double si) {
  return shortest_decimal(si / parameter.to_si, [&](double read) { return parameter.to_si * read == si; });
}

/// Effects and those of their parameters that a fit moved.
struct FittedEffects {
  effects::Values<double> effects;
  std::vector<effects::ParameterRef> moved;
};

FittedEffects effects_of(const effects::Values<double>& effects, const calibration::FitResult& result) {
  FittedEffects fitted{effects, {}};
  for (const auto& estimate : result.local_estimates) {
    if (estimate.effect) fitted.moved.push_back(*estimate.effect);
  }
  return fitted;
}

/// Those of both; of effects that both have, the ones of tests of the second's kind.
FittedEffects merged(FittedEffects first, const FittedEffects& second, effects::TestKind kind) {
  for (const auto& one : second.effects.chosen()) {
    if (one.effect->test != kind && first.effects.has(*one.effect)) continue;
    if (auto with = first.effects.with(one)) first.effects = std::move(*with);
  }
  first.moved.insert(first.moved.end(), second.moved.begin(), second.moved.end());
  return first;
}

/// [effects], empty where there are none.
std::string render_effects(const FittedEffects& fit) {
  if (fit.effects.empty()) return {};
  const auto fitted = [&](const effects::ParameterRef& parameter) {
    return std::find(fit.moved.begin(), fit.moved.end(), parameter) != fit.moved.end();
  };
  std::string text = "\n[effects]\n";
  for (const auto& one : fit.effects.chosen()) {
    std::string parameters;
    std::string moved;
    for (std::size_t i = 0; i < one.effect->parameters.size(); ++i) {
      const auto& parameter = one.effect->parameters[i];
      parameters +=
          fmt::format("{}{} = {}", i == 0 ? "" : ", ", parameter.name, effect_decimal(parameter, one.si[i]));
      if (fitted({one.effect, i})) moved += (moved.empty() ? "" : ", ") + std::string(parameter.name);
    }
    text += fmt::format("{} = {{ {} }}  # {}; {}\n", one.effect->name, parameters, one.effect->meaning,
                        moved.empty() ? "not fitted: as the study gives it" : "fitted: " + moved);
  }
  return text;
}

/// What the fit made of the tests' mud, which is no part of [material].
std::vector<std::string> mud_notes(const calibration::FitResult& result) {
  std::vector<std::string> notes;
  for (const auto& estimate : result.local_estimates) {
    if (!estimate.of_all || estimate.effect) continue;
    notes.push_back(fmt::format(
        "The slump tests' mud, fitted: {} = {:.5g} +- {:.2g} ({}); goes into [slump.mud].", estimate.name,
        estimate.value, estimate.std_error, calibration::name_of(estimate.verdict)));
  }
  return notes;
}

constexpr std::string_view kByOedometer = "fitted to the oedometer tests";
constexpr std::string_view kBySlump = "fitted to the slump tests";

std::vector<Origin> all_by(const calibration::FitResult& result, std::string_view fitted_by) {
  std::vector<Origin> origins;
  for (const ParameterEstimate& estimate : result.estimates) origins.push_back({estimate, fitted_by});
  return origins;
}

}  // namespace

std::string parameters_toml(const RunInfo& run, const calibration::OedometerFit& fit) {
  return render(run, all_by(fit.result, kByOedometer), fit.result.parameters->lode(),
                {gauge_sentence(fit.result)}) +
         render_effects(effects_of(fit.effects, fit.result));
}

std::string parameters_toml(const RunInfo& run, const calibration::SlumpFit& fit) {
  return render(run, all_by(fit.result, kBySlump), fit.result.parameters->lode(), mud_notes(fit.result)) +
         render_effects(effects_of(fit.effects, fit.result));
}

std::string parameters_toml(const RunInfo& run, const calibration::Calibration& calibration) {
  std::vector<Origin> origins;
  for (const ParameterEstimate& estimate : combined_estimates(calibration)) {
    origins.push_back({estimate, is_free(calibration.slump.result, estimate.id) ? kBySlump : kByOedometer});
  }
  std::vector<std::string> notes = mud_notes(calibration.slump.result);
  notes.insert(notes.begin(), gauge_sentence(calibration.oedometer.result));
  return render(run, origins, calibration.slump.result.parameters->lode(), notes) +
         render_effects(merged(effects_of(calibration.oedometer.effects, calibration.oedometer.result),
                               effects_of(calibration.slump.effects, calibration.slump.result),
                               effects::TestKind::slump));
}

namespace {

FittedEffects effects_of(const discovery::SlumpCandidate& candidate) {
  FittedEffects fitted{candidate.effects, {}};
  for (const auto& coordinate : candidate.problem->parametrisation().coordinates()) {
    if (coordinate.effect) fitted.moved.push_back(*coordinate.effect);
  }
  return fitted;
}

/// The material of a candidate; standard errors by its linearised problem.
std::vector<Origin> origins_of(const discovery::SlumpCandidate& candidate) {
  const Eigen::MatrixXd information = candidate.at.jacobian.transpose() * candidate.at.jacobian;
  const Eigen::MatrixXd covariance = information.completeOrthogonalDecomposition().pseudoInverse();
  std::vector<Origin> origins;
  for (const auto& parameter : model::kParameterTable) {
    ParameterEstimate estimate{parameter.id, (*candidate.parameters)[parameter.id]};
    const auto& coordinates = candidate.problem->parametrisation().coordinates();
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      if (coordinates[k].id != parameter.id) continue;
      const auto i = static_cast<Eigen::Index>(k);
      estimate.std_error =
          std::abs(coordinates[k].slope(candidate.at.coordinates[k])) * std::sqrt(covariance(i, i));
      estimate.verdict = calibration::judge(
          1.96 * estimate.std_error, calibration::range_of(parameter.id, *candidate.parameters), false);
    }
    origins.push_back({estimate, kBySlump});
  }
  return origins;
}

}  // namespace

std::string parameters_toml(const RunInfo& run, const Discoveries& found) {
  std::optional<FittedEffects> effects;
  std::string text;
  if (found.oedometer) {
    const calibration::OedometerFit& fit = found.oedometer->answer().candidate.fit;
    text = render(run, all_by(fit.result, kByOedometer), fit.result.parameters->lode(),
                  {gauge_sentence(fit.result)});
    effects = effects_of(fit.effects, fit.result);
  }
  if (found.slump) {
    const discovery::SlumpCandidate& candidate = found.slump->answer().candidate;
    if (!effects) text = render(run, origins_of(candidate), candidate.parameters->lode(), {});
    effects = effects ? merged(std::move(*effects), effects_of(candidate), effects::TestKind::slump)
                      : effects_of(candidate);
  }
  return effects ? text + render_effects(*effects) : text;
}

}  // namespace isotach::reports
