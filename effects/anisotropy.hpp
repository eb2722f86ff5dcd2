// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fabric that leans, and turns with flow.
#pragma once

#include <array>

#include "effects/effect.hpp"

namespace isotach::effects::anisotropy {

enum Parameter : std::size_t { Omega_0, C_2, C_3 };

inline constexpr std::array kParameters{
    EffectParameter{"Omega_0", "-", "stress ratio q/p that the axis of the ellipse points at, at the start",
                    1.0, 0.0, 1.2, false, 0.3},
    EffectParameter{"C_2", "-", "viscous strain over which the fabric turns, inverted", 1.0, 0.0, 1e3, false,
                    20.0},
    EffectParameter{"C_3", "-", "steady Omega over the stress ratio T*/p, over Omega_0", 1.0, 0.0, 3.0, false,
                    1.0},
};

inline constexpr Effect kEffect{
    .name = "anisotropy",
    .meaning =
        "the grains' arrangement remembers how the specimen was formed, and viscous flow rearranges it",
    .equation =
        "Omega = Omega_0 diag(2, -1, -1)/3 at the start, dOmega/dt = C_2 (Omega_0 C_3 T*/p - Omega) |D_vis|, "
        "compression positive",
    .source =
        "Niemunis, Grandas-Tavera and Prada-Sarmiento, Acta Geotechnica 4 (2009) 293-314; the rotation law "
        "is the project's own",
    .seam = Seam::law,
    .test = TestKind::oedometer,
    .height_exponent = 0,
    .parameters = kParameters,
    .need = Need::nothing,
};

}  // namespace isotach::effects::anisotropy
