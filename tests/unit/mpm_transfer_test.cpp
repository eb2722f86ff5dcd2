// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The passes over points, in packs and stretches of a cell, against the sums written out point by point.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/transfer.hpp"

namespace isotach::mpm {
namespace {

constexpr double kCell = 0.004;  // m
constexpr std::size_t kColumns = 9;
constexpr std::size_t kRows = 7;
constexpr double kStep = 1e-4;     // s
constexpr double kGravity = 9.81;  // m/s2
constexpr double kTwoEta = 3.0;    // Pa s

/// A material that answers with numbers one can follow: pressures are reference pressures, and an update adds
/// what it was given to the stress.
class Echo final : public Material {
 public:
  void update(Particles& q, MaterialChunk& chunk, MaterialCount& count) const override {
    for (std::size_t p = 0; p < chunk.count; ++p) {
      for (std::size_t k = 0; k < 4; ++k) q.stress[k][chunk.begin + p] += chunk.strain_rate[k][p];
      q.omega[0][chunk.begin + p] = chunk.spin[p];
      chunk.total_pressure[p] = q.reference_pressure[chunk.begin + p];
    }
    count.substepped += static_cast<long>(chunk.count);
  }
  void total_pressure(const Particles& q, std::size_t begin, std::size_t count,
                      double* pressures) const override {
    for (std::size_t p = 0; p < count; ++p) pressures[p] = q.reference_pressure[begin + p];
  }
  [[nodiscard]] double wave_modulus(const Particles&, std::size_t) const override { return 1.0; }
};

/// A force that differs from point to point.
class Pull final : public PointForce {
 public:
  void add(const ForceBlock& block) const override {
    for (std::size_t p = 0; p < block.count; ++p) {
      block.loads.add(p, 2.0 * block.particles.r[block.begin + p], 1e-9 * block.stress_rr[p]);
    }
  }
};

/// Points in cells of which some hold many and some none, in no order.
Particles random_points(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Particles q;
  q.count = n;
  const std::size_t padded = Particles::padded(n, kBlock);
  q.for_each_array([&](mpm::PointArray& array) {
    array.resize(padded);
    for (double& x : array) x = unit(random);
  });
  for (std::size_t i = 0; i < padded; ++i) {
    // three points of the same cell now and then, as where points are sorted
    const bool near = i % 3 != 0;
    q.r[i] = near ? q.r[i - 1] : (0.5 + 0.499 * q.r[i]) * kColumns * kCell;
    q.z[i] = near ? q.z[i - 1] : (0.5 + 0.499 * q.z[i]) * kRows * kCell;
    q.mass[i] = i < n ? 1e-3 * (2.0 + q.mass[i]) : 0.0;
    q.solid_volume[i] = i < n ? 1e-7 * (2.0 + q.solid_volume[i]) : 0.0;
    q.void_ratio[i] += 3.0;
    q.reference_pressure[i] *= 1000.0;
    for (auto* tensor : {&q.stress, &q.resistance, &q.capillary}) {
      for (auto& component : *tensor) component[i] *= 500.0;
    }
  }
  return q;
}

Grid grid() {
  return {kCell, kColumns * kCell, kRows * kCell, {Side::open, Side::open, Side::open, Side::open}};
}

double spline(double x) {
  x = std::abs(x);
  if (x < 0.5) return 0.75 - x * x;
  return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0.0;
}
double hat(double x) {
  return std::max(0.0, 1.0 - std::abs(x));
}
/// Centre of node i, in cells.
double centre(std::size_t i) {
  return static_cast<double>(i) - 0.5;
}

double corner_average(const std::vector<double>& mean, const Grid& g, double r, double z) {
  double sum = 0.0;
  for (std::size_t j = 0; j <= kRows; ++j) {
    for (std::size_t i = 0; i <= kColumns; ++i) {
      sum += mean[g.index(i, j)] * hat(r / kCell - static_cast<double>(i)) *
             hat(z / kCell - static_cast<double>(j));
    }
  }
  return sum;
}

template <Symmetry S>
double hoop(const Particles& q, std::size_t i) {
  return S == Symmetry::axisymmetric ? q.grid_velocity_r[i] / q.r[i] : 0.0;
}

/// All nodes' sums by their definition.
template <Symmetry S>
std::vector<Octet> pushed(const Particles& q, const Grid& g, const std::vector<double>* mean, double scale) {
  std::vector<Octet> nodes(g.stride() * (kRows + 2), Octet{});
  for (std::size_t n = 0; n < q.count; ++n) {
    const double mean_stress = (q.stress[0][n] + q.stress[1][n] + q.stress[2][n]) / 3.0;
    const double pressure =
        mean != nullptr ? corner_average(*mean, g, q.r[n], q.z[n]) : q.reference_pressure[n];
    const double d_tt = hoop<S>(q, n);
    const double rate = (q.l_rr[n] + q.l_zz[n] + d_tt) / 3.0;
    const auto beside = [&](std::size_t k) { return q.resistance[k][n] + q.capillary[k][n]; };
    const double t_rr = q.stress[0][n] - mean_stress - pressure + kTwoEta * (q.l_rr[n] - rate) + beside(0);
    const double t_zz = q.stress[1][n] - mean_stress - pressure + kTwoEta * (q.l_zz[n] - rate) + beside(1);
    const double t_tt = q.stress[2][n] - mean_stress - pressure + kTwoEta * (d_tt - rate) + beside(2);
    const double t_rz =
        (q.stress[3][n] + beside(3)) / std::sqrt(2.0) + kTwoEta * 0.5 * (q.l_rz[n] + q.l_zr[n]);
    const double volume = q.volume(n);
    for (std::size_t j = 0; j < kRows + 2; ++j) {
      for (std::size_t i = 0; i < kColumns + 2; ++i) {
        const double dr = centre(i) * kCell - q.r[n];
        const double dz = centre(j) * kCell - q.z[n];
        const double w = spline(dr / kCell) * spline(dz / kCell);
        const double k = -volume * 4.0 / (kCell * kCell);
        Octet& node = nodes[g.index(i, j)];
        node[kMass] += w * q.mass[n];
        node[kMomentumR] += w * q.mass[n] * scale * (q.velocity_r[n] + q.c_rr[n] * dr + q.c_rz[n] * dz);
        node[kMomentumZ] += w * q.mass[n] * scale * (q.velocity_z[n] + q.c_zr[n] * dr + q.c_zz[n] * dz);
        node[kInternalR] += w * k * (t_rr * dr + t_rz * dz);
        node[kInternalZ] += w * k * (t_rz * dr + t_zz * dz);
        if (S == Symmetry::axisymmetric) node[kInternalR] -= w * volume * t_tt / q.r[n];
        node[kAppliedR] += w * 2.0 * q.r[n];
        node[kVolume] += w * volume;
        node[kAppliedZ] += w * (1e-9 * t_rr - q.mass[n] * kGravity);
      }
    }
  }
  return nodes;
}

std::vector<double> random_field(const Grid& g, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> field(g.stride() * (g.rows() + 2));
  for (double& x : field) x = 1000.0 * unit(random);
  return field;
}

template <Symmetry S>
void expect_push(bool averaged) {
  constexpr double kScale = 0.9;
  const Particles q = random_points(203, 11);
  const Grid g = grid();
  const std::vector<double> mean = random_field(g, 12);
  const Echo material;
  std::vector<std::unique_ptr<PointForce>> forces;
  forces.push_back(std::make_unique<Pull>());
  PushSettings settings;
  settings.dt = kStep;
  settings.gravity = kGravity;
  settings.two_eta = kTwoEta;
  settings.velocity_scale = kScale;
  settings.mean = averaged ? mean.data() : nullptr;
  settings.material = &material;
  settings.forces = &forces;
  NodeSums sums(g.stride(), kRows + 2);
  // in two shares, as two threads take them
  push_to_nodes<S>(q, 0, 2 * kBlock, g, settings, sums);
  push_to_nodes<S>(q, 2 * kBlock, q.count, g, settings, sums);
  const std::vector<Octet> expected = pushed<S>(q, g, averaged ? &mean : nullptr, kScale);
  Octet scale{};
  for (const Octet& node : expected) {
    for (std::size_t k = 0; k < kOctet; ++k) scale[k] = std::max(scale[k], std::abs(node[k]));
  }
  for (std::size_t n = 0; n < expected.size(); ++n) {
    for (std::size_t k = 0; k < kOctet; ++k) {
      EXPECT_NEAR(sums.data()[n][k], expected[n][k], 1e-12 * scale[k]) << "node " << n << ", entry " << k;
    }
  }
}

TEST(Transfer, PointsGiveTheNodesTheirSums) {
  expect_push<Symmetry::axisymmetric>(true);
  expect_push<Symmetry::axisymmetric>(false);
  expect_push<Symmetry::plane>(true);
  expect_push<Symmetry::plane>(false);
}

template <Symmetry S>
void expect_pull() {
  const Particles before = random_points(203, 21);
  Particles q = before;
  Grid g = grid();
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::size_t n = 0; n < g.stride() * (kRows + 2); ++n) {
    g.velocities()[n] = NodeVelocity{unit(random), unit(random), unit(random), unit(random)};
  }
  PullSettings settings;
  settings.dt = 1e-6;
  settings.velocity_scale = 0.9;
  settings.keep_velocity = 0.7;
  settings.keep_gradient = 0.4;
  RowSums<double> rates(g.stride(), kRows + 2);
  const PullResult result = pull_from_nodes<S>(q, 0, q.count, g, settings, &rates);
  EXPECT_FALSE(result.leaving.has_value());
  std::vector<double> expected_rates(g.stride() * (kRows + 2), 0.0);
  double fastest = 0.0;
  for (std::size_t n = 0; n < q.count; ++n) {
    NodeVelocity v{};
    NodeVelocity along_r{};
    NodeVelocity along_z{};
    for (std::size_t j = 0; j < kRows + 2; ++j) {
      for (std::size_t i = 0; i < kColumns + 2; ++i) {
        const double dr = centre(i) - q.r[n] / kCell;
        const double dz = centre(j) - q.z[n] / kCell;
        const NodeVelocity weighted = g.velocities()[g.index(i, j)] * (spline(dr) * spline(dz));
        v += weighted;
        along_r += weighted * (4.0 * dr / kCell);
        along_z += weighted * (4.0 * dz / kCell);
      }
    }
    EXPECT_NEAR(q.grid_velocity_r[n], v[0], 1e-13);
    EXPECT_NEAR(q.grid_velocity_z[n], v[1], 1e-13);
    EXPECT_NEAR(q.velocity_r[n], v[0] + 0.7 * (0.9 * before.velocity_r[n] - v[2]), 1e-13);
    EXPECT_NEAR(q.velocity_z[n], v[1] + 0.7 * (0.9 * before.velocity_z[n] - v[3]), 1e-13);
    constexpr double kRounding = 1e-10;  // gradients are of the order of 1000
    EXPECT_NEAR(q.l_rr[n], along_r[0], kRounding);
    EXPECT_NEAR(q.l_rz[n], along_z[0], kRounding);
    EXPECT_NEAR(q.l_zr[n], along_r[1], kRounding);
    EXPECT_NEAR(q.l_zz[n], along_z[1], kRounding);
    EXPECT_NEAR(q.c_rr[n], along_r[0] + 0.4 * (0.9 * before.c_rr[n] - along_r[2]), kRounding);
    // what is kept of the velocity is carried along by the grid's: its moment goes into the spin
    const double kept_r = 0.7 * (0.9 * before.velocity_r[n] - v[2]);
    const double kept_z = 0.7 * (0.9 * before.velocity_z[n] - v[3]);
    const double spin = 2.0 / (kCell * kCell) * settings.dt * (v[0] * kept_z - v[1] * kept_r);
    EXPECT_NEAR(q.c_rz[n], along_z[0] + 0.4 * (0.9 * before.c_rz[n] - along_z[2]) + spin, kRounding);
    EXPECT_NEAR(q.c_zr[n], along_r[1] + 0.4 * (0.9 * before.c_zr[n] - along_r[3]) - spin, kRounding);
    EXPECT_NEAR(q.c_zz[n], along_z[1] + 0.4 * (0.9 * before.c_zz[n] - along_z[3]), kRounding);
    EXPECT_EQ(q.r[n], before.r[n]) << "points move only once their stress is known";
    fastest = std::max(fastest, std::hypot(v[0], v[1]));
    const double divergence = along_r[0] + along_z[1] + hoop<S>(q, n);
    for (std::size_t j = 0; j <= kRows; ++j) {
      for (std::size_t i = 0; i <= kColumns; ++i) {
        expected_rates[g.index(i, j)] +=
            q.volume(n) * divergence * hat(q.r[n] / kCell - double(i)) * hat(q.z[n] / kCell - double(j));
      }
    }
  }
  EXPECT_NEAR(result.fastest, fastest, 1e-13);
  for (std::size_t n = 0; n < expected_rates.size(); ++n) {
    EXPECT_NEAR(rates.data()[n], expected_rates[n], 1e-15) << "corner " << n;
  }
}

TEST(Transfer, PointsTakeVelocityAndGradientFromTheNodes) {
  expect_pull<Symmetry::axisymmetric>();
  expect_pull<Symmetry::plane>();
}

TEST(Transfer, APointThatWouldLeaveTheGridOrIsNotFiniteIsFound) {
  for (const bool finite : {true, false}) {
    Particles q = random_points(150, 31);
    q.velocity_r.assign(q.velocity_r.size(), 0.0);
    q.velocity_z.assign(q.velocity_z.size(), 0.0);
    Grid g = grid();
    PullSettings settings;
    settings.dt = 1.0;
    settings.keep_velocity = 1.0;
    for (std::size_t n = 0; n < g.stride() * (kRows + 2); ++n) g.velocities()[n] = NodeVelocity{};
    EXPECT_FALSE(pull_from_nodes<Symmetry::plane>(q, 0, q.count, g, settings, nullptr).leaving.has_value());
    if (finite) {
      for (std::size_t n = 0; n < g.stride() * (kRows + 2); ++n) {
        g.velocities()[n] = NodeVelocity{0.0, -0.5 * kRows * kCell, 0.0, -0.5 * kRows * kCell};
      }
    } else {
      g.velocities()[g.index(4, 3)][1] = std::nan("");
    }
    const auto leaving = pull_from_nodes<Symmetry::plane>(q, 0, q.count, g, settings, nullptr).leaving;
    ASSERT_TRUE(leaving.has_value());
    std::size_t expected = 0;
    if (finite) {  // the first to be carried below the base
      while (q.z[expected] > 0.5 * kRows * kCell) ++expected;
    } else {  // the first to touch the node
      while (!(std::abs(q.r[expected] / kCell - 3.5) < 1.5 && std::abs(q.z[expected] / kCell - 2.5) < 1.5))
        ++expected;
    }
    EXPECT_EQ(*leaving, expected);
  }
}

template <Symmetry S>
void expect_update(bool averaged) {
  const Particles before = random_points(203, 41);
  Particles q = before;
  const Grid g = grid();
  const std::vector<double> mean = random_field(g, 42);
  const Echo material;
  RowSums<CornerSum> pressures(g.stride(), kRows + 2);
  MaterialCount count;
  constexpr double kShort = 1e-6;  // so that no point leaves
  update_points<S>(q, 0, q.count, g, {0.0, kShort}, averaged ? mean.data() : nullptr, material,
                   averaged ? &pressures : nullptr, count);
  EXPECT_EQ(count.substepped, 203);
  std::vector<CornerSum> expected(g.stride() * (kRows + 2), CornerSum{0.0, 0.0});
  for (std::size_t n = 0; n < q.count; ++n) {
    double d_rr = before.l_rr[n];
    double d_zz = before.l_zz[n];
    double d_tt = hoop<S>(before, n);
    if (averaged) {
      const double change = (corner_average(mean, g, before.r[n], before.z[n]) - d_rr - d_zz - d_tt) / 3.0;
      d_rr += change;
      d_zz += change;
      d_tt += change;
    }
    const double rounding = 1e-10;
    EXPECT_NEAR(q.stress[0][n] - before.stress[0][n], d_rr, rounding);
    EXPECT_NEAR(q.stress[1][n] - before.stress[1][n], d_zz, rounding);
    EXPECT_NEAR(q.stress[2][n] - before.stress[2][n], d_tt, rounding);
    EXPECT_NEAR(q.stress[3][n] - before.stress[3][n], (before.l_rz[n] + before.l_zr[n]) / std::sqrt(2.0),
                rounding);
    EXPECT_NEAR(q.omega[0][n], 0.5 * (before.l_rz[n] - before.l_zr[n]), 1e-15);
    EXPECT_NEAR(q.r[n], before.r[n] + kShort * before.grid_velocity_r[n], 1e-16);
    EXPECT_NEAR(q.z[n], before.z[n] + kShort * before.grid_velocity_z[n], 1e-16);
    for (std::size_t j = 0; j <= kRows; ++j) {
      for (std::size_t i = 0; i <= kColumns; ++i) {
        const double part = q.volume(n) * hat(q.r[n] / kCell - double(i)) * hat(q.z[n] / kCell - double(j));
        expected[g.index(i, j)] += CornerSum{part, part * q.reference_pressure[n]};
      }
    }
  }
  if (!averaged) return;
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_NEAR(pressures.data()[n].volume, expected[n].volume, 1e-18);
    EXPECT_NEAR(pressures.data()[n].moment, expected[n].moment, 1e-15);
  }
}

