// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/closed_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/mpm_problems/regular_points.hpp"
#include "mpm/engine.hpp"
#include "mpm/materials/viscoplastic.hpp"

namespace isotach::bench {

namespace {

using mpm::Side;
using mpm::Symmetry;

constexpr double kDensity = 1000.0;   // kg/m3
constexpr double kShear = 1e4;        // Pa
constexpr double kDeflection = 1e-4;  // m, largest
constexpr double kDecayTimes = 14.0;  // run, in 1/omega: what is left is (1 + 14) e^-14 of the start

struct Pair {
  double r;
  double z;
};

/// Displacement over the amplitude, and the body force over G times it, at a place.
struct Field {
  Pair displacement;
  Pair force;
};

Field plane_field(double r, double z) {
  const auto of = [](double x) {
    struct {
      double value, first, second, third;
    } p{x * x * (1.0 - x) * (1.0 - x), 2.0 * x * (1.0 - x) * (1.0 - 2.0 * x), 2.0 - 12.0 * x + 12.0 * x * x,
        -12.0 + 24.0 * x};
    return p;
  };
  const auto f = of(r);
  const auto g = of(z);
  return {{-f.value * g.first, f.first * g.value},
          {f.second * g.first + f.value * g.third, -(f.third * g.value + f.first * g.second)}};
}

Field axisymmetric_field(double r, double z) {
  const double r2 = r * r;
  const double f_over_r = r * (1.0 - r2) * (1.0 - r2);
  const double f1_over_r = 2.0 * (1.0 - r2) * (1.0 - 3.0 * r2);
  const double e_over_r = r * (-16.0 + 24.0 * r2);  // (f'' - f'/r)/r
  const double e1_over_r = -32.0 + 96.0 * r2;       // (f'' - f'/r)'/r
  const double g = z * z * (1.0 - z) * (1.0 - z);
  const double g1 = 2.0 * z * (1.0 - z) * (1.0 - 2.0 * z);
  const double g2 = 2.0 - 12.0 * z + 12.0 * z * z;
  const double g3 = -12.0 + 24.0 * z;
  return {{-f_over_r * g1, f1_over_r * g},
          {e_over_r * g1 + f_over_r * g3, -(e1_over_r * g + f1_over_r * g2)}};
}

Field field(Symmetry symmetry, double r, double z) {
  return symmetry == Symmetry::plane ? plane_field(r, z) : axisymmetric_field(r, z);
}

/// Body force per mass at the points' places; displacements are small, so it may follow them.
class BodyForce final : public mpm::PointForce {
 public:
  BodyForce(Symmetry symmetry, double amplitude) : symmetry_(symmetry), amplitude_(amplitude) {}
  void add(const mpm::ForceBlock& block) const override {
    const mpm::Particles& q = block.particles;
    for (std::size_t p = 0; p < block.count; ++p) {
      const std::size_t i = block.begin + p;
      const Pair b = field(symmetry_, q.r[i], q.z[i]).force;
      const double factor = q.mass[i] / kDensity * kShear * amplitude_;
      block.loads.add(p, factor * b.r, factor * b.z);
    }
  }

