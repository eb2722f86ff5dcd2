// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/elastic_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mpm/materials/viscoplastic.hpp"

namespace isotach::bench {

namespace {

using mpm::Body;
using mpm::Engine;
using mpm::Particles;

/// A force on each point: a given one times its mass, or on a loaded side a traction times its area, which
/// stands in omega[2] (m2/rad).
class GivenForce final : public mpm::PointForce {
 public:
  enum class Amount { mass, area };
  GivenForce(Field force, Amount amount) : force_(std::move(force)), amount_(amount) {}

  void add(const mpm::ForceBlock& block) const override {
    const Particles& q = block.particles;
    const mpm::PointArray& amounts = amount_ == Amount::mass ? q.mass : q.omega[2];
    for (std::size_t p = 0; p < block.count; ++p) {
      const std::size_t i = block.begin + p;
      const Pair value = force_(start_of(q, i), block.time);
      block.loads.add(p, amounts[i] * value.r, amounts[i] * value.z);
    }
  }

 private:
  Field force_;
  Amount amount_;
};

std::unique_ptr<const mpm::Material> elastic(const ElasticConstants& material) {
  return std::make_unique<mpm::ViscoplasticMaterial>(
      mpm::ViscoplasticMaterial::Constants{material.bulk(), material.shear()});
}

/// Points without mass and volume along r = width, each in the middle of its part of the side.
Body loaded_side(const ElasticProblem& problem, double cell, const Numerics& numerics) {
  Body body;
  Particles& q = body.particles;
  const double step = cell / numerics.points;
  q.count = static_cast<std::size_t>(std::lround(problem.height / step));
  for (std::size_t j = 0; j < q.count; ++j) {
    q.r.push_back(problem.width);
    q.z.push_back((static_cast<double>(j) + 0.5) * step);
    q.omega[2].push_back(step * (problem.symmetry == mpm::Symmetry::axisymmetric ? problem.width : 1.0));
  }
  q.omega[0] = q.r;
  q.omega[1] = q.z;
  body.material = elastic(problem.material);
  body.density = problem.material.density;
  body.averaged = false;
  return body;
}

void set_velocities(Particles& q, const ElasticProblem& problem, double time) {
  const double step = 1e-5 * problem.width;
  for (std::size_t i = 0; i < q.count; ++i) {
    const Pair x = start_of(q, i);
    const Pair v = problem.velocity(x, time);
    q.velocity_r.push_back(v.r);
    q.velocity_z.push_back(v.z);
    const Pair right = problem.velocity({x.r + step, x.z}, time);
    const Pair left = problem.velocity({x.r - step, x.z}, time);
    const Pair above = problem.velocity({x.r, x.z + step}, time);
    const Pair below = problem.velocity({x.r, x.z - step}, time);
    q.c_rr.push_back((right.r - left.r) / (2.0 * step));
    q.c_zr.push_back((right.z - left.z) / (2.0 * step));
    q.c_rz.push_back((above.r - below.r) / (2.0 * step));
    q.c_zz.push_back((above.z - below.z) / (2.0 * step));
  }
}

/// Mean squares over mass of a difference and of what it is compared with.
struct Squares {
  double difference = 0.0;
  double exact = 0.0;

  void add(double mass, double of_r, double of_z, const Pair& expected) {
    difference += mass * (std::pow(of_r - expected.r, 2) + std::pow(of_z - expected.z, 2));
    exact += mass * (expected.r * expected.r + expected.z * expected.z);
  }
  [[nodiscard]] double relative() const { return std::sqrt(difference / exact); }
};

}  // namespace

Body elastic_box(double width, double height, double cell, mpm::Symmetry symmetry,
                 const ElasticConstants& material, const Numerics& numerics) {
  Body body;
  Particles& q = body.particles;
  const double step = cell / numerics.points;
  const auto columns = static_cast<std::size_t>(std::lround(width / step));
  const auto rows = static_cast<std::size_t>(std::lround(height / step));
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      q.r.push_back((static_cast<double>(i) + 0.5) * step);
      q.z.push_back((static_cast<double>(j) + 0.5) * step);
      const double volume = step * step * (symmetry == mpm::Symmetry::axisymmetric ? q.r.back() : 1.0);
      q.solid_volume.push_back(volume);
      q.mass.push_back(material.density * volume);
    }
  }
  q.count = q.r.size();
  q.omega[0] = q.r;
  q.omega[1] = q.z;
  body.material = elastic(material);
  body.density = material.density;
  body.viscosity = numerics.viscosity * material.density * material.wave_speed() * cell;
  body.averaged = numerics.averaged;
  return body;
}

