// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/effects_prediction.hpp"

#include "experiments/effects_path.hpp"
#include "experiments/effects_reference.hpp"

namespace isotach::experiments {

namespace {

/// Advances by the substeps that fits use.
template <class S, model::Fabric K>
auto by_substeps(detail::EffectsPath<S, K>& path) {
  return [&path](auto& rate, auto& state, const DriveStep& drive, auto&& accepted) {
    integrators::Tolerance tolerance;
    tolerance.relative = detail::kIntegrationTolerance;
    return detail::follow_substeps(state, rate, drive.duration, tolerance, path.substep(), accepted);
  };
}

/// f with the parameters as the anisotropy effect has them, in the form that they ask for.
template <class Result, class S, class F>
Result in_form(const model::Parameters<S>& parameters, const effects::Values<S>& effects,
               const datasets::OedometerTest& test, F&& f) {
  const auto altered = detail::with_anisotropy(parameters, effects);
  if (!altered) return tl::unexpected(PredictionFailure{test.name + ": " + altered.error()});
  const model::Law<S> law(*altered);
  const bool leans = altered->rotates() || effects.has(effects::anisotropy::kEffect);
  return leans ? f.template operator()<model::Fabric::omega>(law)
               : f.template operator()<model::Fabric::none>(law);
}

}  // namespace

template <class S>
tl::expected<std::vector<S>, PredictionFailure> predict_with_effects(const model::Parameters<S>& parameters,
                                                                     const effects::Values<S>& effects,
                                                                     const datasets::OedometerTest& test,
                                                                     const OedometerProtocol& protocol,
                                                                     std::span<const S> local,
                                                                     const Wander<S>* wander) {
  using Result = tl::expected<std::vector<S>, PredictionFailure>;
  return in_form<Result>(parameters, effects, test, [&]<model::Fabric K>(const model::Law<S>& law) -> Result {
    detail::EffectsPath<S, K> path(law, effects, test, protocol, wander);
    if (auto failure = path.begin(local)) return tl::unexpected(std::move(*failure));
    return detail::compared_values<S>(protocol, path.at_start(), [&](auto&& visit) {
      return path.follow(by_substeps(path),
                         [&](std::size_t step, double, const auto& reading) { visit(step, reading); });
    });
  });
}

tl::expected<std::vector<PathPoint>, PredictionFailure> path_with_effects(
    const model::Parameters<double>& parameters, const effects::Values<double>& effects,
    const datasets::OedometerTest& test, const OedometerProtocol& protocol, std::span<const double> local,
    Route route) {
  using Result = tl::expected<std::vector<PathPoint>, PredictionFailure>;
  return in_form<Result>(parameters, effects, test, [&]<model::Fabric K>(const auto& law) -> Result {
    detail::EffectsPath<double, K> path(law, effects, test, protocol);
    if (auto failure = path.begin(local)) return tl::unexpected(std::move(*failure));
    std::vector<PathPoint> points;
    const auto add = [&](double time, std::size_t row, const auto& reading) {
      const auto& soil = path.state().soil;
      const double p_B = std::exp(path.log_preconsolidation_pressure());
      points.push_back({time, row, reading.axial_stress(), reading.axial_strain(), soil.void_ratio,
                        soil.stress[1] / (std::numbers::sqrt2 * soil.stress[0]),
                        p_B / law.measures(soil).equivalent_pressure});
    };
    add(protocol.start.time, protocol.start.row, path.at_start());
    const auto visit = [&](std::size_t step, double time, const auto& reading) {
      add(time, protocol.steps[step].row, reading);
    };
    auto failure =
        route == Route::cvode ? path.follow(detail::ByCvode{}, visit) : path.follow(by_substeps(path), visit);
    if (failure) return tl::unexpected(std::move(*failure));
    return points;
  });
}

template tl::expected<std::vector<double>, PredictionFailure> predict_with_effects(
    const model::Parameters<double>&, const effects::Values<double>&, const datasets::OedometerTest&,
    const OedometerProtocol&, std::span<const double>, const Wander<double>*);
template tl::expected<std::vector<ceres::Jet<double, 4>>, PredictionFailure> predict_with_effects(
    const model::Parameters<ceres::Jet<double, 4>>&, const effects::Values<ceres::Jet<double, 4>>&,
    const datasets::OedometerTest&, const OedometerProtocol&, std::span<const ceres::Jet<double, 4>>,
    const Wander<ceres::Jet<double, 4>>*);
template tl::expected<std::vector<ceres::Jet<double, 8>>, PredictionFailure> predict_with_effects(
    const model::Parameters<ceres::Jet<double, 8>>&, const effects::Values<ceres::Jet<double, 8>>&,
    const datasets::OedometerTest&, const OedometerProtocol&, std::span<const ceres::Jet<double, 8>>,
    const Wander<ceres::Jet<double, 8>>*);

}  // namespace isotach::experiments
