// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Compliance of frame, stones and load cell.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::apparatus_compliance {

enum Parameter : std::size_t { C };

inline constexpr std::array kParameters{
    EffectParameter{"C_m_per_kPa", "m/kPa", "settlement of the apparatus for a unit of stress", 1e-3, 0.0,
                    1e-4, false, 2e-7},
};

inline constexpr Effect kEffect{
    .name = "apparatus_compliance",
    .meaning = "the frame, the porous stones and the load cell give way in proportion to the load",
    .equation = "eps_m = eps + C sigma/H0",
    .source = "ASTM D2435 and ISO 17892-5 ask for it to be measured and taken off",
    .seam = Seam::instrument,
    .test = TestKind::oedometer,
    .height_exponent = -1,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::apparatus_compliance
