// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Creep that slows more than the law says.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::delayed_creep {

enum Parameter : std::size_t { c };

inline constexpr std::array kParameters{
    EffectParameter{"c", "-", "viscous strain of a hold over which creep slows e-fold, inverted", 1.0, 0.0,
                    5e3, false, 30.0},
};

inline constexpr Effect kEffect{
    .name = "delayed_creep",
    .meaning = "while the specimen is held, bonds form and its creep or relaxation dies away early",
    .equation = "D_r exp(-c eps_creep) in place of D_r, eps_creep the viscous strain since a hold began",
    .source = "the project's own; ageing at rest: Schmertmann, J. Geotech. Eng. 117 (1991) 1288-1330",
    .seam = Seam::law,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::delayed_creep
