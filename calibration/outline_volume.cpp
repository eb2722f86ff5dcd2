// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/outline_volume.hpp"

#include <cmath>
#include <numbers>

namespace isotach::calibration {

namespace {

double fill_volume(const datasets::SlumpTest& test) {
  const double radius = 0.5 * test.setup.mould.diameter;
  return std::numbers::pi * radius * radius * test.setup.mould.fill_height;
}

/// Read from above the base, an outline is as wide down to it.
mpm::Outline down_to_base(const datasets::Outline& outline) {
  mpm::Outline whole{outline.time, {}};
  const datasets::OutlinePoint& first = outline.points.front();
  if (first.z > 0.0) whole.points.push_back({first.r, 0.0});
  for (const datasets::OutlinePoint& point : outline.points) whole.points.push_back({point.r, point.z});
  return whole;
}

/// Of the body of revolution, without its base (m2).
double surface(const mpm::Outline& outline) {
  double sum = 0.0;
  for (std::size_t k = 1; k < outline.points.size(); ++k) {
    const mpm::OutlinePoint& a = outline.points[k - 1];
    const mpm::OutlinePoint& b = outline.points[k];
    sum += std::numbers::pi * (a.r + b.r) * std::hypot(b.r - a.r, b.z - a.z);
  }
  return sum;
}

}  // namespace

double volume_excess(const datasets::SlumpTest& test, const datasets::Outline& outline) {
  return down_to_base(outline).volume() / fill_volume(test) - 1.0;
}

double volume_excess(const datasets::SlumpTest& test) {
  double sum = 0.0;
  for (const datasets::Outline& outline : test.outlines) sum += volume_excess(test, outline);
  return sum / static_cast<double>(test.outlines.size());
}

double offset_by_volume(const datasets::SlumpTest& test, const datasets::Outline& outline) {
  const mpm::Outline whole = down_to_base(outline);
  return (whole.volume() - fill_volume(test)) / surface(whole);
}

Eigen::VectorXd direction_of_volume(
    const std::vector<std::shared_ptr<const experiments::SlumpExperiment>>& tests) {
  experiments::Values all;
  for (const auto& test : tests) {
    experiments::Values by_outline;
    for (const datasets::Outline& outline : test->test().outlines) {
      by_outline.push_back(-offset_by_volume(test->test(), outline));
    }
    experiments::Values offsets;
    for (const std::size_t outline : test->outline_index()) offsets.push_back(by_outline[outline]);
    const experiments::Values seen = test->decorrelated(offsets);
    all.insert(all.end(), seen.begin(), seen.end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace isotach::calibration
