// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mud that sticks to the mould.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::wall_adhesion {

enum Parameter : std::size_t { adhesion };

inline constexpr std::array kParameters{
    EffectParameter{"adhesion_kPa", "kPa", "largest shear traction between mud and wall", 1e3, 0.0, 5.0,
                    false, 0.02},
};

inline constexpr Effect kEffect{
    .name = "wall_adhesion",
    .meaning = "the wall drags the mud along while the mould is lifted",
    .equation = "shear traction of the wall on the mud <= adhesion, toward the moving wall",
    .source = "the limit that cohesive interfaces have; Pippi et al., who grease their mould to be rid of it",
    .seam = Seam::boundary,
    .test = TestKind::slump,
    .height_exponent = -1,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::wall_adhesion
