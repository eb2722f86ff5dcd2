// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/slump_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "mpm/lanes.hpp"
#include "mpm/spline.hpp"

namespace isotach::mpm {

namespace {

constexpr double kGravity = 9.81;             // m/s2
constexpr double kDomainRadii = 6.0;          // width of the grid in mould radii
constexpr double kDomainHeights = 1.25;       // height of the grid in fill heights
constexpr double kLeastPressureShare = 1e-3;  // of the initial p': below it the skeleton has lost contact
constexpr double kWallStiffness = 0.5;        // of K_w/n per cell size
constexpr double kResidualTime = 0.15;        // s, in which a point's velocity relaxes to the grid's
constexpr double kWallDamping = 0.5;          // of the mixture's impedance rho c
constexpr double kLeastNodeMass = 1e-30;      // kg/rad
constexpr double kQuasiStaticEnergy = 1e-4;   // scaled kinetic over initial potential energy allowed
constexpr double kInertiaGrowth = 1.002;      // largest growth of the inertia factor in a step

double divided_cell_size(const SlumpSetup& setup) {
  const double radius = 0.5 * setup.mould.diameter;
  return radius / std::max(1.0, std::round(radius / setup.numerics.cell_size));
}

double bulk_over_porosity(const SlumpSetup& setup, double void_ratio) {
  return setup.numerics.water_bulk_modulus * (1.0 + void_ratio) / void_ratio;
}

/// Corners of the cell around a point and its bilinear weights.
struct CornerWeights {
  std::size_t base;
  double w00, w10, w01, w11;
};

CornerWeights corner_weights(const Grid& grid, double r, double z) {
  const double x = r / grid.cell_size();
  const double y = z / grid.cell_size();
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const double a = x - i;
  const double b = y - j;
  return {grid.index(i, j), (1.0 - a) * (1.0 - b), a * (1.0 - b), (1.0 - a) * b, a * b};
}

void scatter(double* values, const CornerWeights& w, std::size_t stride, double amount) {
  double* v = values + w.base;
  v[0] += w.w00 * amount;
  v[1] += w.w10 * amount;
  v[stride] += w.w01 * amount;
  v[stride + 1] += w.w11 * amount;
}

double gather(const double* values, const CornerWeights& w, std::size_t stride) {
  const double* v = values + w.base;
  return w.w00 * v[0] + w.w10 * v[1] + w.w01 * v[stride] + w.w11 * v[stride + 1];
}

void divide_by_volume(Grid& grid) {
  double* values = grid.corner_values();
  const double* volumes = grid.corner_volumes();
  for (int j = 0; j < grid.used_rows(); ++j) {
    for (int i = 0; i < grid.used_columns(); ++i) {
      const std::size_t n = grid.index(i, j);
      if (volumes[n] > 0.0) values[n] /= volumes[n];
    }
  }
}

}  // namespace

SlumpRun::SlumpRun(const model::Parameters<double>& parameters, const SlumpSetup& setup)
    : law_(parameters),
      setup_(setup),
      initial_(initial_state(parameters, setup.mud)),
      grid_(divided_cell_size(setup), kDomainRadii * 0.5 * setup.mould.diameter,
            kDomainHeights * setup.mould.fill_height),
      point_width_(grid_.cell_size() / std::sqrt(setup.numerics.points_per_cell)),
      point_height_(setup.mould.fill_height / std::round(setup.mould.fill_height / point_width_)),
      mould_(setup.mould, point_width_,
             kWallStiffness * bulk_over_porosity(setup, initial_.void_ratio) / grid_.cell_size(),
             kWallDamping * std::sqrt(initial_.density * bulk_over_porosity(setup, initial_.void_ratio))),
      two_eta_(2.0 * setup.numerics.artificial_viscosity * grid_.cell_size() *
               std::sqrt(initial_.density * bulk_over_porosity(setup, initial_.void_ratio))),
      stress_update_(parameters, setup.numerics.tolerance,
                     kLeastPressureShare * initial_.mean_effective_pressure) {
  fill_mould();
}

void SlumpRun::fill_mould() {
  const double radius = 0.5 * setup_.mould.diameter;
  const auto columns = static_cast<std::size_t>(std::lround(radius / point_width_));
  const auto rows = static_cast<std::size_t>(std::lround(setup_.mould.fill_height / point_height_));
  particles_.count = columns * rows;
  const std::size_t padded = Particles::padded(particles_.count, Lanes::kCount);
  particles_.for_each_array([padded](std::vector<double>& array) { array.assign(padded, 0.0); });
  for (std::size_t k = 0; k < 3; ++k) particles_.stress[k].assign(padded, -initial_.mean_effective_pressure);
  particles_.void_ratio.assign(padded, initial_.void_ratio);
  if (law_.parameters().rotates()) {
    for (auto& component : particles_.omega) component.assign(padded, 0.0);
  }

  std::size_t i = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column, ++i) {
      const double r = (static_cast<double>(column) + 0.5) * point_width_;
      const double z = (static_cast<double>(row) + 0.5) * point_height_;
      const double volume = r * point_width_ * point_height_;  // exact: r is linear
      particles_.r[i] = r;
      particles_.z[i] = z;
      particles_.mass[i] = initial_.density * volume;
      particles_.solid_volume[i] = volume / (1.0 + initial_.void_ratio);
      const double total = initial_.density * kGravity * (setup_.mould.fill_height - z);
      particles_.initial_pore_pressure[i] = total - initial_.mean_effective_pressure;
      particles_.total_pressure[i] = total;
      potential_0_ += particles_.mass[i] * kGravity * z;
    }
  }
  largest_r_ = radius;
  largest_z_ = setup_.mould.fill_height;
  grid_.set_used(grid_.columns(), grid_.rows());
  grid_.clear_corner_volumes();
  for (i = 0; i < particles_.count; ++i) {
    const CornerWeights w = corner_weights(grid_, particles_.r[i], particles_.z[i]);
    scatter(grid_.corner_volumes(), w, static_cast<std::size_t>(grid_.columns()), particles_.volume(i));
  }
  average_pressure();
}

