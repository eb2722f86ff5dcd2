// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/breathing_cylinder.hpp"

#include <fmt/format.h>

#include <numbers>

#include "bench/mpm_problems/convergence.hpp"

namespace isotach::bench {

double breathing_wave_number(double poisson) {
  const double ratio = (1.0 - 2.0 * poisson) / (1.0 - poisson);
  const auto left = [ratio](double x) {
    return x * std::cyl_bessel_j(0.0, x) - ratio * std::cyl_bessel_j(1.0, x);
  };
  // left(), x (1 - ratio/2) for small x, is positive there and negative at the first zero of J0
  double low = 0.01;
  double high = 2.4048255576957728;
  while (high - low > 1e-14) {
    const double middle = 0.5 * (low + high);
    (left(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

BreathingErrors breathing_cylinder(int cells, const Numerics& numerics, const ElasticConstants& material) {
  constexpr double kAmplitude = 1e-6;
  ElasticProblem problem;
  problem.material = material;
  problem.sides = {mpm::Side::symmetric, mpm::Side::open, mpm::Side::symmetric, mpm::Side::symmetric};
  problem.open_right = 3.0;
  const double cell = problem.width / cells;
  problem.height = 2.0 * cell;
  const double k = breathing_wave_number(material.poisson);
  const double w = k * material.wave_speed();
  const auto shape = [k](double r) {
    return kAmplitude * std::copysign(std::cyl_bessel_j(1.0, k * std::abs(r)), r);
  };
  problem.displacement = [=](Pair x, double t) { return Pair{shape(x.r) * std::sin(w * t), 0.0}; };
  problem.velocity = [=](Pair x, double t) { return Pair{shape(x.r) * w * std::cos(w * t), 0.0}; };
  const double period = 2.0 * std::numbers::pi / w;
  problem.shape_time = 0.25 * period;
  BreathingErrors errors;
  errors.motion = follow(problem, cell, period, numerics);
  const MotionErrors longer = follow(problem, cell, 3.0 * period, numerics);
  errors.frequency = fitted_frequency(longer.times, longer.amplitudes, w) / w - 1.0;
  return errors;
}

Section breathing_cylinder_section() {
  Section section;
  section.title = "Radial breathing of a free cylinder";
  section.text =
      R"(u_r = a J1(k r) sin(w t), nothing along the axis; kR is the smallest root of
kR J0(kR) = [(1 - 2 nu)/(1 - nu)] J1(kR), which leaves the surface free, and w = k sqrt((lambda + 2 mu)/rho). R = 1 m,
a = 1e-6 m; numerics and errors as for the bar. The axis and the hoop terms enter here. The order is 2 with and without
averaging, also close to incompressibility. The average makes the error larger: it sees tr D over two cells.)";
  Convergence table({"numerics", "nu"}, {"velocity", "displacement", "frequency"});
  for (const double poisson : {0.3, 0.49}) {
    for (const bool averaged : {false, true}) {
      for (const int cells : {8, 16, 32, 64, 128}) {
        const Numerics numerics{.averaged = averaged};
        const BreathingErrors e = breathing_cylinder(cells, numerics, {.poisson = poisson});
        table.add({named(numerics), fmt::format("{:g}", poisson)}, cells,
                  {e.motion.velocity, e.motion.displacement, e.frequency});
      }
    }
  }
  section.tables.push_back(table.table());
  return section;
}

}  // namespace isotach::bench
