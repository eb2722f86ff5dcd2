// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/self_weight_column.hpp"

#include <map>
#include <numbers>
#include <stdexcept>

#include "bench/mpm_problems/convergence.hpp"

namespace isotach::bench {

namespace {

/// The exact column; its height is 1 m.
struct Column {
  double weight;  ///< rho0 g/M (1/m)

  [[nodiscard]] double log_stretch(double z) const { return -weight * (1.0 - z); }
  [[nodiscard]] double displacement(double z) const {
    return (std::expm1(log_stretch(z)) - std::expm1(-weight)) / weight - z;
  }
};

void put_in_equilibrium(mpm::Particles& q, const Column& column, const ElasticConstants& material) {
  for (auto& stress : q.stress) stress.assign(q.count, 0.0);
  q.void_ratio.assign(q.count, 0.0);
  for (std::size_t i = 0; i < q.count; ++i) {
    const double z = start_of(q, i).z;
    const double strain = column.log_stretch(z);
    q.z[i] = z + column.displacement(z);
    q.void_ratio[i] = std::expm1(strain);
    q.stress[1][i] = 4.0 / 3.0 * material.shear() * strain;
    q.stress[0][i] = q.stress[2][i] = -0.5 * q.stress[1][i];
  }
}

}  // namespace

ColumnErrors self_weight_column(int cells, double strain, ColumnStart start, const Numerics& numerics) {
  const ElasticConstants material;
  const double modulus = material.wave_modulus();
  const double speed = material.wave_speed();
  const double cell = 1.0 / cells;
  const Column column{strain};

  mpm::EngineSettings settings;
  settings.symmetry = mpm::Symmetry::plane;
  settings.gravity = strain * modulus / material.density;
  settings.courant = numerics.courant;
  settings.residual_time = numerics.residual_time;
  const mpm::Sides sides{mpm::Side::symmetric, mpm::Side::symmetric, mpm::Side::fixed, mpm::Side::open};
  mpm::Engine engine(mpm::Grid(cell, 2.0 * cell, 1.0 + 3.0 * cell, sides), settings);
  mpm::Body body = elastic_box(2.0 * cell, 1.0, cell, settings.symmetry, material, numerics);
  if (start == ColumnStart::in_equilibrium) put_in_equilibrium(body.particles, column, material);
  // the first mode, of wave number pi/2, is damped nearly critically; with eta as large as that the number of
  // steps to rest does not depend on it
  body.viscosity = 0.9 * material.density * speed;
  const double decay =
      4.0 / 3.0 * body.viscosity * std::pow(0.5 * std::numbers::pi, 2) / (2.0 * material.density);
  const double duration = 8.0 * std::numbers::ln10 / decay;
  engine.add(std::move(body));
  while (engine.time() < duration) {
    if (const auto failure = engine.step(duration)) throw std::runtime_error(failure->message);
  }

  ColumnErrors errors;
  const mpm::Particles& q = engine.bodies().front().particles;
  std::map<long, Pair> in_cells;  // mean error of stress; number of points
  const double largest = std::abs(column.displacement(1.0));
  const auto cell_of = [cell](double z) { return static_cast<long>(z / cell); };
  for (std::size_t i = 0; i < q.count; ++i) {
    const double z = start_of(q, i).z;
    const double deviator = q.stress[1][i];
    const double own = deviator + material.bulk() * std::log1p(q.void_ratio[i]);
    const double acting = deviator - engine.total_pressure(0, i);
    const double exact = modulus * column.log_stretch(z);
    errors.stress += std::pow((own - exact) / (strain * modulus), 2);
    errors.acting_stress += std::pow((acting - exact) / (strain * modulus), 2);
    errors.displacement += std::pow((q.z[i] - z - column.displacement(z)) / largest, 2);
    errors.velocity += std::pow(q.velocity_z[i] * speed / settings.gravity, 2);
    errors.crossed += cell_of(q.z[i]) != cell_of(z) ? 1.0 : 0.0;
    Pair& mean = in_cells[cell_of(q.z[i])];
    mean.r += (acting - exact) / (strain * modulus);
    mean.z += 1.0;
  }
  for (const auto& [index, mean] : in_cells) errors.cell_stress += std::pow(mean.r / mean.z, 2);
  const auto count = static_cast<double>(q.count);
  errors.cell_stress = std::sqrt(errors.cell_stress / static_cast<double>(in_cells.size()));
  for (double* sum : {&errors.stress, &errors.acting_stress, &errors.displacement, &errors.velocity}) {
    *sum = std::sqrt(*sum / count);
  }
  errors.crossed /= count;
  return errors;
}

Section self_weight_column_section() {
  Section section;
  section.title = "Column under its own weight";
  section.text =
      R"(A column of H = 1 m, confined across, on a rough base: the nominal axial stress is -rho0 g (H - Z), which
here is Cauchy's too, and the stretch exp(-rho0 g (H - Z)/M) since the material is linear in the logarithmic strain. It
settles, or is put in equilibrium, with a constant viscosity of 0.9 rho c H until velocities have fallen to 1e-8. Errors
are roots of mean squares over points, of stress over rho g H, of displacement over the largest.

First table, strains of 1e-6. Displacements are of second order. The stress of a single point is of first order when the
column has settled: the rate that a point sees, (4/h^2) sum N d v, is exact for linear fields only, and the third moment of
the spline at the points, +-3/64 h^3, makes strains of +-6/64 h u'' that alternate from point to point. Nodes are blind to
them, so neither motion nor force loses an order, and the mean of a cell's points is free of them. Put in equilibrium, the
column never gets them. What remains then is an error of first order in the cells next to base and surface: 3/2 in the
mean square.

Second table, rho g H = 0.2 M: the points have moved through the grid, by up to a tenth of the height, and are packed
more closely below. The spline's moments over points that no longer lie regularly are off by a part that depends on the
strain but not on the cell size: the stress error stays, at 0.2 to 0.3 % of the stress at the base, and displacements
fall to the first order. More points a cell push that floor down.)";
  Convergence small({"start", "numerics"},
                    {"stress of points", "that acts", "mean of cells", "displacement"});
  Convergence large({"start", "numerics"},
                    {"stress of points", "that acts", "mean of cells", "displacement"});
  // the number of steps to rest grows with the square of the number of cells
  const auto sweep = [](Convergence& table, double strain, ColumnStart start, const Numerics& numerics,
                        int finest) {
    for (int cells = 8; cells <= finest; cells *= 2) {
      const ColumnErrors e = self_weight_column(cells, strain, start, numerics);
      table.add({start == ColumnStart::unstrained ? "settles" : "in equilibrium", named(numerics)}, cells,
                {e.stress, e.acting_stress, e.cell_stress, e.displacement});
    }
  };
  for (const ColumnStart start : {ColumnStart::unstrained, ColumnStart::in_equilibrium}) {
    for (const bool averaged : {false, true}) sweep(small, 1e-6, start, {.averaged = averaged}, 32);
  }
  for (const bool averaged : {false, true}) {
    sweep(large, 0.2, ColumnStart::unstrained, {.averaged = averaged}, 64);
  }
  sweep(large, 0.2, ColumnStart::unstrained, {.points = 4}, 32);
  section.tables = {small.table(), large.table()};
  return section;
}

}  // namespace isotach::bench
