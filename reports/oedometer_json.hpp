// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An oedometer fit as it stands in result.json.
#pragma once

#include <nlohmann/json.hpp>

#include "calibration/fit_oedometer.hpp"
#include "datasets/study.hpp"

namespace isotach::reports {

/// All of the fit but the file's head. What a fit without assessment has not is null.
[[nodiscard]] nlohmann::ordered_json oedometer_fit_json(const datasets::Study& study,
                                                        const calibration::OedometerFit& fit);

}  // namespace isotach::reports
