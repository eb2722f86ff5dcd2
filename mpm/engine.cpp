// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "mpm/base_gap.hpp"
#include "mpm/plane_tie.hpp"
#include "mpm/point_order.hpp"

namespace isotach::mpm {

namespace {

constexpr double kQuasiStaticEnergy = 3e-5;  // kinetic energy, scaled, over the energy scale
constexpr double kInertiaGrowth = 1.002;     // largest growth of the inertia factor in a step
constexpr double kScattered = 1.5;           // times the stretches of sorted points: worth sorting again
constexpr std::size_t kFewestPerThread = 4096;

template <class F>
void with_symmetry(Symmetry symmetry, F&& f) {
  if (symmetry == Symmetry::axisymmetric) {
    f.template operator()<Symmetry::axisymmetric>();
  } else {
    f.template operator()<Symmetry::plane>();
  }
}

}  // namespace

Engine::Engine(Grid grid, const EngineSettings& settings) : settings_(settings), grid_(std::move(grid)) {}

Body& Engine::add(Body body) {
  Particles& q = body.particles;
  if (q.count == 0) throw std::invalid_argument("a body needs points");
  if (q.count > std::numeric_limits<std::uint32_t>::max()) throw std::invalid_argument("too many points");
  const std::size_t padded = Particles::padded(q.count, kBlock);
  std::vector<const PointArray*> absent;
  q.for_each_optional([&](PointArray& array) {
    if (array.empty()) absent.push_back(&array);
  });
  q.for_each_array([&](PointArray& array) {
    if (std::find(absent.begin(), absent.end(), &array) != absent.end()) return;
    array.reserve(padded);
    array.resize(q.count, 0.0);
    array.resize(padded, array.back());
  });
  std::fill(q.mass.begin() + static_cast<std::ptrdiff_t>(q.count), q.mass.end(), 0.0);
  std::fill(q.solid_volume.begin() + static_cast<std::ptrdiff_t>(q.count), q.solid_volume.end(), 0.0);
  const auto outside = [this](double r, double z) {
    return !(r > 0.0 && r < grid_.width() && z > 0.0 && z < grid_.height());
  };
  for (std::size_t i = 0; i < q.count; ++i) {
    if (outside(q.r[i], q.z[i])) throw std::invalid_argument("a point lies outside of the grid");
  }
  fields_.push_back(Field{CornerField(grid_.stride(), grid_.rows() + 2), {}, {}});
  bodies_.push_back(std::move(body));
  return bodies_.back();
}

void Engine::rest_on(std::unique_ptr<Engine> floor) {
  if (!floor || floor->floor_ || floor->grid_.cell_size() != grid_.cell_size() ||
      floor->settings_.symmetry != settings_.symmetry || floor->grid_.sides().top != Side::open ||
      grid_.sides().bottom != Side::open) {
    throw std::invalid_argument("a floor needs cells and symmetry as above it, and open sides between");
  }
  floor_ = std::move(floor);
}

std::pair<std::size_t, std::size_t> Engine::share(const Particles& q, int k) const {
  const std::size_t blocks = (q.count + kBlock - 1) / kBlock;
  const auto threads =
      std::clamp<std::size_t>(q.count / kFewestPerThread, 1, static_cast<std::size_t>(team_->size()));
  const std::size_t t = std::min(static_cast<std::size_t>(k), threads);
  const std::size_t next = std::min(t + 1, threads);
  return {std::min(q.count, blocks * t / threads * kBlock),
          std::min(q.count, blocks * next / threads * kBlock)};
}

// The order of points changes what sums round to, so it may depend on nothing but the points and the step.
void Engine::sort_if_scattered() {
  constexpr long kStepsBetweenLooks = 32;
  if (steps_ % kStepsBetweenLooks != 0) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto limit = static_cast<std::size_t>(kScattered * static_cast<double>(fields_[b].stretches));
    if (count_stretches(grid_, bodies_[b].particles) <= limit) continue;
    sort_by_cells(grid_, bodies_[b].particles);
    fields_[b].stretches = count_stretches(grid_, bodies_[b].particles);
  }
}

