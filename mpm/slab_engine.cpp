// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/slab_engine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/materials/viscoplastic.hpp"

namespace isotach::mpm {

namespace {

// kg/m3, stone's or glass's. At rest it has no say; ten times as much moves the toe of a fast slump by 0.2
// mm.
constexpr double kDensity = 2500.0;
constexpr std::size_t kPointsAcrossCell = 2;
// Viscosity, of the impedance times a cell: as large as the linear bulk viscosity that explicit codes use
// against ringing. A mode of the size of a cell loses half of its amplitude a period; steps stay as they are.
constexpr double kDamping = 0.1;

std::size_t cells_on(double length, double cell_size) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length / cell_size)));
}

}  // namespace

std::unique_ptr<Engine> slab_engine(const ElasticSlab& slab, double cell_size, const SlabLoad& load,
                                    const EngineSettings& settings) {
  const std::size_t rows = cells_on(slab.thickness, cell_size);
  const double height = static_cast<double>(rows) * cell_size;
  const double spacing = cell_size / static_cast<double>(kPointsAcrossCell);
  const std::size_t columns = cells_on(slab.length, spacing);
  const double stretch = height / slab.thickness;
  const double young = slab.youngs_modulus * stretch;

  Body body;
  body.density = kDensity / stretch;
  body.averaged = false;  // compressible: there is nothing to lock
  body.material = std::make_unique<ViscoplasticMaterial>(ViscoplasticMaterial::Constants{
      young / (3.0 * (1.0 - 2.0 * slab.poissons_ratio)), young / (2.0 * (1.0 + slab.poissons_ratio))});
  body.viscosity = kDamping * std::sqrt(body.density * slab.confined_modulus() * stretch) * cell_size;
  Particles& q = body.particles;
  for (std::size_t j = 0; j < kPointsAcrossCell * rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const double r = (static_cast<double>(i) + 0.5) * spacing;
      const double volume = spacing * spacing * (settings.symmetry == Symmetry::axisymmetric ? r : 1.0);
      const double vertical = r < load.radius ? -load.pressure : 0.0;
      q.r.push_back(r);
      q.z.push_back((static_cast<double>(j) + 0.5) * spacing);
      q.mass.push_back(body.density * volume);
      q.solid_volume.push_back(volume);
      q.reference_pressure.push_back(-vertical / 3.0);
      q.stress[0].push_back(-vertical / 3.0);
      q.stress[1].push_back(vertical * 2.0 / 3.0);
      q.stress[2].push_back(-vertical / 3.0);
    }
  }
  q.count = q.r.size();

  EngineSettings own = settings;
  own.gravity = 0.0;
  const double width = static_cast<double>(columns) * spacing + 2.0 * cell_size;  // the edge is free
  auto engine = std::make_unique<Engine>(
      Grid(cell_size, width, height, {Side::symmetric, Side::open, Side::fixed, Side::open}), own);
  engine->add(std::move(body));
  return engine;
}

}  // namespace isotach::mpm
