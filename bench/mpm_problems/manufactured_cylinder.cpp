// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/manufactured_cylinder.hpp"

#include <fmt/format.h>

#include <numbers>

#include "bench/mpm_problems/convergence.hpp"

namespace isotach::bench {

namespace {

constexpr double kPi = std::numbers::pi;

/// u = shape(X) s(t), s = sin(w t).
void set_motion(ElasticProblem& problem, double w, const std::function<Pair(Pair)>& shape) {
  problem.displacement = [=](Pair x, double t) {
    const Pair u = shape(x);
    return Pair{u.r * std::sin(w * t), u.z * std::sin(w * t)};
  };
  problem.velocity = [=](Pair x, double t) {
    const Pair u = shape(x);
    return Pair{u.r * w * std::cos(w * t), u.z * w * std::cos(w * t)};
  };
  problem.shape_time = 0.5 * kPi / w;
}

ElasticProblem rings(double amplitude, const ElasticConstants& material) {
  ElasticProblem problem;
  problem.material = material;
  problem.sides = {mpm::Side::symmetric, mpm::Side::symmetric, mpm::Side::symmetric, mpm::Side::symmetric};
  set_motion(problem, manufactured_frequency(material), [=](Pair x) {
    return Pair{amplitude * x.r * (1.0 - x.r * x.r), 0.0};
  });
  return problem;
}

}  // namespace

double manufactured_frequency(const ElasticConstants& material) {
  return 0.5 * kPi * material.wave_speed();
}

ElasticProblem barrel_problem(double amplitude, const ElasticConstants& material) {
  ElasticProblem problem;
  problem.material = material;
  problem.sides = {mpm::Side::symmetric, mpm::Side::open, mpm::Side::fixed, mpm::Side::fixed};
  problem.open_right = 3.0;
  const double w = manufactured_frequency(material);
  const double mu = material.shear();
  const double lambda = material.lame();
  const double rho = material.density;
  const double a = amplitude;
  set_motion(problem, w, [=](Pair x) { return Pair{a * x.r * std::sin(kPi * x.z), 0.0}; });
  problem.force = [=](Pair x, double t) {
    const double s = std::sin(w * t);
    return Pair{a * x.r * std::sin(kPi * x.z) * (-w * w + mu / rho * kPi * kPi) * s,
                -2.0 * a / rho * kPi * (lambda + mu) * std::cos(kPi * x.z) * s};
  };
  problem.traction = [=](Pair x, double t) {
    const double s = std::sin(w * t);
    return Pair{2.0 * (lambda + mu) * a * std::sin(kPi * x.z) * s,
                mu * a * x.r * kPi * std::cos(kPi * x.z) * s};
  };
  return problem;
}

ElasticProblem shifted_rings_problem(double amplitude, const ElasticConstants& material) {
  ElasticProblem problem = rings(amplitude, material);
  const double w = manufactured_frequency(material);
  const double modulus = material.wave_modulus();
  const double rho = material.density;
  problem.force = [=](Pair x, double t) {
    const double u = amplitude * x.r * (1.0 - x.r * x.r);
    return Pair{(-w * w * u + 8.0 * modulus * amplitude * x.r / rho) * std::sin(w * t), 0.0};
  };
  return problem;
}

ElasticProblem finite_rings_problem(double amplitude, const ElasticConstants& material) {
  ElasticProblem problem = rings(amplitude, material);
  const double w = manufactured_frequency(material);
  const double mu = material.shear();
  const double lambda = material.lame();
  const double rho = material.density;
  problem.force = [=](Pair x, double t) {
    const double a = amplitude * std::sin(w * t);
    const double r2 = x.r * x.r;
    const double along = 1.0 + a * (1.0 - 3.0 * r2);  // stretches
    const double around = 1.0 + a * (1.0 - r2);
    const double d_along = -6.0 * a * x.r;
    const double d_around = -2.0 * a * x.r;
    const double ln_j = std::log(along * around);
    const double sigma_r = lambda * ln_j + 2.0 * mu * std::log(along);
    const double sigma_hoop = lambda * ln_j + 2.0 * mu * std::log(around);
    const double d_sigma_r = (lambda + 2.0 * mu) * d_along / along + lambda * d_around / around;
    // nominal stresses sigma_r around, sigma_hoop along
    const double divergence =
        d_sigma_r * around + sigma_r * d_around + (sigma_r * around - sigma_hoop * along) / x.r;
    return Pair{-w * w * a * x.r * (1.0 - r2) - divergence / rho, 0.0};
  };
  return problem;
}

MotionErrors manufactured(ElasticProblem problem, int cells, const Numerics& numerics) {
  const double cell = problem.width / cells;
  // what does not vary along z needs no more than two cells
  if (!problem.traction) problem.height = 2.0 * cell;
  return follow(problem, cell, 4.0 * problem.shape_time, numerics);
}

Section manufactured_cylinder_section() {
  Section section;
  section.title = "Manufactured motions of a cylinder";
  section.text =
      R"(Body forces that are derived from a motion (and checked by automatic differentiation) drive a cylinder of
R = H = 1 m over a period 4R/c from rest; numerics and errors as for the bar.

- Barrel: u_r = A r sin(pi z/H) sin(w t), u_z = 0, held at z = 0 and H. Both parts of the traction at r = R,
  2 (lambda + mu) A sin(pi z/H) s and mu A R (pi/H) cos(pi z/H) s, act on points without mass that lie on r = R.
- Rings: u_r = A r (1 - r^2/R^2) sin(w t), u_z = 0, all sides symmetric.
- Finite rings: the same motion at any A, with the body force of finite strain for a Cauchy stress
  lambda ln J 1 + 2 mu ln V; since nothing turns, this is what the engine's material is.

First table, A = 1e-6: as long as points stay where they were in their cells, the order is 2, with and without averaging.

Second table, finite rings at larger A (the largest displacement is 0.38 A; `crossed` is the largest part of the points
that was outside of the cell it started in). The order is lost before any point crosses: moved by part of a cell, a
cell's points no longer cancel the spline's third moments (see the column), which leaves strains in proportion to u'' times
the displacement, whatever the cell. With three nodes a direction the only gradient without such moments is the
spline's own. Once most points have crossed, errors of displacement fall with h or more slowly, and those of velocity
do not fall; what the grid cannot hold has no part in that, plain APIC does no better. More points a cell make all of
them smaller. The larger error of averaging hides them in coarse cells.)";
  const auto sweep = [](Convergence& table, const char* name, const ElasticProblem& problem,
                        const std::vector<int>& all) {
    for (const bool averaged : {false, true}) {
      for (const int cells : all) {
        const Numerics numerics{.averaged = averaged};
        const MotionErrors e = manufactured(problem, cells, numerics);
        table.add({name, named(numerics)}, cells, {e.velocity, e.displacement});
      }
    }
  };
  constexpr double kSmall = 1e-6;
  Convergence small({"motion", "numerics"}, {"velocity", "displacement"});
  sweep(small, "barrel", barrel_problem(kSmall), {8, 16, 32, 64});
  sweep(small, "rings", shifted_rings_problem(kSmall), {8, 16, 32, 64, 128});
  sweep(small, "finite rings", finite_rings_problem(kSmall), {8, 16, 32, 64, 128});
  section.tables.push_back(small.table());

  Convergence large({"A", "numerics"}, {"velocity", "displacement"}, {"crossed"});
  const auto run = [&large](double amplitude, const Numerics& numerics) {
    for (const int cells : {16, 32, 64, 128}) {
      const MotionErrors e = manufactured(finite_rings_problem(amplitude), cells, numerics);
      large.add({fmt::format("{:g}", amplitude), named(numerics)}, cells, {e.velocity, e.displacement},
                {fmt::format("{:.2f}", e.crossed)});
    }
  };
  for (const double amplitude : {1e-3, 1e-2, 0.1}) {
    run(amplitude, {});
    run(amplitude, {.averaged = true});
    run(amplitude, {.points = 4});
  }
  run(0.1, {.residual_time = 0.0});
  section.tables.push_back(large.table());
  return section;
}

}  // namespace isotach::bench
