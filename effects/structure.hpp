// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Structure that viscous flow destroys.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::structure {

enum Parameter : std::size_t { r, k };

inline constexpr std::array kParameters{
    EffectParameter{"r", "-", "what structure adds to p_B, over p_B", 1.0, 0.0, 10.0, false, 0.3},
    EffectParameter{"k", "-", "viscous strain over which it decays, inverted", 1.0, 0.0, 1e3, false, 10.0},
};

inline constexpr Effect kEffect{
    .name = "structure",
    .meaning = "bonds between grains carry more than the void ratio alone would, until flow has broken them",
    .equation = "p_B (1 + r chi), dchi/dt = -k |D_vis| chi, chi = 1 at the start",
    .source = "the project's own, of the kind of Liu and Carter, Can. Geotech. J. 39 (2002) 1313-1332",
    .seam = Seam::law,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::structure