/// As many threads as have enough to do.
void Engine::gather_team() {
  std::size_t most = 1;
  for (const Body& body : bodies_) most = std::max(most, body.particles.count / kFewestPerThread);
  team_ = std::make_unique<Team>(static_cast<int>(
      std::min<std::size_t>(static_cast<std::size_t>(std::max(1, settings_.threads)), most)));
  for (int k = 1; k < team_->size(); ++k) {
    sums_.emplace_back(grid_.stride(), grid_.rows() + 2);
    for (Field& field : fields_) {
      field.pressures.emplace_back(grid_.stride(), grid_.rows() + 2);
      field.rates.emplace_back(grid_.stride(), grid_.rows() + 2);
    }
  }
}

void Engine::prepare() {
  if (!team_) gather_team();
  if (!started_) start();
  sort_if_scattered();
}

void Engine::start() {
  started_ = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    sort_by_cells(grid_, body.particles);
    fields_[b].stretches = count_stretches(grid_, body.particles);
    for (std::size_t i = 0; i < body.particles.count; ++i) {
      fields_[b].stiffest = std::max(fields_[b].stiffest, body.material->wave_modulus(body.particles, i));
    }
    if (!body.averaged) continue;
    CornerField& corners = fields_[b].corners;
    push_pressure(body.particles, 0, body.particles.count, grid_, *body.material, corners.pressures);
    corners.average_pressure(0, corners.pressures.rows());
  }
}

// Explicit limits: no wave may cross a cell in a step, and momentum may not diffuse across one. Where bodies
// share nodes, their highest frequency is no higher than the highest of theirs (Rayleigh's quotient).
double Engine::longest_step() const {
  const double h = grid_.cell_size();
  double least = HUGE_VAL;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = bodies_[b];
    const double density = body.density * inertia_;
    const double wave_speed = std::sqrt(fields_[b].stiffest / density);
    least = std::min(least, settings_.courant * h / (wave_speed + fastest_));
    if (body.viscosity > 0.0) {
      least = std::min(least, 0.25 * h * h * density / body.viscosity);
    }
  }
  return least;
}

void Engine::push(double dt) {
  // inertia that grows must not add kinetic energy: velocities shrink so that it stays
  const double scale = std::sqrt(inertia_ / next_inertia_);
  inertia_ = next_inertia_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    PushSettings settings;
    settings.time = time_;
    settings.dt = dt;
    settings.gravity = settings_.gravity;
    settings.two_eta = 2.0 * body.viscosity;
    settings.velocity_scale = scale;
    settings.mean = body.averaged ? fields_[b].corners.mean.data() : nullptr;
    settings.material = body.material.get();
    settings.forces = &body.forces;
    for (const auto& force : body.forces) force->prepare(body.particles);
    with_symmetry(settings_.symmetry, [&]<Symmetry S>() {
      team_->run([&](int k) {
        const auto [begin, end] = share(body.particles, k);
        NodeSums& sums = k == 0 ? grid_.sums() : sums_[static_cast<std::size_t>(k - 1)];
        if (b == 0) sums.clear();
        push_to_nodes<S>(body.particles, begin, end, grid_, settings, sums);
      });
    });
  }
  velocity_scale_ = scale;
  if (!sums_.empty()) {
    share_rows([&](std::size_t, std::size_t first, std::size_t last) {
      for (const NodeSums& sums : sums_) grid_.sums().add(sums, first, last);
    });
  }
}

void Engine::count_work(const NodeWork& work) {
  internal_work_ += work.internal;
  applied_work_ += work.applied;
  kinetic_ += work.kinetic;
}

void Engine::advance_row(std::size_t j, double dt, NodeWork& work) {
  const Octet* nodes = grid_.sums().data();
  NodeVelocity* velocities = grid_.velocities();
  const double inverse_inertia = 1.0 / inertia_;
  const std::size_t end = grid_.sums().end(j);
  for (std::size_t i = 0; i < end; ++i) {
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
    const double change_r = (node[kInternalR] + node[kAppliedR]) * impulse;
    const double change_z = (node[kInternalZ] + node[kAppliedZ]) * impulse;
    const double path_r = (before_r + 0.5 * change_r) * dt;
    const double path_z = (before_z + 0.5 * change_z) * dt;
    work.internal += node[kInternalR] * path_r + node[kInternalZ] * path_z;
    work.applied += node[kAppliedR] * path_r + (node[kAppliedZ] + node[kMass] * settings_.gravity) * path_z;
    const double after_r = before_r + change_r;
    const double after_z = before_z + change_z;
    work.kinetic += 0.5 * node[kMass] * (after_r * after_r + after_z * after_z);
    velocities[n] = NodeVelocity{after_r, after_z, before_r, before_z};
  }
}

