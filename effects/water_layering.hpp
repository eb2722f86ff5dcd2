// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Water content that varies over the fill.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::water_layering {

enum Parameter : std::size_t { g };

inline constexpr std::array kParameters{
    EffectParameter{"g", "-", "void ratio at the top less that at the base", 1.0, -5.0, 5.0, false, 0.3},
};

inline constexpr Effect kEffect{
    .name = "water_layering",
    .meaning = "the fill has settled: wetter above than below, or the other way round",
    .equation = "void ratio e0 + g (z/H - 1/2) in the filled mould",
    .source = "the project's own",
    .seam = Seam::initial_state,
    .test = TestKind::slump,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::water_layering
