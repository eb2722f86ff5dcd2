// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Drift of the load sensor.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::sensor_drift {

enum Parameter : std::size_t { drift };

inline constexpr std::array kParameters{
    EffectParameter{"kPa_per_day", "kPa/d", "drift of the reading", 1e3 / 86400.0, -50.0, 50.0, false, 0.1},
};

inline constexpr Effect kEffect{
    .name = "sensor_drift",
    .meaning = "the reading of stress wanders off in proportion to time",
    .equation = "measured stress = sigma' + d t",
    .source = "the simplest drift there is",
    .seam = Seam::instrument,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::sensor_drift