void Engine::fold(double dt) {
  kinetic_ = 0.0;
  grid_.fold_columns();
  const bool slides = grid_.sides().bottom == Side::fixed && base_.yields();
  sliding_.forget();
  if (slides) count_work(sliding_.slide(grid_, base_, settings_.symmetry, dt, inertia_));
  grid_.fold_rows();
  sliding_.take_out(grid_);
}

void Engine::advance_nodes(double dt) {
  const std::size_t lowest = grid_.sides().bottom == Side::open ? 0 : 1;
  const std::size_t end = grid_.sides().top == Side::open ? grid_.rows() + 2 : grid_.rows() + 1;
  std::vector<NodeWork> works(static_cast<std::size_t>(team_->size()));
  share_rows([&](std::size_t thread, std::size_t first, std::size_t last) {
    NodeWork work;
    for (std::size_t j = std::max(first, lowest); j < std::min(last, end); ++j) advance_row(j, dt, work);
    works[thread] = work;
  });
  for (const NodeWork& work : works) count_work(work);
  grid_.mirror_velocities();
  sliding_.put_back(grid_);
}

std::optional<EngineFailure> Engine::pull(double dt) {
  PullSettings settings;
  settings.dt = dt;
  settings.velocity_scale = velocity_scale_;
  settings.keep_velocity = std::max(0.0, 1.0 - dt / (settings_.residual_time * std::sqrt(inertia_)));
  settings.keep_gradient = settings.keep_velocity;
  fastest_ = 0.0;
  std::optional<EngineFailure> failure;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    Field& field = fields_[b];
    std::vector<PullResult> results(static_cast<std::size_t>(team_->size()));
    with_symmetry(settings_.symmetry, [&]<Symmetry S>() {
      team_->run([&](int k) {
        const auto [begin, end] = share(body.particles, k);
        auto& rates = k == 0 ? field.corners.rates : field.rates[static_cast<std::size_t>(k - 1)];
        rates.clear();
        results[static_cast<std::size_t>(k)] =
            pull_from_nodes<S>(body.particles, begin, end, grid_, settings, body.averaged ? &rates : nullptr);
      });
    });
    for (const PullResult& result : results) {
      fastest_ = std::max(fastest_, result.fastest);
      if (!result.leaving || failure) continue;
      const Particles& q = body.particles;
      const std::size_t i = *result.leaving;
      const bool finite =
          std::isfinite(q.velocity_r[i] + q.velocity_z[i] + q.grid_velocity_r[i] + q.grid_velocity_z[i]);
      failure = EngineFailure{
          finite ? EngineFailure::Kind::left_grid : EngineFailure::Kind::not_finite, time_, q.r[i], q.z[i],
          fmt::format("{} at t = {:.6g} s, r = {:.3f} mm, z = {:.3f} mm (step {})",
                      finite ? "a material point leaves the grid" : "a velocity is not finite", time_,
                      q.r[i] * 1e3, q.z[i] * 1e3, steps_)};
    }
    if (!body.averaged) continue;
    share_rows([&](std::size_t, std::size_t first, std::size_t last) {
      for (const auto& rates : field.rates) field.corners.rates.add(rates, first, last);
      field.corners.average_rate(first, last);
    });
    if (body.flows && settings_.closes_base_gap)
      close_gap_above_base(grid_, settings_.symmetry, field.corners);
  }
  return failure;
}

