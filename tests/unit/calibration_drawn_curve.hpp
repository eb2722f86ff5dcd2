// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Compression curves of a soil that follows isotachs exactly, drawn stretch by stretch for tests.
#pragma once

#include <cmath>
#include <vector>

#include "calibration/compression_curve.hpp"

namespace isotach::calibration::tests {

/// Virgin compression ln sigma = ln sigma_1 - (ln(1+e) - y_1)/lambda + I_v ln(rate/rate_1); swelling along
/// kappa0; relaxation and creep as the isotachs say.
class DrawnCurve {
 public:
  double lambda = 0.15, kappa0 = 0.01, I_v = 0.03;
  double stress_1 = 1e5, y_1 = std::log(2.4), rate_1 = 1e-6;

  [[nodiscard]] const std::vector<CurvePoint>& points() const { return points_; }

  /// The stress of the isotach of a rate at ln(1+e) = y.
  [[nodiscard]] double isotach(double y, double rate) const {
    return stress_1 * std::exp(-(y - y_1) / lambda + I_v * std::log(rate / rate_1));
  }
  [[nodiscard]] double y_on_isotach(double stress, double rate) const {
    return y_1 - lambda * (std::log(stress / stress_1) - I_v * std::log(rate / rate_1));
  }

  /// Along the isotach of a rate up to a stress, in `count` equal steps of height (a constant speed).
  void compress(double to_stress, double rate, int count) {
    const double target = y_on_isotach(to_stress, rate);
    const double from = std::exp(y_);
    for (int i = 1; i <= count; ++i) {
      const double before = y_;
      y_ = std::log(from + (std::exp(target) - from) * i / count);
      add(time_ + (before - y_) / rate, isotach(y_, rate), datasets::Stage::load);
    }
  }
  /// Along a swelling line, at a rate, in equal steps of ln sigma.
  void swell(double to_stress, double rate, int count, datasets::Stage stage) {
    const double step = std::log(to_stress / points_.back().axial_stress) / count;
    for (int i = 0; i < count; ++i) {
      y_ -= kappa0 * step;
      add(time_ + kappa0 * std::abs(step) / rate, points_.back().axial_stress * std::exp(step), stage);
    }
  }
  /// sigma = sigma_0 (1 + t/offset)^-I_v at times that grow by a factor.
  void relax(double offset, double duration, int count) {
    const double begin = time_;
    const double stress = points_.back().axial_stress;
    for (int i = 1; i <= count; ++i) {
      const double t = duration * std::pow(1e-3, 1.0 - static_cast<double>(i) / count);
      add(begin + t, stress * std::pow(1.0 + t / offset, -I_v), datasets::Stage::relax);
    }
  }
  /// A load put on and left: ln(1+e) = y_0 - lambda I_v ln(1 + t/offset), y_0 at once.
  void step(double stress, double y_0, double offset, double duration, int count) {
    const double begin = points_.empty() ? 0.0 : time_ + 1.0;
    for (int i = 0; i <= count; ++i) {
      const double t = i == 0 ? 0.0 : duration * std::pow(1e-4, 1.0 - static_cast<double>(i) / count);
      y_ = y_0 - lambda * I_v * std::log1p(t / offset);
      add(begin + t, stress, datasets::Stage::load);
    }
  }
  void start(double y) { y_ = y; }
  void add(double time, double stress, datasets::Stage stage) {
    const bool first = points_.empty();
    const std::size_t segment = first ? 0 : points_.back().segment + (points_.back().stage == stage ? 0 : 1);
    points_.push_back({time, stress, std::expm1(y_), stage, segment});
    time_ = time;
  }

 private:
  std::vector<CurvePoint> points_;
  double y_ = 0.0;
  double time_ = 0.0;
};

}  // namespace isotach::calibration::tests
