// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The strain that drives the model, from strains as they were read.
#pragma once

#include <vector>

#include "datasets/oedometer.hpp"

namespace isotach::experiments {

/// Engineering axial strain at each row as the apparatus commanded it. Where strain was held: the mean
/// reading of the stage, from the last row before it on, so that noise of reading makes no strain rate there.
/// While loading or unloading: the readings, where they step back the nearest ones (least squares) that do
/// not, so that noise does not reverse the direction commanded. Where stress was held: the reading.
[[nodiscard]] std::vector<double> commanded_strain(const datasets::OedometerRecord& record);

/// True where a stage of the record holds the strain: a recorded "relax", or a "hold" deduced from strains
/// that stand still. A recorded "hold" is one of stress.
[[nodiscard]] bool holds_strain(const datasets::OedometerRecord& record, datasets::Stage stage);

}  // namespace isotach::experiments
