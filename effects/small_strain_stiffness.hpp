// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stiffness just after a reversal.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::small_strain_stiffness {

enum Parameter : std::size_t { m, eps_r };

inline constexpr std::array kParameters{
    EffectParameter{"m", "-", "what a reversal adds to the stiffness, over the stiffness", 1.0, 0.0, 30.0,
                    false, 1.0},
    EffectParameter{"eps_r", "-", "strain over which that fades", 1.0, 1e-5, 0.2, false, 3e-3},
};

inline constexpr Effect kEffect{
    .name = "small_strain_stiffness",
    .meaning = "after the direction of strain has turned the specimen is stiffer, for a while",
    .equation = "kappa/(1 + m exp(-|eps - eps_rev|/eps_r))",
    .source =
        "the project's own, of the kind of the intergranular strain of Niemunis and Herle, Mech. "
        "Cohes.-Frict. Mater. 2 (1997) 279-299",
    .seam = Seam::law,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::small_strain_stiffness
