// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What an oedometer test that has not been made yet would read, and with what noise.
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "calibration/noise_fit.hpp"
#include "calibration/parametrisation.hpp"
#include "datasets/candidates.hpp"
#include "experiments/oedometer_experiment.hpp"

namespace isotach::calibration {

/// Where candidates start that do not say so themselves.
struct OedometerSetting {
  double void_ratio;    ///< -
  double axial_stress;  ///< Pa
  double K0;            ///< -
  datasets::OedometerNoise noise;
};

/// The start of the study's first fitted test and its noise; without one 4 kPa, Jaky's K0, an
/// overconsolidation ratio of 1.5, and ordinary readings.
[[nodiscard]] OedometerSetting setting_of(const datasets::Study& study,
                                          const model::Parameters<double>& material);

/// The noise of ln stress that candidates are given: of the fitted channels the one whose level counts most
/// once correlation is allowed for. Nothing where no stress was fitted.
[[nodiscard]] std::optional<ChannelNoise> noisiest_stress(const NoiseFit& noise);

/// The test as it would be read with the model exact at `material`: readings evenly over strain, or over the
/// logarithm of time where the specimen relaxes. An error says why the law cannot be led through it.
[[nodiscard]] tl::expected<datasets::OedometerTest, std::string> test_of(
    const datasets::CandidateOedometer& candidate, const OedometerSetting& setting,
    const model::Parameters<double>& material);

/// Derivatives of the experiment's values by the parametrisation's coordinates, whitened by `noise`, or by
/// the noise that the test states where there is none.
[[nodiscard]] tl::expected<Eigen::MatrixXd, std::string> oedometer_jacobian(
    const experiments::OedometerExperiment& experiment, const Parametrisation& parametrisation,
    const std::vector<double>& x, const std::optional<ChannelNoise>& noise);

}  // namespace isotach::calibration