double SlumpRun::mean_effective_pressure(std::size_t i) const {
  return -(particles_.stress[0][i] + particles_.stress[1][i] + particles_.stress[2][i]) / 3.0;
}

double SlumpRun::pore_pressure(std::size_t i) const {
  return particles_.initial_pore_pressure[i] +
         setup_.numerics.water_bulk_modulus * std::log(initial_.void_ratio / particles_.void_ratio[i]);
}

// Explicit limit: the wave of mixture and skeleton must not cross a cell in a step.
double SlumpRun::time_step() const {
  double stiffest = 0.0;
  for (std::size_t i = 0; i < particles_.count; ++i) {
    stiffest = std::max(stiffest, mean_effective_pressure(i));
  }
  // along That the skeleton is stiffest: f_b (F^2 + a^2 |That|^2), F <= 1, |That| <= 1
  const double a2 = law_.a_squared();
  const double skeleton = 3.0 * stiffest * (1.0 + a2) / ((1.0 + a2 / 3.0) * law_.parameters().kappa());
  const double modulus = bulk_over_porosity(setup_, initial_.void_ratio) + skeleton;
  const double wave_speed = std::sqrt(modulus / (initial_.density * inertia_));
  return setup_.numerics.courant * grid_.cell_size() / (wave_speed + largest_speed_);
}

