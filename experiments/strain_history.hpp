// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The strain that drives the model, from strains as they were read.
#pragma once

#include <vector>

#include "datasets/oedometer.hpp"

namespace isotach::experiments {

/// Engineering axial strain at each row as the apparatus commanded it: where strain was held, the mean
/// reading of the stage, from the last row before it on, so that noise of reading makes no strain rate there.
/// Everywhere else the reading itself.
[[nodiscard]] std::vector<double> commanded_strain(const datasets::OedometerRecord& record);

/// True where a stage of the record holds the strain: a recorded "relax", or a "hold" deduced from strains
/// that stand still. A recorded "hold" is one of stress.
[[nodiscard]] bool holds_strain(const datasets::OedometerRecord& record, datasets::Stage stage);

}  // namespace isotach::experiments
