// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/oedometer_information.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/oedometer_protocol.hpp"

namespace isotach::calibration {

namespace {

constexpr double kStartStress = 4e3;  // Pa
constexpr double kStartOcr = 1.5;
constexpr double kFirstReading = 1e-3;  // of a relaxation's duration

/// The void ratio at which the start has the overconsolidation ratio kStartOcr.
double assumed_void_ratio(const model::Parameters<double>& material, double K0) {
  const model::Law<double> law(material);
  model::State<double, model::kAxial> state;
  state.stress[0] = -kStartStress;
  state.stress[1] = -K0 * kStartStress * std::numbers::sqrt2;
  state.void_ratio = 1.0;  // of no account for the stresses' ellipse
  return law.void_ratio_at(kStartOcr * law.measures(state).equivalent_pressure);
}

/// Level of independent readings that would hold a mean as well as these.
double level_of_mean(const ChannelNoise& noise) {
  return noise.model.level * std::sqrt(noise.model.of_mean());
}

}  // namespace

OedometerSetting setting_of(const datasets::Study& study, const model::Parameters<double>& material) {
  for (const datasets::OedometerTest& test : study.oedometer_tests) {
    if (test.hold_out) continue;
    const experiments::OedometerStart start = experiments::make_protocol(test).start;
    return {start.void_ratio, start.axial_stress, test.initial_K0, test.noise};
  }
  const double K0 = 1.0 - std::sin(material.phi_c());
  return {assumed_void_ratio(material, K0), kStartStress, K0, {}};
}

std::optional<ChannelNoise> noisiest_stress(const NoiseFit& noise) {
  std::optional<ChannelNoise> chosen;
  for (const ChannelNoise& channel : noise.channels) {
    if (!channel.quantity.starts_with("ln(")) continue;
    if (!chosen || level_of_mean(channel) > level_of_mean(*chosen)) chosen = channel;
  }
  return chosen;
}

tl::expected<datasets::OedometerTest, std::string> test_of(const datasets::CandidateOedometer& candidate,
                                                           const OedometerSetting& setting,
                                                           const model::Parameters<double>& material) {
  datasets::OedometerTest test{};
  test.name = candidate.name;
  test.height = 0.02;  // of no account: nothing compared depends on it
  test.void_ratio = candidate.void_ratio.value_or(setting.void_ratio);
  test.initial_K0 = candidate.K0.value_or(setting.K0);
  test.initial_axial_stress = candidate.axial_stress.value_or(setting.axial_stress);
  test.noise = setting.noise;
  const int readings = std::max(4, candidate.readings / static_cast<int>(candidate.stages.size()));
  double time = 0.0;
  double strain = 0.0;
  for (const datasets::CandidateStage& stage : candidate.stages) {
    const bool relaxes = stage.stage == datasets::Stage::relax;
    const double duration = relaxes ? stage.duration : std::abs(stage.strain - strain) / stage.rate;
    for (int i = 1; i <= readings; ++i) {
      const double share = static_cast<double>(i) / readings;
      datasets::OedometerRow row{};
      row.line = test.record.rows.size() + 1;
      row.time = time + duration * (relaxes ? std::pow(kFirstReading, 1.0 - share) : share);
      row.axial_strain = strain + share * (stage.strain - strain);
      row.axial_stress = *test.initial_axial_stress;  // until it is known
      row.stage = stage.stage;
      test.record.rows.push_back(row);
    }
    time += duration;
    strain = stage.strain;
  }
  const experiments::OedometerExperiment blind(test);
  const auto path = blind.path(material, blind.local_values(), experiments::Route::fellin_ostermann);
  if (!path) return tl::unexpected(path.error().message);
  for (const experiments::PathPoint& point : *path) {
    if (point.row != experiments::kNoRow) test.record.rows[point.row].axial_stress = point.axial_stress;
  }
  return test;
}

tl::expected<Eigen::MatrixXd, std::string> oedometer_jacobian(
    const experiments::OedometerExperiment& experiment, const Parametrisation& parametrisation,
    const std::vector<double>& x, const std::optional<ChannelNoise>& noise) {
  const auto tangent = parametrisation.tangent(x);
  if (!tangent) return tl::unexpected(tangent.error());
  constexpr std::size_t kNew =
      std::numeric_limits<std::size_t>::max();  // none of the parametrisation's tests
  const auto at = experiment.linearise(tangent->parameters, experiment.local_values(),
                                       parametrisation.directions(*tangent, x, kNew));
  if (!at) return tl::unexpected(at.error().message);
  Eigen::MatrixXd jacobian = at->jacobian;
  const auto rows = jacobian.rows();
  const experiments::Channel read = experiment.channels().front();  // strain-controlled: all is ln stress
  if (!noise) {
    jacobian.array().colwise() /= Eigen::Map<const Eigen::ArrayXd>(experiment.noise().data(), rows);
    return jacobian;
  }
  Channel channel;
  channel.residuals = Eigen::VectorXd::Zero(rows);
  channel.jacobian = jacobian;
  channel.inverse_stress = read.inverse_stress;
  channel.known_variance = read.known_variance;
  channel.chain_starts = read.chains;
  NoiseModel model = noise->model;
  if (noise->misfit) {  // as a fit weighs it: independent, and wider
    model.level = level_of_mean(*noise);
    model.rho = 0.0;
  }
  Whitening(model, channel).whiten(jacobian);
  return jacobian;
}

}  // namespace isotach::calibration
