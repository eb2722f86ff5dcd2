// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Cylinders that body forces drive along given motions.
#pragma once

#include "bench/mpm_problems/elastic_body.hpp"
#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// u_r = A r sin(pi z/H) s, u_z = 0, s = sin(w t), R = H = 1 m; small strains. Held at z = 0 and H, loaded by
/// the traction that goes with it at r = R.
[[nodiscard]] ElasticProblem barrel_problem(double amplitude, const ElasticConstants& material = {});
/// u_r = A r (1 - r^2/R^2) s, u_z = 0; small strains. Nothing moves across r = R, z = 0 and H.
[[nodiscard]] ElasticProblem shifted_rings_problem(double amplitude, const ElasticConstants& material = {});
/// The same motion at any strain, of a material whose Cauchy stress is lambda ln J 1 + 2 mu ln V: what the
/// engine's elastic material is where nothing turns.
[[nodiscard]] ElasticProblem finite_rings_problem(double amplitude, const ElasticConstants& material = {});

/// w (rad/s) of all three: that of a wave of length 4 R.
[[nodiscard]] double manufactured_frequency(const ElasticConstants& material);

/// Over the period 2 pi/w; `cells` along the radius.
[[nodiscard]] MotionErrors manufactured(ElasticProblem problem, int cells, const Numerics& numerics);

[[nodiscard]] Section manufactured_cylinder_section();

}  // namespace isotach::bench
