// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/undrained_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "bench/mpm_problems/regular_points.hpp"
#include "model/law.hpp"
#include "model/published_sets.hpp"
#include "mpm/engine.hpp"
#include "mpm/materials/vhp.hpp"
#include "mpm/materials/viscoplastic.hpp"
#include "mpm/slump.hpp"

namespace isotach::bench {

namespace {

using model::kPlane;
using mpm::Side;
using mpm::VhpMaterial;

constexpr double kGravity = 9.81;  // m/s2
constexpr int kCellsAcross = 4;
constexpr double kArtificialViscosity = 0.1;  // alpha of eta = alpha rho c h: rest within the time of holding
constexpr double kTolerance = 3e-3;           // as in slumps
constexpr double kLeastPressure = 0.5;        // Pa

model::Parameters<double> parameters() {
  return model::Parameters<double>::create(model::seed_mud_values()).value();
}

mpm::InitialState start() {
  mpm::Mud mud;
  mud.void_ratio = 3.891;
  return mpm::initial_state(parameters(), mud);
}

double water_modulus(const MudColumn& column, double void_ratio) {
  return column.water_bulk_modulus * (1.0 + void_ratio) / void_ratio;
}

/// Load over its last value, at a time: it starts and ends without a kink, so that it makes no waves.
double load_share(const MudColumn& column, double time) {
  const double x = std::clamp(time / column.loading_time, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double load_rate(const MudColumn& column, double time) {
  const double x = std::clamp(time / column.loading_time, 0.0, 1.0);
  return column.load * 6.0 * x * (1.0 - x) / column.loading_time;
}

/// The load on the points of the surface, an equal part on each.
class SurfaceLoad final : public mpm::PointForce {
 public:
  SurfaceLoad(const MudColumn& column, double area) : column_(column), area_(area) {}
  void add(const mpm::ForceBlock& block) const override {
    const double force = column_.load * area_ * load_share(column_, block.time + 0.5 * block.dt);
    for (std::size_t p = 0; p < block.count; ++p) block.loads.add(p, 0.0, -force);
  }

 private:
  MudColumn column_;
  double area_;  ///< of a point (m2 a metre)
};

mpm::Body mud_body(const MudColumn& column, const mpm::InitialState& initial) {
  const double h = column.cell_size;
  auto material = std::make_unique<VhpMaterial>(
      parameters(), VhpMaterial::Settings{kTolerance, kLeastPressure, column.water_bulk_modulus});
  mpm::Body body;
  body.particles =
      regular_points(kCellsAcross * h, column.height, 0.5 * h, mpm::Symmetry::plane, initial.density);
  mpm::Particles& q = body.particles;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.5 * h * column.jitter, 0.5 * h * column.jitter);
  for (std::size_t i = 0; i < q.count; ++i) {
    q.r[i] += shift(random);
    q.z[i] += shift(random);
    q.solid_volume[i] /= 1.0 + initial.void_ratio;
    const double total = initial.density * kGravity * (column.height - q.z[i]);
    q.reference_pressure.push_back(
        material->reference_pressure(total - initial.mean_effective_pressure, initial.void_ratio));
  }
  q.void_ratio.assign(q.count, initial.void_ratio);
  for (std::size_t k = 0; k < 3; ++k) q.stress[k].assign(q.count, -initial.mean_effective_pressure);
  body.material = std::move(material);
  body.density = initial.density;
  body.viscosity =
      kArtificialViscosity * h * std::sqrt(initial.density * water_modulus(column, initial.void_ratio));
  body.averaged = column.averaged;
  return body;
}

/// Points on the surface, without mass or volume: they go with it and carry the load.
mpm::Body surface_body(const MudColumn& column, double density) {
  mpm::Body body;
  const double spacing = 0.5 * column.cell_size;
  for (int i = 0; i < 2 * kCellsAcross; ++i) {
    body.particles.r.push_back((i + 0.5) * spacing);
    body.particles.z.push_back(column.height);
  }
  body.particles.count = body.particles.r.size();
  body.material = std::make_unique<mpm::ViscoplasticMaterial>(mpm::ViscoplasticMaterial::Constants{1.0, 1.0});
  body.density = density;
  body.averaged = false;
  return body;
}

/// Means over the points below a height (m).
struct Means {
  double pore_pressure = 0.0;
  double vertical = 0.0;         ///< effective, compression positive
  double specific_volume = 0.0;  ///< 1 + e
};

constexpr double kSurfaceCells = 4.0;

Means means(const mpm::Engine& engine, double below) {
  const mpm::Body& body = engine.bodies()[0];
  const mpm::Particles& q = body.particles;
  const auto& mud = dynamic_cast<const VhpMaterial&>(*body.material);
  Means sum;
  double n = 0.0;
  for (std::size_t i = 0; i < q.count; ++i) {
    if (q.z[i] > below) continue;
    sum.pore_pressure += mud.pore_pressure(q, i);
    sum.vertical -= q.stress[1][i];
    sum.specific_volume += 1.0 + q.void_ratio[i];
    n += 1.0;
  }
  return {sum.pore_pressure / n, sum.vertical / n, sum.specific_volume / n};
}

double surface(const mpm::Engine& engine) {
  const mpm::Particles& q = engine.bodies()[1].particles;
  double sum = 0.0;
  for (std::size_t i = 0; i < q.count; ++i) sum += q.z[i];
  return sum / static_cast<double>(q.count);
}

/// The straight line in z that fits the points below a height best, and the root mean squares of what is left
/// below and above.
struct Line {
  double slope;
  double scatter;
  double scatter_above;
};

Line fit(const std::vector<double>& z, const std::vector<double>& y, double below) {
  double mean_z = 0.0;
  double mean_y = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (z[i] > below) continue;
    mean_z += z[i];
    mean_y += y[i];
    n += 1.0;
  }
  mean_z /= n;
  mean_y /= n;
  double zz = 0.0;
  double zy = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (z[i] > below) continue;
    zz += (z[i] - mean_z) * (z[i] - mean_z);
    zy += (z[i] - mean_z) * (y[i] - mean_y);
  }
  Line line{zy / zz, 0.0, 0.0};
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double left = y[i] - mean_y - line.slope * (z[i] - mean_z);
    (z[i] > below ? line.scatter_above : line.scatter) += left * left;
  }
  line.scatter = std::sqrt(line.scatter / n);
  line.scatter_above = std::sqrt(line.scatter_above / (static_cast<double>(z.size()) - n));
  return line;
}

