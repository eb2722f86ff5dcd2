// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A viscosity index that changes with the strain rate.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::rate_dependent_viscosity {

enum Parameter : std::size_t { b, D_ref };

inline constexpr std::array kParameters{
    EffectParameter{"b", "-", "relative change of I_v from D_ref to much faster strain", 1.0, -0.7, 0.7,
                    false, 0.2},
    EffectParameter{"D_ref_per_s", "1/s", "strain rate at which I_v is that of the law", 1.0, 0.0, 1.0, true,
                    1e-6, Default::material_D_r},
};

inline constexpr Effect kEffect{
    .name = "rate_dependent_viscosity",
    .meaning = "a tenfold strain rate does not raise the stress by the same factor everywhere",
    .equation = "I_v (1 + b tanh(ln(|D|/D_ref)/3))",
    .source =
        "the project's own; that I_v changes over many decades of rate: Leroueil, 13th Danube-European Conf. "
        "Geotech. Eng. (2006), and Qu, Hinchberger and Lo, Geotechnique 60 (2010) 777-789",
    .seam = Seam::law,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::rate_dependent_viscosity
