// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A free cylinder that breathes in its first radial mode.
#pragma once

#include "bench/mpm_problems/elastic_body.hpp"
#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// Smallest root kR of kR J0(kR) = [(1 - 2 nu)/(1 - nu)] J1(kR).
[[nodiscard]] double breathing_wave_number(double poisson);

struct BreathingErrors {
  MotionErrors motion;     ///< over a period
  double frequency = 0.0;  ///< relative; from three periods
};
/// u_r = a J1(k r) sin(w t), w = k sqrt((lambda + 2 mu)/rho), R = 1 m, a = 1e-6 m; `cells` along the radius.
[[nodiscard]] BreathingErrors breathing_cylinder(int cells, const Numerics& numerics,
                                                 const ElasticConstants& material = {});

[[nodiscard]] Section breathing_cylinder_section();

}  // namespace isotach::bench
