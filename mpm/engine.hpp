// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The explicit material point method: bodies on a grid, and the time step.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mpm/base_friction.hpp"
#include "mpm/grid.hpp"
#include "mpm/sliding_base.hpp"
#include "mpm/team.hpp"
#include "mpm/transfer.hpp"

namespace isotach::mpm {

/// Points of one material.
struct Body {
  Particles particles;
  std::unique_ptr<const Material> material;
  double density = 0.0;    ///< kg/m3, the least; sets the wave speed
  double viscosity = 0.0;  ///< eta of a stress 2 eta D* beside the material's (Pa s), >= 0
  bool averaged = true;    ///< tr D and mean stress are averaged over cells
  bool flows = false;      ///< comes down on the base from above, and so must close the gap (base_gap.hpp)
  std::vector<std::unique_ptr<PointForce>> forces;  ///< that act on these points, and on no others
};

struct EngineSettings {
  Symmetry symmetry = Symmetry::axisymmetric;
  double gravity = 9.81;         ///< m/s2, downwards
  double courant = 0.8;          ///< fraction of the critical time step
  double residual_time = 0.15;   ///< s, in which what the grid cannot hold of a point's velocity fades
  bool closes_base_gap = true;   ///< of mud that comes down on a base: base_gap.hpp
  double inertia_scaling = 1.0;  ///< largest factor on inertia while the flow is quasi-static; 1 = none
  double energy_scale = 0.0;     ///< J/rad; kinetic energies far below it are quasi-static
  int threads = 1;
};

/// Why and where a step could not be done.
struct EngineFailure {
  enum class Kind { left_grid, not_finite, left_floor };
  Kind kind;
  double time;  ///< s
  double r;     ///< m
  double z;     ///< m
  std::string message;
};

/// Per radian (or metre).
struct Energies {
  double kinetic = 0.0;        ///< J, with the inertia in use
  double potential = 0.0;      ///< J
  double stress_work = 0.0;    ///< J, done on the bodies by their stress since the start
  double boundary_work = 0.0;  ///< J, done by the bodies on what holds them since the start
};

/// A step: points give mass, momentum with its affine part and forces to quadratic B-spline nodes; nodes
/// advance; points take velocity, its gradient and its change back; tr D is averaged over cells; stress and
/// volume advance; points move; the total mean pressure is averaged in the same way, before it becomes a
/// force in the next step. Rate and force are averaged by operators that are adjoint, at the same places and
/// with the same volumes, so that the discrete work is exact.
class Engine {
 public:
  Engine(Grid grid, const EngineSettings& settings);

  /// Adds a body whose particles lie in the grid; arrays of r .. stress are filled, and of omega where the
  /// material wants it.
  Body& add(Body body);
  /// Adds a force on the points of one body, given by its place in bodies(); of those of the others it knows
  /// nothing.
  void add(std::unique_ptr<PointForce> force, std::size_t body = 0) {
    bodies_.at(body).forces.push_back(std::move(force));
  }
  void set_base(const BaseFriction& base) { base_ = base; }
  /// Puts the bodies on those of another engine, whose steps this one then takes with its own: the bottom of
  /// this grid sticks to the top of the floor's (plane_tie.hpp). Both sides open, cells and symmetry alike.
  void rest_on(std::unique_ptr<Engine> floor);
  /// What the bodies rest on; null where that is a side of the grid.
  [[nodiscard]] const Engine* floor() const { return floor_.get(); }

  /// One time step, no longer than to `until` (s). After a failure the points are where they were.
  [[nodiscard]] std::optional<EngineFailure> step(double until);

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] long steps() const { return steps_; }
  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] const EngineSettings& settings() const { return settings_; }
  [[nodiscard]] const std::vector<Body>& bodies() const { return bodies_; }
  /// For states prescribed by tests; arrays keep their sizes.
  [[nodiscard]] Particles& particles(std::size_t body) { return bodies_[body].particles; }
  [[nodiscard]] const MaterialCount& count() const { return count_; }
  [[nodiscard]] double inertia() const { return inertia_; }
  [[nodiscard]] double last_step() const { return last_dt_; }
  [[nodiscard]] Energies energies() const;
  /// Saves or loads everything that steps change, here and in the floor; bodies, forces and base are those
  /// the engine was made with.
  template <class Archive>
  void visit(Archive& archive) {
    for (Body& body : bodies_) archive(body.particles);
    for (Field& field : fields_) {
      archive(field.corners);
      archive(field.stretches);
      archive(field.stiffest);
    }
    archive(started_);
    archive(time_);
    archive(steps_);
    archive(count_);
    archive(fastest_);
    archive(last_dt_);
    archive(inertia_);
    archive(next_inertia_);
    archive(internal_work_);
    archive(applied_work_);
    if (floor_) archive(*floor_);
  }
  /// Averaged total pressure of a body's point (Pa): the one that acts.
  [[nodiscard]] double total_pressure(std::size_t body, std::size_t i) const;

 private:
  struct Field {
    CornerField corners;
    std::vector<RowSums<CornerSum>> pressures;  ///< of the team's further threads
    std::vector<RowSums<double>> rates;
    std::size_t stretches = 0;  ///< of points in the same cell, when they were last sorted
    double stiffest = 0.0;      ///< largest modulus of a plane wave that the last step met (Pa)
  };

  [[nodiscard]] double longest_step() const;
  void gather_team();
  void prepare();
  void start();
  void sort_if_scattered();
  void push(double dt);
  void advance_nodes(double dt);
  void advance_row(std::size_t j, double dt, NodeWork& work);
  void count_work(const NodeWork& work);
  void fold(double dt);
  [[nodiscard]] std::optional<EngineFailure> stick_to_floor(double dt);
  [[nodiscard]] std::optional<EngineFailure> pull(double dt);
  void update(double dt);
  void adapt_inertia();
  void end_step(double dt, double until);
  /// Points of the team's thread k: first and last + 1.
  [[nodiscard]] std::pair<std::size_t, std::size_t> share(const Particles& particles, int k) const;
  /// The team calls f(k, first, last) on rows first .. last - 1 of nodes or corners, each thread k on its
  /// own.
  template <class F>
  void share_rows(F&& f) {
    team_->run([&](int k) {
      const std::size_t rows = grid_.rows() + 2;
      const auto size = static_cast<std::size_t>(team_->size());
      const auto thread = static_cast<std::size_t>(k);
      f(thread, rows * thread / size, rows * (thread + 1) / size);
    });
  }

  EngineSettings settings_;
  Grid grid_;
  std::unique_ptr<Team> team_;
  std::vector<NodeSums> sums_;  ///< of the team's further threads
  std::vector<Body> bodies_;
  std::vector<Field> fields_;
  BaseFriction base_;
  SlidingBase sliding_;
  std::unique_ptr<Engine> floor_;

  bool started_ = false;
  double time_ = 0.0;
  long steps_ = 0;
  MaterialCount count_;
  double fastest_ = 0.0;
  double last_dt_ = 0.0;
  double inertia_ = 1.0;
  double next_inertia_ = 1.0;
  double velocity_scale_ = 1.0;  ///< of the points' velocities, in this step
  double kinetic_ = 0.0;         ///< of the nodes, without scaling
  double internal_work_ = 0.0;
  double applied_work_ = 0.0;
};

}  // namespace isotach::mpm
