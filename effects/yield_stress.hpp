// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Resistance that does not creep.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::yield_stress {

enum Parameter : std::size_t { tau_y };

inline constexpr std::array kParameters{
    EffectParameter{"tau_y_kPa", "kPa", "shear stress that this resistance reaches", 1e3, 0.0, 5.0, false,
                    0.01},
};

inline constexpr Effect kEffect{
    .name = "yield_stress",
    .meaning = "a part of the shear resistance does not creep, so that the slump comes to rest",
    .equation = "extra deviatoric stress, |T*| <= sqrt(2) tau_y, elastic below (regularised)",
    .source = "Bingham, Fluidity and Plasticity (1922); von Mises' limit",
    .seam = Seam::law,
    .test = TestKind::slump,
    .height_exponent = -1,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::yield_stress