void SlumpRun::points_to_nodes(double dt) {
  const double h = grid_.cell_size();
  const double inverse_h = 1.0 / h;
  grid_.set_used(static_cast<int>(largest_r_ * inverse_h) + 3, static_cast<int>(largest_z_ * inverse_h) + 3);
  grid_.clear_nodes();
  const double rim = mould_.rim(time_);
  const auto stride = static_cast<std::size_t>(grid_.columns());
  const double gradient = 4.0 * inverse_h * inverse_h;  // inverse of the spline's second moment
  Octet* nodes = grid_.nodes();

  for (std::size_t i = 0; i < particles_.count; ++i) {
    const double r = particles_.r[i];
    const double z = particles_.z[i];
    const double m = particles_.mass[i];
    const double volume = particles_.volume(i);
    const double s_rr = particles_.stress[0][i];
    const double s_zz = particles_.stress[1][i];
    const double s_tt = particles_.stress[2][i];
    const double mean = (s_rr + s_zz + s_tt) / 3.0;
    const double d_rr = particles_.strain_rate[0][i];
    const double d_zz = particles_.strain_rate[1][i];
    const double d_tt = particles_.strain_rate[2][i];
    const double mean_rate = (d_rr + d_zz + d_tt) / 3.0;
    const double pressure = gather(grid_.corner_values(), corner_weights(grid_, r, z), stride);
    // total stress: deviator of the skeleton, averaged mean pressure, artificial viscosity
    const double t_rr = s_rr - mean - pressure + two_eta_ * (d_rr - mean_rate);
    const double t_zz = s_zz - mean - pressure + two_eta_ * (d_zz - mean_rate);
    const double t_tt = s_tt - mean - pressure + two_eta_ * (d_tt - mean_rate);
    const double t_rz =
        (particles_.stress[3][i] + two_eta_ * particles_.strain_rate[3][i]) * (1.0 / std::numbers::sqrt2);
    const WallForce wall =
        mould_.force(r, z, particles_.velocity_r[i], particles_.velocity_z[i], m, -t_rr,
                     particles_.initial_pore_pressure[i] + initial_.mean_effective_pressure, rim, dt);

    const SplineWeights wr = spline_weights(r * inverse_h + 0.5);
    const SplineWeights wz = spline_weights(z * inverse_h + 0.5);
    const double k = -volume * gradient * h;
    const Octet constant{m,
                         m * particles_.velocity_r[i],
                         m * particles_.velocity_z[i],
                         -volume * t_tt / r,
                         0.0,
                         wall.r,
                         wall.z,
                         -m * kGravity};
    const Octet slope_r{
        0.0, m * h * particles_.c_rr[i], m * h * particles_.c_zr[i], k * t_rr, k * t_rz, 0.0, 0.0, 0.0};
    const Octet slope_z{
        0.0, m * h * particles_.c_rz[i], m * h * particles_.c_zz[i], k * t_rz, k * t_zz, 0.0, 0.0, 0.0};
    for (int b = 0; b < 3; ++b) {
      const auto bz = static_cast<std::size_t>(b);
      const Octet line = constant + slope_z * wz.offset[bz];
      Octet* row = nodes + grid_.index(wr.base, wz.base + b);
      for (std::size_t a = 0; a < 3; ++a) {
        row[a] += (line + slope_r * wr.offset[a]) * (wr.weight[a] * wz.weight[bz]);
      }
    }
  }
  grid_.fold_mirrors();
}

void SlumpRun::advance_nodes(double dt) {
  const Octet* nodes = grid_.nodes();
  NodeVelocity* velocities = grid_.velocities();
  const double inverse_inertia = 1.0 / inertia_;
  for (int j = 1; j < grid_.used_rows(); ++j) {
    for (int i = 1; i < grid_.used_columns(); ++i) {
      const std::size_t n = grid_.index(i, j);
      const Octet& node = nodes[n];
      if (node[kMass] <= kLeastNodeMass) {
        velocities[n] = NodeVelocity{};
        continue;
      }
      const double inverse_mass = 1.0 / node[kMass];
      const double before_r = node[kMomentumR] * inverse_mass;
      const double before_z = node[kMomentumZ] * inverse_mass;
      const double impulse = dt * inverse_mass * inverse_inertia;
      const double change_r = (node[kInternalR] + node[kContactR]) * impulse;
      const double change_z = (node[kInternalZ] + node[kContactZ] + node[kGravityZ]) * impulse;
      const double path_r = (before_r + 0.5 * change_r) * dt;
      const double path_z = (before_z + 0.5 * change_z) * dt;
      internal_work_ += node[kInternalR] * path_r + node[kInternalZ] * path_z;
      contact_work_ += node[kContactR] * path_r + node[kContactZ] * path_z;
      velocities[n] = NodeVelocity{before_r + change_r, before_z + change_z, change_r, change_z};
    }
  }
  grid_.mirror_velocities();
}

