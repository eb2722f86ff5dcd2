// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/outline_stations.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::experiments {

namespace {

/// Arc length at each point from the first.
template <class Points>
std::vector<double> arc_lengths(const Points& points) {
  std::vector<double> lengths;
  lengths.reserve(points.size());
  double length = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) length += std::hypot(points[i].r - points[i - 1].r, points[i].z - points[i - 1].z);
    lengths.push_back(length);
  }
  return lengths;
}

}  // namespace

std::vector<OutlineStation> outline_stations(const std::vector<datasets::Outline>& outlines, double spacing) {
  std::vector<OutlineStation> stations;
  std::size_t first = 0;
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const std::vector<double> arcs = arc_lengths(outlines[k].points);
    const double whole = arcs.empty() ? 0.0 : arcs.back();
    const double count = std::max(1.0, std::round(whole / spacing));
    double last = -1.0;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const double stretch = whole > 0.0 ? std::min(count - 1.0, std::floor(arcs[i] / whole * count)) : 0.0;
      if (stretch != last) {
        stations.push_back({k, outlines[k].time, (stretch + 0.5) / count, {}});
        last = stretch;
      }
      stations.back().points.push_back(first + i);
    }
    first += arcs.size();
  }
  return stations;
}

std::vector<double> station_means(std::span<const OutlineStation> stations, std::span<const double> values) {
  std::vector<double> means;
  means.reserve(stations.size());
  for (const OutlineStation& station : stations) {
    double sum = 0.0;
    for (const std::size_t i : station.points) sum += values[i];
    means.push_back(sum / static_cast<double>(station.points.size()));
  }
  return means;
}

std::vector<mpm::OutlinePoint> resampled(std::span<const mpm::OutlinePoint> polyline, std::size_t n) {
  const std::vector<double> arcs = arc_lengths(polyline);
  std::vector<mpm::OutlinePoint> points;
  std::size_t end = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const double arc = arcs.back() * static_cast<double>(k) / static_cast<double>(n - 1);
    while (end + 1 < arcs.size() && arcs[end] < arc) ++end;
    const double stretch = arcs[end] - arcs[end - 1];
    const double share = stretch > 0.0 ? std::clamp((arc - arcs[end - 1]) / stretch, 0.0, 1.0) : 0.0;
    const mpm::OutlinePoint& a = polyline[end - 1];
    const mpm::OutlinePoint& b = polyline[end];
    points.push_back({a.r + share * (b.r - a.r), a.z + share * (b.z - a.z)});
  }
  return points;
}

}  // namespace isotach::experiments
