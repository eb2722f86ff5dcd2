// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Friction between specimen and ring.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::ring_friction {

enum Parameter : std::size_t { mu };

inline constexpr std::array kParameters{
    EffectParameter{"mu", "-", "coefficient of friction between specimen and ring", 1.0, 0.0, 0.6, false,
                    0.1},
};

inline constexpr Effect kEffect{
    .name = "ring_friction",
    .meaning = "the ring holds back a part of the load, against the direction of compression",
    .equation = "measured stress = sigma' + s 2 mu sigma_h H/D",
    .source =
        "balance of a specimen in a rigid ring, friction at its mean height; Lambe and Whitman, Soil "
        "Mechanics (1969), ch. 9; Olson, ASTM STP 892 (1986)",
    .seam = Seam::instrument,
    .test = TestKind::oedometer,
    .height_exponent = 1,
    .parameters = kParameters,
    .need = Need::diameter,
};

}  // namespace isotach::effects::ring_friction
