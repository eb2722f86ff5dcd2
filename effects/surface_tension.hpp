// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tension of the free surface.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::surface_tension {

enum Parameter : std::size_t { tension };

inline constexpr std::array kParameters{
    EffectParameter{"N_per_m", "N/m", "tension of the surface", 1.0, 0.0, 10.0, false, 0.07},
};

inline constexpr Effect kEffect{
    .name = "surface_tension",
    .meaning = "the skin of water rounds edges and holds small slumps together",
    .equation = "energy of the free surface: tension times its area",
    .source =
        "water at 20 C: 0.0728 N/m (IAPWS R1-76, 2014); Lafaurie et al., J. Comput. Phys. 113 (1994) 134-147",
    .seam = Seam::boundary,
    .test = TestKind::slump,
    .height_exponent = -2,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::surface_tension
