// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Water that leaves the mud.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::bleeding {

enum Parameter : std::size_t { rate };

inline constexpr std::array kParameters{
    EffectParameter{"rate_per_s", "1/s", "share of the pore pressure that drains in a second", 1.0, 0.0, 10.0,
                    false, 0.3},
};

inline constexpr Effect kEffect{
    .name = "bleeding",
    .meaning = "water seeps out, the pore pressure fades and the mud loses volume",
    .equation = "du/dt = -(K_w/n) tr D - rate u",
    .source = "the project's own: consolidation with a single time scale",
    .seam = Seam::law,
    .test = TestKind::slump,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::bleeding
