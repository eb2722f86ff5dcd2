// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mud that slides on its base.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::basal_slip {

enum Parameter : std::size_t { slip_length };

inline constexpr std::array kParameters{
    EffectParameter{"slip_length_mm", "mm", "slip velocity over dv_r/dz at the base", 1e-3, 0.0, 1000.0,
                    false, 3.0},
};

inline constexpr Effect kEffect{
    .name = "basal_slip",
    .meaning = "a film of water at the base lets the mud slide",
    .equation = "v_r = slip_length dv_r/dz at the base",
    .source =
        "Navier, Mem. Acad. Sci. Inst. France 6 (1823); slip of suspensions: Barnes, J. Non-Newton. Fluid "
        "Mech. 56 (1995) 221-251",
    .seam = Seam::boundary,
    .test = TestKind::slump,
    .height_exponent = -1,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::basal_slip
