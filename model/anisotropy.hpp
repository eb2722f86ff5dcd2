// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How the anisotropy tensor Omega of the preconsolidation ellipse turns with viscous flow.
#pragma once

#include "model/mandel.hpp"

namespace isotach::model {

/// Corotational rate of Omega (1/s),
///
///   dOmega/dt = C_2 (C_3 T*/p - Omega) |D_vis|:
///
/// viscous flow draws Omega towards C_3 times the stress ratio tensor T*/p, over a viscous strain of 1/C_2.
///
/// Provenance: Niemunis, Grandas-Tavera and Prada-Sarmiento, "Anisotropic visco-hypoplasticity", Acta
/// Geotechnica 4 (2009) 293-314, let the ellipse rotate with two constants C_2 and C_3. The exact published
/// form could not be had; this one is the project's own, of the same kind (an attractor proportional to the
/// stress ratio, reached by viscous flow). It stands in this function alone, so that the published form can
/// take its place.
template <class P, class S, int N>
[[nodiscard]] Mandel<S, N> rotation_rate(const P& C_2, const P& C_3, const Mandel<S, N>& stress_ratio,
                                         const Mandel<S, N>& omega, const S& viscous_rate) {
  const S attraction(C_3);
  const S speed = viscous_rate * C_2;
  return (stress_ratio * attraction - omega) * speed;
}

}  // namespace isotach::model