using ElementState = model::State<double, kPlane, model::Fabric::none>;

/// Rates of the element's state and, with it, of its compression, pore pressure.
struct ElementRate {
  model::StateRate<double, kPlane, model::Fabric::none> state;
  double compression;    ///< 1/s
  double pore_pressure;  ///< Pa/s
};

ElementRate element_rate(const model::Law<double>& law, const MudColumn& column, const ElementState& y,
                         double time) {
  const double water = water_modulus(column, y.void_ratio);
  ElementRate rate{};
  // near to linear: corrected by a stiffness that is at least half of the true one, until nothing is left
  constexpr int kMostIterations = 200;
  constexpr double kSkeleton = 1e5;  // Pa
  for (int n = 0; n < kMostIterations; ++n) {
    model::Mandel<double, kPlane> strain_rate = model::Mandel<double, kPlane>::Zero();
    strain_rate[1] = -rate.compression;
    rate.state = law.rate(y, strain_rate);
    const double left = load_rate(column, time) + rate.state.stress[1] - water * rate.compression;
    rate.compression += left / (water + kSkeleton);
    if (std::abs(left) < 1e-9 * column.load / column.loading_time) break;
  }
  rate.pore_pressure = water * rate.compression;
  return rate;
}

}  // namespace

ColumnResult load_column(const MudColumn& column) {
  const mpm::InitialState initial = start();
  const double h = column.cell_size;
  mpm::EngineSettings settings;
  settings.symmetry = mpm::Symmetry::plane;
  settings.gravity = kGravity;
  mpm::Engine engine(mpm::Grid(h, kCellsAcross * h, column.height + 3.0 * h,
                               {Side::symmetric, Side::symmetric, Side::fixed, Side::open}),
                     settings);
  engine.add(mud_body(column, initial));
  engine.add(surface_body(column, initial.density));
  engine.add(std::make_unique<SurfaceLoad>(column, 0.5 * h), 1);
  const double below = column.height - kSurfaceCells * h;
  const Means before = means(engine, below);
  const double end = column.loading_time + column.holding_time;
  ColumnResult result{};
  while (engine.time() < end) {
    if (engine.step(end)) return result;
  }
  const Means after = means(engine, below);
  result.answer.pore_pressure_share = (after.pore_pressure - before.pore_pressure) / column.load;
  result.answer.skeleton_share = (after.vertical - before.vertical) / column.load;
  result.answer.settlement = column.height * (1.0 - after.specific_volume / before.specific_volume);
  result.surface_settlement = column.height - surface(engine);
  const mpm::Particles& q = engine.bodies()[0].particles;
  const std::vector<double> z(q.z.begin(), q.z.begin() + static_cast<std::ptrdiff_t>(q.count));
  std::vector<double> own(q.count);
  engine.bodies()[0].material->total_pressure(q, 0, q.count, own.data());
  std::vector<double> acting;
  for (std::size_t i = 0; i < q.count; ++i) acting.push_back(engine.total_pressure(0, i));
  const Line own_line = fit(z, own, below);
  const Line line = fit(z, acting, below);
  result.own_scatter = own_line.scatter / column.load;
  result.surface_own_scatter = own_line.scatter_above / column.load;
  result.acting_scatter = line.scatter / column.load;
  result.surface_acting_scatter = line.scatter_above / column.load;
  result.gradient = -line.slope / (initial.density * kGravity);
  result.kinetic = engine.energies().kinetic / (column.load * kCellsAcross * h * result.surface_settlement);
  return result;
}

