// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A mould that starts later than the clock.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::lift_delay {

enum Parameter : std::size_t { delay };

inline constexpr std::array kParameters{
    EffectParameter{"delay_s", "s", "time at which the mould starts", 1.0, 0.0, 30.0, false, 0.1},
};

inline constexpr Effect kEffect{
    .name = "lift_delay",
    .meaning = "the mould starts to rise some time after the clock does",
    .equation = "rim at z_w(t - delay), at rest before",
    .source = "the project's own",
    .seam = Seam::boundary,
    .test = TestKind::slump,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::lift_delay
