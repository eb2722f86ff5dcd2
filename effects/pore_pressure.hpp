// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Excess pore pressure at the base.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::pore_pressure {

enum Parameter : std::size_t { inverse_k, c_k };

inline constexpr std::array kParameters{
    EffectParameter{"inverse_k_s_per_m", "s/m", "1/k, k the hydraulic conductivity at e0", 1.0, 0.0, 1e13,
                    false, 2e8},
    EffectParameter{"c_k", "-", "change of e over e0 for a decade of k", 1.0, 0.05, 10.0, false, 0.5},
};

inline constexpr Effect kEffect{
    .name = "pore_pressure",
    .meaning =
        "water has to be pushed out of the specimen, so that a part of the measured stress is its pressure",
    .equation =
        "measured stress = sigma' + (2/3) u_b, u_b = (-dH/dt/H) gamma_w H^2/(2 k(e)), k(e) = k 10^((e - "
        "e0)/(c_k e0))",
    .source =
        "Smith and Wahls, J. Soil Mech. Found. Div. 95 (1969) 519-539; k(e): Taylor, Fundamentals of Soil "
        "Mechanics (1948); c_k: Tavenas et al., Can. Geotech. J. 20 (1983) 645-660",
    .seam = Seam::instrument,
    .test = TestKind::oedometer,
    .height_exponent = 2,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::pore_pressure
