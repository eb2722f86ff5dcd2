// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One noise for the tests that were read by one apparatus.
#pragma once

#include <optional>
#include <vector>

#include "calibration/noise_model.hpp"

namespace isotach::calibration {

/// The noise of several channels of one unit taken together, by restricted maximum likelihood as
/// estimate_noise has it: level, floor, rho and serial_share are the same for all, effective_count is that of
/// all. Two tests tell them twice as well as one. Nothing where the channels' `own` noises, estimated one by
/// one, say otherwise: where they are better by BIC, each number of theirs charged with the logarithm of the
/// count of values. `other_information` and `other_gradient` are of what else the fit sees. Throws as
/// estimate_noise does, and std::invalid_argument for no channel or another number of noises.
[[nodiscard]] std::optional<NoiseModel> shared_noise(const std::vector<const Channel*>& channels,
                                                     const std::vector<NoiseModel>& own,
                                                     const Eigen::MatrixXd& other_information,
                                                     const Eigen::VectorXd& other_gradient, NoiseParts parts);

}  // namespace isotach::calibration
