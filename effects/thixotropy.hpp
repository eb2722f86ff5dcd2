// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Strength that shear breaks and rest builds.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::thixotropy {

enum Parameter : std::size_t { s, t_a, beta };

inline constexpr std::array kParameters{
    EffectParameter{"s", "-", "what long rest adds to p_B, over p_B", 1.0, 0.0, 50.0, false, 0.5},
    EffectParameter{"t_a_s", "s", "time in which rest builds strength", 1.0, 0.1, 1e6, false, 100.0},
    EffectParameter{"beta", "-", "shear strain over which flow breaks it, inverted", 1.0, 1e-3, 1e3, false,
                    1.0},
};

inline constexpr Effect kEffect{
    .name = "thixotropy",
    .meaning = "mud at rest gains strength, and loses it as it is sheared",
    .equation = "p_B (1 + s xi), dxi/dt = (1 - xi)/t_a - beta xi gamma_rate, xi = 1 at the start",
    .source =
        "kinetics of Moore, Trans. Br. Ceram. Soc. 58 (1959) 470-494; see Mewis and Wagner, Adv. Colloid "
        "Interface Sci. 147 (2009) 214-227",
    .seam = Seam::law,
    .test = TestKind::slump,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::thixotropy