ColumnAnswer load_element(const MudColumn& column) {
  const mpm::InitialState initial = start();
  const model::Law<double> law(parameters());
  ElementState y{};
  y.stress = model::unit_tensor<double, kPlane>() * -initial.mean_effective_pressure;
  y.void_ratio = initial.void_ratio;
  double compression = 0.0;
  double pore_pressure = 0.0;
  const double first = y.stress[1];
  constexpr int kSteps = 2000;
  const double dt = (column.loading_time + column.holding_time) / kSteps;
  for (int n = 0; n < kSteps; ++n) {  // the midpoint rule: its error is far below what is compared
    const ElementRate start_rate = element_rate(law, column, y, n * dt);
    const ElementRate middle =
        element_rate(law, column, advanced(y, start_rate.state, 0.5 * dt), (n + 0.5) * dt);
    y = advanced(y, middle.state, dt);
    compression += middle.compression * dt;
    pore_pressure += middle.pore_pressure * dt;
  }
  return {pore_pressure / column.load, (first - y.stress[1]) / column.load,
          column.height * -std::expm1(-compression)};
}

ColumnAnswer load_springs(const MudColumn& column, double skeleton) {
  const double water = water_modulus(column, start().void_ratio);
  return {water / (water + skeleton), skeleton / (water + skeleton),
          column.load * column.height / (water + skeleton)};
}

Section undrained_section() {
  Section section{
      "Undrained column",
      "A column of mud (seed paper, e = 3.891, OCR 1.5; 0.1 m high, four cells wide, between smooth walls) "
      "is "
      "at rest under its weight; within 0.3 s a load of 2 kPa grows on its surface, carried by points "
      "without "
      "mass that go with it, and stays for 0.1 s. All depths strain alike, so one element of the law under "
      "that vertical total stress (integrated apart from the engine) is exact: water and skeleton share the "
      "load as K_w (1+e)/e and the skeleton's modulus along the path do, and the settlement is load H over "
      "their sum. Shares, strain (times H) and scatter are those of points deeper than four cells: the root "
      "mean square, over the load, by which the total pressure leaves a straight line in z, in the points "
      "('own') and averaged, as it acts. 'Near surface' is what the four cells above leave that line by; "
      "'gradient' that of the acting pressure over -rho g. Points on a lattice, then shifted at random by up "
      "to a part of their spacing.\n\n"
      "A loaded surface that has settled by a noticeable part of a cell is not resolved: pressures of the "
      "rows "
      "next to it alternate, with averages or without, and the surface settles too much, while all below "
      "is as it should be. The points in a cell that the surface cuts are its quadrature, and a coarse one "
      "for "
      "a pressure that does not vanish at the surface. The less load, the less of it (the row with 0.5 kPa).",
      {{{"K_w (kPa)", "load (kPa)", "cells", "averaged", "shift", "du/load", "element", "strain H (mm)",
         "surface (mm)", "element (mm)", "water alone (mm)", "own scatter", "acting", "near surface, own",
         "near surface, acting", "gradient", "E_kin/(load settlement)"},
        {}}}};
  const auto add = [&section](const MudColumn& column) {
    const ColumnResult r = load_column(column);
    const ColumnAnswer element = load_element(column);
    section.tables.front().rows.push_back(
        {fmt::format("{:.0f}", 1e-3 * column.water_bulk_modulus), fmt::format("{:.1f}", 1e-3 * column.load),
         fmt::format("{:.0f}", column.height / column.cell_size), column.averaged ? "yes" : "no",
         fmt::format("{:.2f}", 0.5 * column.jitter), fmt::format("{:.4f}", r.answer.pore_pressure_share),
         fmt::format("{:.4f}", element.pore_pressure_share), fmt::format("{:.4f}", 1e3 * r.answer.settlement),
         fmt::format("{:.4f}", 1e3 * r.surface_settlement), fmt::format("{:.4f}", 1e3 * element.settlement),
         fmt::format("{:.4f}", 1e3 * load_springs(column, 0.0).settlement),
         fmt::format("{:.4f}", r.own_scatter), fmt::format("{:.4f}", r.acting_scatter),
         fmt::format("{:.4f}", r.surface_own_scatter), fmt::format("{:.4f}", r.surface_acting_scatter),
         fmt::format("{:.4f}", r.gradient), fmt::format("{:.0e}", r.kinetic)});
  };
  MudColumn column;
  for (const double bulk : {100e3, 300e3, 1e6, 3e6}) {
    for (const double cells : {10.0, 20.0, 40.0}) {
      column.cell_size = column.height / cells;
      column.water_bulk_modulus = bulk;
      add(column);
    }
  }
  column = {};
  column.load = 500.0;
  column.water_bulk_modulus = 100e3;
  add(column);
  column = {};
  for (const double jitter : {0.0, 0.1, 0.2}) {
    for (const bool averaged : {true, false}) {
      column.jitter = jitter;
      column.averaged = averaged;
      add(column);
    }
  }
  return section;
}

}  // namespace isotach::bench
