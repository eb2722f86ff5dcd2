// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slump simulation in progress: its points, its grid and the explicit time step.
#pragma once

#include <optional>

#include "mpm/grid.hpp"
#include "mpm/mould_contact.hpp"
#include "mpm/slump.hpp"
#include "mpm/stress_update.hpp"

namespace isotach::mpm {

/// Explicit material point method, axisymmetric, one point set, undrained.
///
/// A step: points give mass, momentum with its affine part (as in APIC) and forces to quadratic B-spline
/// nodes; nodes advance; points take the gradient of velocity and its change back and move with the grid; tr
/// D is averaged over cells (bilinear at the corners, weighted by volume); stress and void ratio advance; the
/// total mean pressure p' + u is averaged in the same way before it becomes a force. Averaging rate and force
/// by the same symmetric operator keeps the discrete work exact, and cures volumetric locking and the
/// checkerboard of pore pressure. The pore pressure is a function of void ratio, u = u0 + K_w ln(e0/e), from
/// du/dt = -(K_w/n) tr D, so that volume, void ratio and pressure cannot drift apart.
///
/// Velocities that vary within a cell are damped by an artificial viscosity eta = alpha rho c h (c the wave
/// speed of the mixture), which is a stress like any other and part of the stress work; it vanishes with the
/// cell size.
class SlumpRun {
 public:
  SlumpRun(const model::Parameters<double>& parameters, const SlumpSetup& setup);

  /// One time step, no longer than to `until` (s).
  [[nodiscard]] std::optional<SlumpFailure> step(double until);

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] double cell_size() const { return grid_.cell_size(); }
  [[nodiscard]] const InitialState& initial() const { return initial_; }
  [[nodiscard]] Outline outline() const { return trace_outline(particles_, grid_.cell_size(), time_); }
  [[nodiscard]] HistoryRow history_row() const;
  [[nodiscard]] Snapshot snapshot() const;

  [[nodiscard]] long steps() const { return steps_; }
  [[nodiscard]] long substepped() const { return substepped_; }
  [[nodiscard]] long floored() const { return floored_; }

 private:
  void fill_mould();
  [[nodiscard]] double mean_effective_pressure(std::size_t i) const;
  [[nodiscard]] double pore_pressure(std::size_t i) const;
  void average_pressure();
  [[nodiscard]] double time_step() const;
  void points_to_nodes(double dt);
  void advance_nodes(double dt);
  [[nodiscard]] std::optional<SlumpFailure> nodes_to_points(double dt);
  void average_divergence();
  void adapt_inertia();

  model::Law<double> law_;
  SlumpSetup setup_;
  InitialState initial_;
  Grid grid_;
  double point_width_;
  double point_height_;
  MouldContact mould_;
  double two_eta_;  ///< twice the artificial viscosity (Pa s)
  StressUpdate stress_update_;
  Particles particles_;

  double time_ = 0.0;
  long steps_ = 0;
  long substepped_ = 0;
  long floored_ = 0;
  double inertia_ = 1.0;
  double largest_speed_ = 0.0;
  double largest_r_ = 0.0;
  double largest_z_ = 0.0;
  double internal_work_ = 0.0;  // per radian
  double contact_work_ = 0.0;   // per radian, done on the mud
  double potential_0_ = 0.0;    // per radian
};

}  // namespace isotach::mpm