std::optional<SlumpFailure> SlumpRun::nodes_to_points(double dt) {
  const double h = grid_.cell_size();
  const double inverse_h = 1.0 / h;
  const double gradient = 4.0 * inverse_h;
  const auto stride = static_cast<std::size_t>(grid_.columns());
  const NodeVelocity* velocities = grid_.velocities();
  // The part of a point's velocity that the grid cannot hold is kept, and fades in a time that does not
  // depend on the number of steps; plain APIC drops it every step, which acts as a viscosity of order h^2/dt.
  const double keep = std::max(0.0, 1.0 - dt / (kResidualTime * std::sqrt(inertia_)));
  grid_.clear_corner_values();
  grid_.clear_corner_volumes();
  double* corner_values = grid_.corner_values();
  double* corner_volumes = grid_.corner_volumes();
  double fastest2 = 0.0;
  double r_max = 0.0;
  double z_max = 0.0;

  for (std::size_t i = 0; i < particles_.count; ++i) {
    const double r = particles_.r[i];
    const double z = particles_.z[i];
    const SplineWeights wr = spline_weights(r * inverse_h + 0.5);
    const SplineWeights wz = spline_weights(z * inverse_h + 0.5);
    NodeVelocity v{};
    NodeVelocity dv_dr{};
    NodeVelocity dv_dz{};
    for (int b = 0; b < 3; ++b) {
      const auto bz = static_cast<std::size_t>(b);
      const NodeVelocity* row = velocities + grid_.index(wr.base, wz.base + b);
      NodeVelocity line{};
      NodeVelocity line_dr{};
      for (std::size_t a = 0; a < 3; ++a) {
        const NodeVelocity weighted = row[a] * wr.weight[a];
        line += weighted;
        line_dr += weighted * wr.offset[a];
      }
      v += line * wz.weight[bz];
      dv_dr += line_dr * wz.weight[bz];
      dv_dz += line * (wz.weight[bz] * wz.offset[bz]);
    }
    dv_dr *= gradient;
    dv_dz *= gradient;
    particles_.velocity_r[i] = v[0] + keep * (particles_.velocity_r[i] + v[2] - v[0]);
    particles_.velocity_z[i] = v[1] + keep * (particles_.velocity_z[i] + v[3] - v[1]);
    particles_.path_velocity_r[i] = v[0];
    particles_.path_velocity_z[i] = v[1];
    particles_.c_rr[i] = dv_dr[0];
    particles_.c_zr[i] = dv_dr[1];
    particles_.c_rz[i] = dv_dz[0];
    particles_.c_zz[i] = dv_dz[1];
    const double hoop = v[0] / r;
    const double divergence = dv_dr[0] + dv_dz[1] + hoop;
    particles_.strain_rate[0][i] = dv_dr[0];
    particles_.strain_rate[1][i] = dv_dz[1];
    particles_.strain_rate[2][i] = hoop;
    particles_.strain_rate[3][i] = (dv_dz[0] + dv_dr[1]) * (1.0 / std::numbers::sqrt2);
    particles_.spin[i] = 0.5 * (dv_dz[0] - dv_dr[1]);
    particles_.divergence[i] = divergence;

    const CornerWeights w = corner_weights(grid_, r, z);
    const double volume = particles_.volume(i);
    scatter(corner_values, w, stride, volume * divergence);
    scatter(corner_volumes, w, stride, volume);

    const double r_new = r + dt * v[0];
    const double z_new = z + dt * v[1];
    if (!(r_new > 0.0 && r_new < grid_.largest_r() && z_new > 0.0 && z_new < grid_.largest_z())) {
      const bool finite = std::isfinite(r_new) && std::isfinite(z_new);
      return SlumpFailure{
          finite ? SlumpFailure::Kind::left_grid : SlumpFailure::Kind::not_finite, time_, r, z,
          fmt::format("{} at t = {:.6g} s, r = {:.3f} mm, z = {:.3f} mm (step {})",
                      finite ? "a material point leaves the grid" : "a velocity is not finite", time_,
                      r * 1e3, z * 1e3, steps_)};
    }
    fastest2 = std::max(fastest2, v[0] * v[0] + v[1] * v[1]);
    r_max = std::max(r_max, r_new);
    z_max = std::max(z_max, z_new);
  }
  largest_speed_ = std::sqrt(fastest2);
  largest_r_ = std::max(r_max, largest_r_);
  largest_z_ = std::max(z_max, largest_z_);
  return std::nullopt;
}

void SlumpRun::average_divergence() {
  const auto stride = static_cast<std::size_t>(grid_.columns());
  divide_by_volume(grid_);
  for (std::size_t i = 0; i < particles_.count; ++i) {
    const CornerWeights w = corner_weights(grid_, particles_.r[i], particles_.z[i]);
    const double change = (gather(grid_.corner_values(), w, stride) - particles_.divergence[i]) / 3.0;
    particles_.strain_rate[0][i] += change;
    particles_.strain_rate[1][i] += change;
    particles_.strain_rate[2][i] += change;
  }
}

