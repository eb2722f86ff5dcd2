// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Temperature of the specimen.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::temperature {

enum Parameter : std::size_t { a, theta_0 };

inline constexpr std::array kParameters{
    EffectParameter{"a_per_K", "1/K", "decrease of ln p_B for a degree", 1.0, 0.0, 0.1, false, 0.01},
    EffectParameter{"theta_0_C", "deg C", "temperature at which the other parameters hold", 1.0, -20.0, 100.0,
                    false, 20.0, Default::typical},
};

inline constexpr Effect kEffect{
    .name = "temperature",
    .meaning = "a warmer specimen yields at a lower stress",
    .equation = "p_B exp(-a (theta - theta_0))",
    .source =
        "Leroueil and Marques, ASCE Geotech. Spec. Publ. 61 (1996) 1-60; Boudali, Leroueil and Murthy, 13th "
        "ICSMFE (1994)",
    .seam = Seam::law,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::temperature,
};

}  // namespace isotach::effects::temperature