void Engine::update(double dt) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Body& body = bodies_[b];
    Field& field = fields_[b];
    body.particles.repeat_last(kOctet);
    std::vector<MaterialCount> counts(static_cast<std::size_t>(team_->size()));
    const double* mean_rate = body.averaged ? field.corners.mean.data() : nullptr;
    with_symmetry(settings_.symmetry, [&]<Symmetry S>() {
      team_->run([&](int k) {
        const auto [begin, end] = share(body.particles, k);
        auto& pressures = k == 0 ? field.corners.pressures : field.pressures[static_cast<std::size_t>(k - 1)];
        pressures.clear();
        update_points<S>(body.particles, begin, end, grid_, {time_, dt}, mean_rate, *body.material,
                         body.averaged ? &pressures : nullptr, counts[static_cast<std::size_t>(k)]);
      });
    });
    MaterialCount met;
    for (const MaterialCount& count : counts) met += count;
    field.stiffest = met.stiffest;
    count_ += met;
    if (!body.averaged) continue;
    share_rows([&](std::size_t, std::size_t first, std::size_t last) {
      for (const auto& pressures : field.pressures) field.corners.pressures.add(pressures, first, last);
      field.corners.average_pressure(first, last);
    });
  }
}

std::optional<EngineFailure> Engine::stick_to_floor(double dt) {
  floor_->push(dt);
  floor_->fold(dt);
  const auto column = tie_planes(grid_.sums(), floor_->grid_.sums());
  if (!column) return std::nullopt;
  const double r = (static_cast<double>(*column) - 0.5) * grid_.cell_size();
  return EngineFailure{
      EngineFailure::Kind::left_floor, time_, r, 0.0,
      fmt::format("the material runs beyond what it rests on at t = {:.6g} s, r = {:.1f} mm (step {})", time_,
                  r * 1e3, steps_)};
}

std::optional<EngineFailure> Engine::step(double until) {
  prepare();
  double dt = std::min(longest_step(), until - time_);
  if (floor_) {  // one motion: the same step, and inertia as large
    floor_->inertia_ = inertia_;
    floor_->next_inertia_ = next_inertia_;
    floor_->prepare();
    dt = std::min(dt, floor_->longest_step());
  }
  push(dt);
  fold(dt);
  if (floor_) {
    if (auto failure = stick_to_floor(dt)) return failure;
    floor_->advance_nodes(dt);
  }
  advance_nodes(dt);
  if (auto failure = pull(dt)) return failure;
  if (floor_) {
    if (auto failure = floor_->pull(dt)) {
      failure->z -= floor_->grid_.height();  // as seen from above
      failure->message = "in what the material rests on: " + failure->message;
      return failure;
    }
    floor_->update(dt);
    floor_->end_step(dt, until);
  }
  update(dt);
  end_step(dt, until);
  if (settings_.inertia_scaling > 1.0) adapt_inertia();
  return std::nullopt;
}

void Engine::end_step(double dt, double until) {
  ++steps_;
  last_dt_ = dt;
  time_ = dt < until - time_ ? time_ + dt : until;
}

// Larger inertia permits longer steps. It may grow while the kinetic energy it makes stays far below the
// energy that drives the flow, so that inertia keeps having no say in the motion.
void Engine::adapt_inertia() {
  const double allowed = kQuasiStaticEnergy * settings_.energy_scale / std::max(kinetic_, 1e-30);
  const double wanted = std::clamp(allowed, 1.0, settings_.inertia_scaling);
  next_inertia_ = std::min(wanted, inertia_ * kInertiaGrowth);
  if (next_inertia_ < inertia_) inertia_ = next_inertia_;
}

Energies Engine::energies() const {
  Energies e;
  for (const Body& body : bodies_) {
    const Particles& q = body.particles;
    for (std::size_t i = 0; i < q.count; ++i) {
      const double speed2 = q.velocity_r[i] * q.velocity_r[i] + q.velocity_z[i] * q.velocity_z[i];
      e.kinetic += 0.5 * inertia_ * q.mass[i] * speed2;
      e.potential += q.mass[i] * settings_.gravity * q.z[i];
    }
  }
  e.stress_work = -internal_work_;
  e.boundary_work = -applied_work_;
  return e;
}

double Engine::total_pressure(std::size_t body, std::size_t i) const {
  const Particles& q = bodies_[body].particles;
  if (bodies_[body].averaged) return at_point(grid_, fields_[body].corners.mean.data(), q.r[i], q.z[i]);
  double pressure = 0.0;
  bodies_[body].material->total_pressure(q, i, 1, &pressure);
  return pressure;
}

}  // namespace isotach::mpm