TEST(Transfer, MaterialsSeeTheAveragedRateAndGiveTheirPressureWhereThePointsHaveGone) {
  expect_update<Symmetry::axisymmetric>(true);
  expect_update<Symmetry::axisymmetric>(false);
  expect_update<Symmetry::plane>(true);
  expect_update<Symmetry::plane>(false);
}

// Force and rate are averaged by adjoint operators: what averaged pressures do in a motion is what the
// points' own pressures do under its averaged tr D, whatever the motion.
TEST(Transfer, AveragedPressureAndAveragedRateDoTheSameWork) {
  const Particles q = random_points(203, 51);
  const Grid g = grid();
  const Echo material;
  CornerField field(g.stride(), kRows + 2);
  push_pressure(q, 0, q.count, g, material, field.pressures);
  field.average_pressure(0, field.pressures.rows());
  const std::vector<double> mean_pressure(field.mean.data(), field.mean.data() + field.mean.size());
  std::mt19937 random(52);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> divergence(q.count);
  for (std::size_t n = 0; n < q.count; ++n) {
    divergence[n] = unit(random);
    for (std::size_t j = 0; j <= kRows; ++j) {
      field.rates.touch(j, kColumns + 1);
      for (std::size_t i = 0; i <= kColumns; ++i) {
        field.rates.data()[g.index(i, j)] +=
            q.volume(n) * divergence[n] * hat(q.r[n] / kCell - double(i)) * hat(q.z[n] / kCell - double(j));
      }
    }
  }
  field.average_rate(0, field.rates.rows());
  double by_pressure = 0.0;
  double by_rate = 0.0;
  double size = 0.0;
  for (std::size_t n = 0; n < q.count; ++n) {
    by_pressure += q.volume(n) * at_point(g, mean_pressure.data(), q.r[n], q.z[n]) * divergence[n];
    by_rate += q.volume(n) * q.reference_pressure[n] * at_point(g, field.mean.data(), q.r[n], q.z[n]);
    size += q.volume(n) * std::abs(q.reference_pressure[n] * divergence[n]);
  }
  EXPECT_NEAR(by_pressure, by_rate, 1e-13 * size);
  EXPECT_GT(std::abs(by_rate), 1e-4 * size);
}

}  // namespace
}  // namespace isotach::mpm
