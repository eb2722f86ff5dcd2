// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/slump_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mpm/gravity.hpp"
#include "mpm/layering.hpp"
#include "mpm/materials/mud_with_effects.hpp"
#include "mpm/mould_contact.hpp"
#include "mpm/resting_pressure.hpp"
#include "mpm/slab_engine.hpp"
#include "mpm/surface_tension.hpp"

namespace isotach::mpm {

namespace {

constexpr double kDomainRadii = 6.0;          // width of the grid in mould radii
constexpr double kDomainHeights = 1.25;       // height of the grid in fill heights
constexpr double kLeastPressureShare = 1e-3;  // of the initial p': below it the skeleton has lost contact
// Residuals fade while a body that falls with the mud crosses so many cells: longer, and what fine cells
// leave over feeds on itself; shorter, and coarse cells lose energy.
constexpr double kResidualCells = 60.0;
constexpr double kWallStiffness = 0.5;  // of K_w/n per cell size
constexpr double kWallDamping = 0.5;    // of the mixture's impedance rho c
// Of the cell size, as the stiffness goes with its inverse: several times as deep as a fill presses, and no
// deeper than the centres of the smallest points may come.
constexpr double kWallFirmDepth = 0.0625;

double divided_cell_size(const SlumpSetup& setup) {
  const double radius = 0.5 * setup.mould.diameter;
  return radius / std::max(1.0, std::round(radius / setup.numerics.cell_size));
}

Grid grid_of(const SlumpSetup& setup) {
  return {divided_cell_size(setup),
          kDomainRadii * 0.5 * setup.mould.diameter,
          kDomainHeights * setup.mould.fill_height,
          {Side::symmetric, Side::open, setup.base.slab ? Side::open : Side::fixed, Side::open}};
}

double potential_energy(const SlumpSetup& setup, double density) {
  const double radius = 0.5 * setup.mould.diameter;
  const double height = setup.mould.fill_height;
  return density * kGravity * 0.5 * radius * radius * 0.5 * height * height;
}

EngineSettings settings_of(const SlumpSetup& setup, double density) {
  EngineSettings settings;
  settings.gravity = kGravity;
  settings.courant = setup.numerics.courant;
  settings.inertia_scaling = setup.numerics.inertia_scaling;
  settings.energy_scale = potential_energy(setup, density);
  const bool plain = setup.numerics.scheme == Scheme::plain;
  settings.closes_base_gap = !plain;
  settings.residual_time =
      plain ? 0.0 : kResidualCells * divided_cell_size(setup) / std::sqrt(kGravity * setup.mould.fill_height);
  settings.threads = setup.numerics.threads;
  return settings;
}

Layering layering_of(const SlumpSetup& setup, const InitialState& initial) {
  return {initial.void_ratio, setup.effects.void_ratio_gradient, setup.mould.fill_height,
          setup.mud.specific_gravity};
}

/// What ln p_B wanders by before anything moves, at a height over the fill's.
double strength_at_start(const Wander& wander, double height) {
  if (!wander.changes_strength()) return 0.0;
  return wander.slot == WanderSlot::strength_in_height ? wander(height) : wander.change.front();
}

/// Points of the filled mould, at rest, undrained.
Particles fill_mould(const SlumpSetup& setup, const InitialState& initial, const VhpMaterial& mud,
                     double cell_size, double width, double height) {
  Particles q;
  const double radius = 0.5 * setup.mould.diameter;
  const auto columns = static_cast<std::size_t>(std::lround(radius / width));
  const auto rows = static_cast<std::size_t>(std::lround(setup.mould.fill_height / height));
  q.count = columns * rows;
  const std::size_t room = Particles::padded(q.count, kBlock);
  for (PointArray* array : {&q.r, &q.z, &q.mass, &q.solid_volume, &q.reference_pressure, &q.void_ratio,
                            &q.stress[0], &q.stress[1], &q.stress[2]}) {
    array->reserve(room);
  }
  std::vector<double> heights(rows);
  for (std::size_t row = 0; row < rows; ++row) heights[row] = (static_cast<double>(row) + 0.5) * height;
  const Layering layering = layering_of(setup, initial);
  const std::vector<double> total =
      resting_pressures(heights, cell_size, [&](double z) { return layering.overburden(z); });
  for (std::size_t row = 0; row < rows; ++row) {
    const double void_ratio = layering.void_ratio(heights[row]);
    const double density = layering.density(heights[row]);
    const double change = strength_at_start(setup.wander, heights[row] / setup.mould.fill_height);
    const double pressure = (1.0 + setup.effects.thixotropy.gain) * std::exp(change) *
                            mud.law().preconsolidation_pressure(void_ratio) /
                            setup.mud.overconsolidation_ratio;
    for (std::size_t column = 0; column < columns; ++column) {
      const double r = (static_cast<double>(column) + 0.5) * width;
      const double volume = r * width * height;  // exact: r is linear
      q.r.push_back(r);
      q.z.push_back(heights[row]);
      q.mass.push_back(density * volume);
      q.solid_volume.push_back(volume / (1.0 + void_ratio));
      q.reference_pressure.push_back(mud.reference_pressure(total[row] - pressure, void_ratio));
      q.void_ratio.push_back(void_ratio);
      for (std::size_t k = 0; k < 3; ++k) q.stress[k].push_back(-pressure);
      if (setup.wander.slot == WanderSlot::strength_in_height) q.log_strength.push_back(change);
    }
  }
  if (mud.law().parameters().rotates()) {
    for (auto& component : q.omega) component.assign(q.count, 0.0);
  }
  if (setup.effects.thixotropy.acts()) q.structure.assign(q.count, 1.0);
  if (setup.effects.resistance.acts()) {
    for (auto& component : q.resistance) component.assign(q.count, 0.0);
  }
  if (setup.effects.surface_tension > 0.0) {
    for (auto& component : q.capillary) component.assign(q.count, 0.0);
  }
  return q;
}

}  // namespace

SlumpRun::SlumpRun(const model::Parameters<double>& parameters, const SlumpSetup& setup)
    : setup_(setup),
      initial_(initial_state(parameters, setup.mud)),
      engine_(grid_of(setup), settings_of(setup, initial_.density)) {
  const double h = engine_.grid().cell_size();
  const double width = h / std::sqrt(setup.numerics.points_per_cell);
  const double height = setup.mould.fill_height / std::round(setup.mould.fill_height / width);
  const VhpMaterial::Settings settings{setup.numerics.tolerance,
                                       kLeastPressureShare * initial_.mean_effective_pressure,
                                       setup.numerics.water_bulk_modulus};
  std::unique_ptr<const Material> material;
  if (setup.effects.change_stress() || setup.wander.changes_strength()) {
    auto mud = std::make_unique<MudWithEffects>(parameters, settings, setup.effects, initial_.void_ratio,
                                                setup.wander);
    mud_ = &mud->vhp();
    material = std::move(mud);
  } else {
    auto mud = std::make_unique<VhpMaterial>(parameters, settings);
    mud_ = mud.get();
    material = std::move(mud);
  }
  const double bulk = setup.numerics.water_bulk_modulus * (1.0 + initial_.void_ratio) / initial_.void_ratio;
  const double impedance = std::sqrt(initial_.density * bulk);
  Body body;
  body.particles = fill_mould(setup, initial_, *mud_, h, width, height);
  body.material = std::move(material);
  const Layering layering = layering_of(setup, initial_);
  body.density = std::min(layering.density(0.0), layering.density(setup.mould.fill_height));
  body.viscosity = setup.numerics.background_viscosity;
  body.flows = true;
  engine_.add(std::move(body));
  const MouldContact::Constants wall{width, kWallStiffness * bulk / h, kWallDamping * impedance,
                                     kWallFirmDepth * h, initial_.density * kGravity};
  engine_.add(std::make_unique<MouldContact>(setup, wall));
  if (setup.effects.surface_tension > 0.0) {
    engine_.add(std::make_unique<SurfaceTension>(setup.effects.surface_tension, engine_.grid()));
  }
  engine_.set_base(setup.base_at(0.0));
  if (setup.base.slab) {
    const SlabLoad fill{fill_pressure(parameters, setup), 0.5 * setup.mould.diameter};
    engine_.rest_on(slab_engine(*setup.base.slab, h, fill, engine_.settings()));
  }
}

namespace {

SlumpFailure::Kind kind_of(EngineFailure::Kind kind) {
  switch (kind) {
    case EngineFailure::Kind::left_grid:
      return SlumpFailure::Kind::left_grid;
    case EngineFailure::Kind::left_floor:
      return SlumpFailure::Kind::left_slab;
    case EngineFailure::Kind::not_finite:
      break;
  }
  return SlumpFailure::Kind::not_finite;
}

}  // namespace

std::optional<SlumpFailure> SlumpRun::step(double until) {
  if (setup_.wander.slot == WanderSlot::base_in_time) engine_.set_base(setup_.base_at(time()));
  auto failure = engine_.step(until);
  if (!failure) return std::nullopt;
  return SlumpFailure{kind_of(failure->kind), failure->time, failure->r, failure->z,
                      std::move(failure->message)};
}

HistoryRow SlumpRun::history_row() const {
  const Outline now = outline();
  const Energies energies = engine_.energies();
  constexpr double turn = 2.0 * std::numbers::pi;
  HistoryRow row{};
  row.time = time();
  row.height = now.height();
  row.toe = now.toe();
  row.kinetic = turn * energies.kinetic;
  row.potential = turn * energies.potential;
  row.stress_work = turn * energies.stress_work;
  row.boundary_work = turn * energies.boundary_work;
  const Particles& q = particles();
  for (std::size_t i = 0; i < q.count; ++i) row.volume += turn * q.volume(i);
  row.inertia_scaling = engine_.inertia();
  return row;
}

Snapshot SlumpRun::snapshot() const {
  Snapshot s{time(), particles(), {}, {}, {}};
  const Particles& q = particles();
  s.pore_pressure.reserve(q.count);
  s.overconsolidation_ratio.reserve(q.count);
  s.strain_rate_norm.reserve(q.count);
  for (std::size_t i = 0; i < q.count; ++i) {
    const PointFields fields = point_fields(i);
    s.pore_pressure.push_back(fields.pore_pressure);
    s.overconsolidation_ratio.push_back(fields.overconsolidation_ratio);
    s.strain_rate_norm.push_back(fields.strain_rate_norm);
  }
  return s;
}

Frame SlumpRun::frame() const {
  const Particles& q = particles();
  double width = 0.0;
  double height = 0.0;
  for (std::size_t i = 0; i < q.count; ++i) {
    const double half = 0.5 * std::sqrt(q.volume(i) / q.r[i]);  // of a point's square
    width = std::max(width, q.r[i] + half);
    height = std::max(height, q.z[i] + half);
  }
  FieldSums sums(cell_size(), width, height);
  for (std::size_t i = 0; i < q.count; ++i) sums.add(q.r[i], q.z[i], q.volume(i), point_fields(i));
  return {time(), setup_.mould.rim(time()), sums.map(), outline()};
}

PointFields SlumpRun::point_fields(std::size_t i) const {
  const Particles& q = particles();
  const double hoop = q.grid_velocity_r[i] / q.r[i];
  const double shear = 0.5 * (q.l_rz[i] + q.l_zr[i]);
  const double gain = q.structure.empty() ? 1.0 : 1.0 + setup_.effects.thixotropy.gain * q.structure[i];
  return {std::sqrt(q.l_rr[i] * q.l_rr[i] + q.l_zz[i] * q.l_zz[i] + hoop * hoop + 2.0 * shear * shear),
          mud_->law().overconsolidation_ratio(q.state(i)) * gain,
          // the averaged pressure is the one that acts
          engine_.total_pressure(0, i) - q.mean_effective_pressure(i)};
}

}  // namespace isotach::mpm