 private:
  Symmetry symmetry_;
  double amplitude_;
};

/// Sums over the points at the start.
struct Scale {
  double largest = 0.0;  ///< of |u|
  double energy = 0.0;   ///< of b u/2, over G: elastic, of the exact solution
  double square = 0.0;   ///< of u^2
};

Scale scale_of(const mpm::Particles& q, Symmetry symmetry) {
  Scale scale;
  for (std::size_t i = 0; i < q.count; ++i) {
    const Field at = field(symmetry, q.r[i], q.z[i]);
    const double volume = q.solid_volume[i];
    const double square = at.displacement.r * at.displacement.r + at.displacement.z * at.displacement.z;
    scale.largest = std::max(scale.largest, std::sqrt(square));
    scale.square += volume * square;
    scale.energy += 0.5 * volume * (at.force.r * at.displacement.r + at.force.z * at.displacement.z);
  }
  return scale;
}

/// The places of the start are those of the lattice next to where points are now: the engine reorders them.
BoxDeflection compare(const mpm::Particles& q, const ClosedBox& box, double amplitude, const Scale& scale) {
  const double spacing = 0.5 / box.cells;
  const auto start = [spacing](double x) { return (std::floor(x / spacing) + 0.5) * spacing; };
  BoxDeflection result{};
  double product = 0.0;
  double difference = 0.0;
  double kinetic = 0.0;
  for (std::size_t i = 0; i < q.count; ++i) {
    const Pair at{start(q.r[i]), start(q.z[i])};
    const Pair exact = field(box.symmetry, at.r, at.z).displacement;
    const double u_r = (q.r[i] - at.r) / amplitude;
    const double u_z = (q.z[i] - at.z) / amplitude;
    const double volume = q.mass[i] / kDensity;
    product += volume * (u_r * exact.r + u_z * exact.z);
    difference += volume * ((u_r - exact.r) * (u_r - exact.r) + (u_z - exact.z) * (u_z - exact.z));
    kinetic += 0.5 * q.mass[i] * (q.velocity_r[i] * q.velocity_r[i] + q.velocity_z[i] * q.velocity_z[i]);
  }
  result.amplitude = product / scale.square;
  result.error = std::sqrt(difference / scale.square);
  result.kinetic = kinetic / (scale.energy * kShear * amplitude * amplitude);
  return result;
}

std::string name_of(Symmetry symmetry) {
  return symmetry == Symmetry::plane ? "plane" : "axisymmetric";
}

}  // namespace

BoxDeflection bend(const ClosedBox& box) {
  const double h = 1.0 / box.cells;
  const Side left = box.symmetry == Symmetry::plane ? Side::fixed : Side::symmetric;
  mpm::EngineSettings settings;
  settings.symmetry = box.symmetry;
  settings.gravity = 0.0;
  mpm::Engine engine(mpm::Grid(h, 1.0, 1.0, {left, Side::fixed, Side::fixed, Side::fixed}), settings);
  mpm::Body body;
  body.particles = regular_points(1.0, 1.0, 0.5 * h, box.symmetry, kDensity);
  body.material = std::make_unique<mpm::ViscoplasticMaterial>(
      mpm::ViscoplasticMaterial::Constants{box.bulk_ratio * kShear, kShear});
  body.density = kDensity;
  body.averaged = box.averaged;
  const Scale scale = scale_of(body.particles, box.symmetry);
  const double amplitude = kDeflection / scale.largest;
  engine.add(std::move(body));
  // Rayleigh's quotient of the exact field; twice its frequency damps it critically, stiffer answers less
  const double frequency = std::sqrt(2.0 * scale.energy / scale.square * kShear / kDensity);
  engine.add(std::make_unique<BodyForce>(box.symmetry, amplitude));
  engine.add(std::make_unique<Drag>(2.0 * frequency));
  const double end = kDecayTimes / frequency;
  while (engine.time() < end) {
    if (engine.step(end)) return {0.0, 1.0, 1.0};
  }
  return compare(engine.bodies().front().particles, box, amplitude, scale);
}

Section locking_section() {
  Section section{
      "Locking",
      "An elastic body fills a rough box of 1 m; a body force bends it into a curl, u = curl(psi), which no "
      "bulk modulus resists, so the exact answer does not depend on K/G. 'Amplitude' is the projection on "
      "it, "
      "'error' the norm of the difference; 2 by 2 points a cell. Without averages (off) the points' four "
      "constraints a cell leave the two unknowns a node no freedom as K grows.",
      {}};
  for (const Symmetry symmetry : {Symmetry::plane, Symmetry::axisymmetric}) {
    SectionTable table{{"cells, " + name_of(symmetry), "K/G", "amplitude", "error", "amplitude, off",
                        "error, off", "E_kin over elastic"},
                       {}};
    for (const int cells : {8, 16, 32}) {
      for (const double ratio : {1e1, 1e2, 1e3, 1e4, 1e5}) {
        const BoxDeflection on = bend({symmetry, cells, ratio, true});
        const BoxDeflection off = bend({symmetry, cells, ratio, false});
        table.rows.push_back({fmt::format("{}", cells), fmt::format("{:.0e}", ratio),
                              fmt::format("{:.4f}", on.amplitude), fmt::format("{:.4f}", on.error),
                              fmt::format("{:.4f}", off.amplitude), fmt::format("{:.4f}", off.error),
                              fmt::format("{:.0e}", std::max(on.kinetic, off.kinetic))});
      }
    }
    section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace isotach::bench
