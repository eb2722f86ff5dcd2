// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Gas in the pores.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::gas {

enum Parameter : std::size_t { S_g };

inline constexpr std::array kParameters{
    EffectParameter{"S_g", "-", "share of the pores that gas fills at atmospheric pressure", 1.0, 0.0, 0.5,
                    false, 0.02},
};

inline constexpr Effect kEffect{
    .name = "gas",
    .meaning = "bubbles in the pores shrink under load and grow again under unloading",
    .equation = "eps_m = eps + n S_g sigma/(p_abs + sigma), p_abs = 101.3 kPa",
    .source =
        "Boyle's law at constant temperature for bubbles that take the load's pressure; Fredlund and "
        "Rahardjo, Soil Mechanics for Unsaturated Soils (1993), ch. 2",
    .seam = Seam::instrument,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::gas