MotionErrors follow(const ElasticProblem& problem, double cell, double duration, const Numerics& numerics) {
  const double longest = numerics.courant * cell / problem.material.wave_speed();
  const auto steps = static_cast<long>(std::ceil(duration / longest));
  const double dt = duration / static_cast<double>(steps);

  mpm::EngineSettings settings;
  settings.symmetry = problem.symmetry;
  settings.gravity = 0.0;
  settings.courant = 2.0;  // the steps are set here
  settings.residual_time = numerics.residual_time;
  Engine engine(mpm::Grid(cell, problem.width + problem.open_right * cell, problem.height, problem.sides),
                settings);
  Body box = elastic_box(problem.width, problem.height, cell, problem.symmetry, problem.material, numerics);
  set_velocities(box.particles, problem, -0.5 * dt);
  engine.add(std::move(box));
  if (problem.force) engine.add(std::make_unique<GivenForce>(problem.force, GivenForce::Amount::mass));
  if (problem.traction) {
    engine.add(loaded_side(problem, cell, numerics));
    engine.add(std::make_unique<GivenForce>(problem.traction, GivenForce::Amount::area), 1);
  }

  MotionErrors result;
  Squares velocity;
  Squares displacement;
  const auto cell_of = [cell](double x) { return static_cast<long>(x / cell); };
  for (long n = 1; n <= steps; ++n) {
    const double time = static_cast<double>(n) * dt;
    const Particles& q = engine.bodies().front().particles;
    if (const auto failure = engine.step(time)) throw std::runtime_error(failure->message);
    if (engine.steps() != n) throw std::logic_error("the step is beyond the engine's limit");
    double projection = 0.0;
    double norm = 0.0;
    double away = 0.0;
    for (std::size_t i = 0; i < q.count; ++i) {
      const Pair x = start_of(q, i);
      const double u_r = q.r[i] - x.r;
      const double u_z = q.z[i] - x.z;
      velocity.add(q.mass[i], q.velocity_r[i], q.velocity_z[i], problem.velocity(x, time - 0.5 * dt));
      displacement.add(q.mass[i], u_r, u_z, problem.displacement(x, time));
      const Pair shape = problem.displacement(x, problem.shape_time);
      projection += q.mass[i] * (u_r * shape.r + u_z * shape.z);
      norm += q.mass[i] * (shape.r * shape.r + shape.z * shape.z);
      away += cell_of(q.r[i]) != cell_of(x.r) || cell_of(q.z[i]) != cell_of(x.z) ? 1.0 : 0.0;
    }
    result.crossed = std::max(result.crossed, away / static_cast<double>(q.count));
    result.times.push_back(time);
    result.amplitudes.push_back(projection / norm);
  }
  result.velocity = velocity.relative();
  result.displacement = displacement.relative();
  return result;
}

std::string named(const Numerics& numerics) {
  std::string name = numerics.averaged ? "averaged" : "points";
  if (numerics.points != 2) name += fmt::format(", {0} x {0} a cell", numerics.points);
  if (numerics.residual_time == 0.0)
    name += ", plain APIC";
  else if (std::isinf(numerics.residual_time))
    name += ", residuals never fade";
  else if (numerics.residual_time != Numerics{}.residual_time) {
    name += fmt::format(", residuals fade in {:g} s", numerics.residual_time);
  }
  if (numerics.viscosity > 0.0) name += fmt::format(", alpha {:g}", numerics.viscosity);
  return name;
}

double fitted_frequency(const std::vector<double>& times, const std::vector<double>& values, double guess) {
  // the part of the values that no a cos wt + b sin wt explains
  const auto misfit = [&](double w) {
    double cc = 0.0;
    double cs = 0.0;
    double ss = 0.0;
    double cv = 0.0;
    double sv = 0.0;
    for (std::size_t n = 0; n < times.size(); ++n) {
      const double c = std::cos(w * times[n]);
      const double s = std::sin(w * times[n]);
      cc += c * c;
      cs += c * s;
      ss += s * s;
      cv += c * values[n];
      sv += s * values[n];
    }
    const double det = cc * ss - cs * cs;
    return -(cv * (ss * cv - cs * sv) + sv * (cc * sv - cs * cv)) / det;
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = 0.8 * guess;
  double high = 1.2 * guess;
  while (high - low > 1e-9 * guess) {
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  return 0.5 * (low + high);
}

}  // namespace isotach::bench