// p' + u of the points, averaged to the corners with the volumes that averaged the divergence.
void SlumpRun::average_pressure() {
  const auto stride = static_cast<std::size_t>(grid_.columns());
  grid_.clear_corner_values();
  for (std::size_t i = 0; i < particles_.count; ++i) {
    const CornerWeights w = corner_weights(grid_, particles_.r[i], particles_.z[i]);
    scatter(grid_.corner_values(), w, stride, particles_.volume(i) * particles_.total_pressure[i]);
  }
  divide_by_volume(grid_);
}

std::optional<SlumpFailure> SlumpRun::step(double until) {
  const double dt = std::min(time_step(), until - time_);
  points_to_nodes(dt);
  advance_nodes(dt);
  if (auto failure = nodes_to_points(dt)) return failure;
  average_divergence();
  const StressUpdateCount count = stress_update_.update(particles_, dt);
  substepped_ += count.substepped;
  floored_ += count.floored;
  for (std::size_t i = 0; i < particles_.count; ++i) {
    particles_.total_pressure[i] = mean_effective_pressure(i) + pore_pressure(i);
  }
  average_pressure();
  for (std::size_t i = 0; i < particles_.count; ++i) {
    particles_.r[i] += dt * particles_.path_velocity_r[i];
    particles_.z[i] += dt * particles_.path_velocity_z[i];
  }
  ++steps_;
  time_ = dt < until - time_ ? time_ + dt : until;
  if (setup_.numerics.inertia_scaling > 1.0) adapt_inertia();
  return std::nullopt;
}

// Larger inertia permits longer steps. It may grow while the kinetic energy it makes stays far below the
// energy that drives the flow, so that inertia keeps having no say in the motion.
void SlumpRun::adapt_inertia() {
  double unscaled = 0.0;
  for (std::size_t i = 0; i < particles_.count; ++i) {
    unscaled += 0.5 * particles_.mass[i] *
                (particles_.velocity_r[i] * particles_.velocity_r[i] +
                 particles_.velocity_z[i] * particles_.velocity_z[i]);
  }
  const double allowed = kQuasiStaticEnergy * potential_0_ / std::max(unscaled, 1e-30);
  const double wanted = std::clamp(allowed, 1.0, setup_.numerics.inertia_scaling);
  const double next = std::min(wanted, inertia_ * kInertiaGrowth);
  if (next > inertia_) {
    // growing inertia must not add kinetic energy: velocities shrink so that it stays
    const double factor = std::sqrt(inertia_ / next);
    for (auto* velocity : {&particles_.velocity_r, &particles_.velocity_z, &particles_.c_rr, &particles_.c_rz,
                           &particles_.c_zr, &particles_.c_zz}) {
      for (double& component : *velocity) component *= factor;
    }
  }
  inertia_ = next;
}

HistoryRow SlumpRun::history_row() const {
  const Outline now = outline();
  HistoryRow row{};
  row.time = time_;
  row.height = now.height();
  row.toe = now.toe();
  constexpr double turn = 2.0 * std::numbers::pi;
  for (std::size_t i = 0; i < particles_.count; ++i) {
    const double speed2 = particles_.velocity_r[i] * particles_.velocity_r[i] +
                          particles_.velocity_z[i] * particles_.velocity_z[i];
    row.kinetic += turn * 0.5 * inertia_ * particles_.mass[i] * speed2;
    row.potential += turn * particles_.mass[i] * kGravity * particles_.z[i];
    row.volume += turn * particles_.volume(i);
  }
  row.stress_work = -turn * internal_work_;
  row.boundary_work = -turn * contact_work_;
  row.inertia_scaling = inertia_;
  return row;
}

Snapshot SlumpRun::snapshot() const {
  Snapshot s{time_, particles_, {}, {}};
  s.pore_pressure.reserve(particles_.count);
  s.overconsolidation_ratio.reserve(particles_.count);
  const auto stride = static_cast<std::size_t>(grid_.columns());
  for (std::size_t i = 0; i < particles_.count; ++i) {
    // the averaged pressure is the one that acts
    const CornerWeights w = corner_weights(grid_, particles_.r[i], particles_.z[i]);
    s.pore_pressure.push_back(gather(grid_.corner_values(), w, stride) - mean_effective_pressure(i));
    s.overconsolidation_ratio.push_back(law_.overconsolidation_ratio(particles_.state(i)));
  }
  return s;
}

}  // namespace isotach::mpm
