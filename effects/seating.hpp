// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Bedding of the stones on the specimen.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::seating {

enum Parameter : std::size_t { delta, sigma_s };

inline constexpr std::array kParameters{
    EffectParameter{"delta_m", "m", "settlement of the bedding once it is complete", 1.0, 0.0, 5e-3, false,
                    1e-4},
    EffectParameter{"sigma_s_kPa", "kPa", "stress over which it comes about", 1e3, 0.1, 1e3, false, 10.0},
};

inline constexpr Effect kEffect{
    .name = "seating",
    .meaning = "the faces of the specimen bed into the stones at the first low stresses, once and for all",
    .equation = "eps_m = eps + (delta/H0)(1 - exp(-sigma_max/sigma_s))",
    .source = "the project's own form of what ASTM D2435 calls seating",
    .seam = Seam::instrument,
    .test = TestKind::oedometer,
    .height_exponent = -1,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::seating
