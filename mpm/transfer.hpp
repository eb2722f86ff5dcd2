// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Points to nodes and back, and averages over cells: the passes over all points of a step.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mpm/grid.hpp"
#include "mpm/material.hpp"
#include "mpm/point_force.hpp"

namespace isotach::mpm {

enum class Symmetry {
  axisymmetric,  ///< r, z; mass and volume per radian
  plane          ///< plane strain: r, z are x, y; mass and volume per metre
};

/// Averages over the four cells around each corner, of one body's points, weighted by volume and bilinearly.
struct CornerField {
  CornerField(std::size_t stride, std::size_t rows)
      : pressures(stride, rows), rates(stride, rows), mean(stride * rows) {}

  RowSums<CornerSum> pressures;  ///< volume, and volume times total pressure
  RowSums<double> rates;         ///< volume times tr D
  ZeroedArray<double> mean;      ///< of pressure (Pa) or tr D (1/s), whichever was averaged last

  /// In the rows first .. last - 1.
  void average_pressure(std::size_t first, std::size_t last);
  void average_rate(std::size_t first, std::size_t last);
  /// What a step leaves to the next.
  template <class Archive>
  void visit(Archive& archive) {
    archive(pressures);
    pressures.visit_used(archive, mean.data());
  }
};

/// What a body's points give to the nodes besides their state.
struct PushSettings {
  double time = 0.0;             ///< s
  double dt = 0.0;               ///< s
  double gravity = 0.0;          ///< m/s2, downwards
  double two_eta = 0.0;          ///< twice the viscosity beside the material (Pa s)
  double velocity_scale = 1.0;   ///< of the points' velocities and their gradients
  const double* mean = nullptr;  ///< averaged pressure at corners; none where the body is not averaged
  const Material* material = nullptr;
  const std::vector<std::unique_ptr<PointForce>>* forces = nullptr;
};

/// Points `begin` .. `end` - 1 (begin a multiple of kBlock) give mass, momentum with its affine part, and
/// forces to the nodes in `sums`.
template <Symmetry S>
void push_to_nodes(const Particles& particles, std::size_t begin, std::size_t end, const Grid& grid,
                   const PushSettings& settings, NodeSums& sums);

struct PullSettings {
  double dt = 0.0;
  double velocity_scale = 1.0;  ///< as the points' velocities were pushed
  /// Part of what the grid cannot hold of a point's velocity and its gradient that the point keeps in the
  /// step.
  double keep_velocity = 0.0;
  double keep_gradient = 0.0;
};

struct PullResult {
  double fastest = 0.0;                ///< m/s
  std::optional<std::size_t> leaving;  ///< the first point that would leave the grid or is not finite
};

/// Points take velocity, its change and its gradient from the nodes; their volumes times tr D are added to
/// `rates`, where there is one. They do not move yet.
template <Symmetry S>
PullResult pull_from_nodes(Particles& particles, std::size_t begin, std::size_t end, const Grid& grid,
                           const PullSettings& settings, RowSums<double>* rates);

struct TimeStep {
  double start;  ///< s
  double dt;     ///< s
};

/// Stress and volume advance under the averaged strain rate (`mean_rate` at corners, or that of the point
/// where it is null), the points move, and their volume and pressure are added to `pressures`, where there is
/// one.
template <Symmetry S>
void update_points(Particles& particles, std::size_t begin, std::size_t end, const Grid& grid,
                   const TimeStep& step, const double* mean_rate, const Material& material,
                   RowSums<CornerSum>* pressures, MaterialCount& count);

/// Adds volume and total pressure of points as they are to `pressures`.
void push_pressure(const Particles& particles, std::size_t begin, std::size_t end, const Grid& grid,
                   const Material& material, RowSums<CornerSum>& pressures);

/// Value at the place of a point of a field given at corners.
[[nodiscard]] double at_point(const Grid& grid, const double* mean, double r, double z);

}  // namespace isotach::mpm
