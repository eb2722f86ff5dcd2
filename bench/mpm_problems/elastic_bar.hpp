// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A bar in its first mode, confined across, one end held and one free.
#pragma once

#include "bench/mpm_problems/elastic_body.hpp"
#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// v = v0 sin(b x) cos(w t), b = pi/(2L), w = b sqrt(M/rho), L = 1 m, v0 = strain c.
[[nodiscard]] ElasticProblem elastic_bar_problem(double strain);

struct BarErrors {
  MotionErrors motion;     ///< over a period
  double frequency = 0.0;  ///< relative; from three periods
};
/// `cells` along the bar, or that and a half: its free end is then in the middle of a cell. Strains of 1e-6
/// leave every point in its cell.
[[nodiscard]] BarErrors elastic_bar(double cells, const Numerics& numerics);

[[nodiscard]] Section elastic_bar_section();

}  // namespace isotach::bench
