// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Viscous resistance of the mixture.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::high_rate_viscosity {

enum Parameter : std::size_t { K, n };

inline constexpr std::array kParameters{
    EffectParameter{"K_kPa_s_n", "kPa s^n", "consistency", 1e3, 0.0, 10.0, false, 0.01},
    EffectParameter{"n", "-", "flow index", 1.0, 0.1, 2.0, false, 0.5},
};

inline constexpr Effect kEffect{
    .name = "high_rate_viscosity",
    .meaning = "fast flow meets a viscous resistance beside that of the skeleton",
    .equation = "extra deviatoric stress 2 (K gamma_rate^(n-1)) D*",
    .source = "Herschel and Bulkley, Kolloid-Z. 39 (1926) 291-300, without yield stress",
    .seam = Seam::law,
    .test = TestKind::slump,
    .height_exponent = -1,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::high_rate_viscosity
