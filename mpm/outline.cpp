// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "mpm/particles.hpp"

namespace isotach::mpm {

double Outline::height() const {
  double highest = 0.0;
  for (const OutlinePoint& point : points) highest = std::max(highest, point.z);
  return highest;
}

double Outline::toe() const {
  double largest = 0.0;
  for (const OutlinePoint& point : points) largest = std::max(largest, point.r);
  return largest;
}

double Outline::volume() const {
  // pi times the integral of r^2 dz along the outline, r linear between points
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double a = points[i - 1].r;
    const double b = points[i].r;
    sum += (a * a + a * b + b * b) / 3.0 * (points[i].z - points[i - 1].z);
  }
  return std::numbers::pi * sum;
}

namespace {

constexpr int kRefinement = 2;  // lattice points a cell
constexpr double kSurface = 0.5;

/// Volume fraction on a lattice of spacing `step` that includes the axis and the base.
class Fraction {
 public:
  Fraction(const Particles& particles, double cell_size) : step_(cell_size / kRefinement) {
    double r_max = 0.0;
    double z_max = 0.0;
    for (std::size_t i = 0; i < particles.count; ++i) {
      r_max = std::max(r_max, particles.r[i]);
      z_max = std::max(z_max, particles.z[i]);
    }
    columns_ = static_cast<int>((r_max + 2.0 * cell_size) / step_) + 2;
    rows_ = static_cast<int>((z_max + 2.0 * cell_size) / step_) + 2;
    values_.assign(static_cast<std::size_t>(columns_ * rows_), 0.0);
    for (std::size_t i = 0; i < particles.count; ++i) {
      const double area = particles.volume(i) / particles.r[i];
      for (const double r : {particles.r[i], -particles.r[i]}) {
        for (const double z : {particles.z[i], -particles.z[i]}) add(r, z, area, cell_size);
      }
    }
  }

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] double at(int k, int l) const { return values_[static_cast<std::size_t>(l * columns_ + k)]; }
  [[nodiscard]] bool inside(int k, int l) const { return at(k, l) >= kSurface; }

 private:
  // quadratic B-spline of width `cell_size`, integral 1
  static double kernel(double x, double cell_size) {
    const double s = std::abs(x) / cell_size;
    if (s < 0.5) return (0.75 - s * s) / cell_size;
    if (s < 1.5) return 0.5 * (1.5 - s) * (1.5 - s) / cell_size;
    return 0.0;
  }

  void add(double r, double z, double area, double cell_size) {
    const double reach = 1.5 * cell_size;
    const int k_first = std::max(0, static_cast<int>(std::ceil((r - reach) / step_)));
    const int k_last = std::min(columns_ - 1, static_cast<int>(std::floor((r + reach) / step_)));
    const int l_first = std::max(0, static_cast<int>(std::ceil((z - reach) / step_)));
    const int l_last = std::min(rows_ - 1, static_cast<int>(std::floor((z + reach) / step_)));
    for (int l = l_first; l <= l_last; ++l) {
      const double weight = area * kernel(z - l * step_, cell_size);
      for (int k = k_first; k <= k_last; ++k) {
        values_[static_cast<std::size_t>(l * columns_ + k)] += weight * kernel(r - k * step_, cell_size);
      }
    }
  }

  double step_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<double> values_;
};

/// Walks along the contour through the squares of the lattice, mud on the left hand.
class Walk {
 public:
  explicit Walk(const Fraction& fraction) : fraction_(fraction) {}

  /// The contour from the crossing of the base between columns k and k + 1 (inside and outside) to where it
  /// leaves the lattice; `reached_axis` tells whether that is the axis.
  std::vector<OutlinePoint> from_base(int k, bool& reached_axis) const {
    std::vector<OutlinePoint> points;
    // Sides of square (k, l): 0 bottom, 1 right, 2 top, 3 left. Corners: (k,l), (k+1,l), (k+1,l+1), (k,l+1).
    int l = 0;
    int side = 0;
    reached_axis = false;
    const int limit = 4 * fraction_.columns() * fraction_.rows();
    for (int step = 0; step < limit; ++step) {
      points.push_back(crossing(k, l, side));
      const int out = leave(k, l, side);
      if (out < 0) break;
      if (out == 0 && l == 0) {
        points.push_back(crossing(k, l, out));
        break;
      }
      if (out == 3 && k == 0) {
        points.push_back(crossing(k, l, out));
        reached_axis = true;
        break;
      }
      constexpr std::array<int, 4> kStepK{0, 1, 0, -1};
      constexpr std::array<int, 4> kStepL{-1, 0, 1, 0};
      k += kStepK[static_cast<std::size_t>(out)];
      l += kStepL[static_cast<std::size_t>(out)];
      if (k + 1 >= fraction_.columns() || l + 1 >= fraction_.rows()) break;
      side = (out + 2) % 4;
    }
    return points;
  }

 private:
  [[nodiscard]] std::array<int, 2> corner(int k, int l, int c) const {
    constexpr std::array<int, 4> kDk{0, 1, 1, 0};
    constexpr std::array<int, 4> kDl{0, 0, 1, 1};
    const auto i = static_cast<std::size_t>(c % 4);
    return {k + kDk[i], l + kDl[i]};
  }
  [[nodiscard]] bool inside(int k, int l, int c) const {
    const auto [a, b] = corner(k, l, c);
    return fraction_.inside(a, b);
  }
  [[nodiscard]] OutlinePoint crossing(int k, int l, int side) const {
    const auto [k0, l0] = corner(k, l, side);
    const auto [k1, l1] = corner(k, l, side + 1);
    const double f0 = fraction_.at(k0, l0);
    const double f1 = fraction_.at(k1, l1);
    const double x = (kSurface - f0) / (f1 - f0);
    const double h = fraction_.step();
    return {(k0 + x * (k1 - k0)) * h, (l0 + x * (l1 - l0)) * h};
  }
  // The side by which the contour that came in by `side` leaves; at a saddle it keeps the mud connected.
  // Coming in by `side` the mud is on the left: corner `side` is inside and corner `side + 1` outside.
  [[nodiscard]] int leave(int k, int l, int side) const {
    for (int turn = 1; turn <= 3; ++turn) {
      const int candidate = (side + turn) % 4;
      if (!inside(k, l, candidate) && inside(k, l, candidate + 1)) return candidate;
    }
    return -1;
  }

  const Fraction& fraction_;
};

}  // namespace

Outline trace_outline(const Particles& particles, double cell_size, double time) {
  const Fraction fraction(particles, cell_size);
  const Walk walk(fraction);
  Outline best{time, {}};
  for (int k = fraction.columns() - 2; k >= 0; --k) {
    if (!(fraction.inside(k, 0) && !fraction.inside(k + 1, 0))) continue;
    bool reached_axis = false;
    std::vector<OutlinePoint> points = walk.from_base(k, reached_axis);
    if (reached_axis) {
      best.points = std::move(points);
      return best;
    }
    if (points.size() > best.points.size()) best.points = std::move(points);
  }
  return best;
}

}  // namespace isotach::mpm
