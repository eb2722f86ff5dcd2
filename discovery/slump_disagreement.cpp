// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_disagreement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace isotach::discovery {

namespace {

constexpr double kToe = 0.25;  // shares of an outline's length, from the toe
constexpr double kFlank = 0.7;
constexpr std::size_t kNeighbours = 4;  // of the smoother, on either side

struct Sums {
  double squares = 0.0;
  double distance = 0.0;
  double count = 0.0;
};

void add_test(const experiments::SlumpExperiment& test, const mpm::SlumpResult& simulation,
              std::vector<SlumpDisagreement>& all) {
  const experiments::Values distances = test.distances(simulation);
  const experiments::Values scaled = test.in_noise(distances);
  const auto& outlines = test.test().outlines;
  std::vector<std::array<Sums, 3>> sums(outlines.size());
  std::vector<bool> gone(outlines.size());
  for (const experiments::OutlineStation& station : test.stations()) {
    Sums& sum = sums[station.outline][static_cast<std::size_t>(zone_of(station))];
    for (const std::size_t i : station.points) {
      sum.squares += scaled[i] * scaled[i];
      sum.distance += distances[i];
      sum.count += 1.0;
      gone[station.outline] = test.mould_gone()[i];
    }
  }
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    for (const Zone zone : {Zone::toe, Zone::flank, Zone::top}) {
      const Sums& sum = sums[k][static_cast<std::size_t>(zone)];
      if (sum.count == 0.0) continue;
      all.push_back({test.name(), test.held_out(), zone, !gone[k], k == 0 ? 0.0 : outlines[k - 1].time,
                     outlines[k].time, sum.distance / sum.count,
                     std::sqrt(std::max(0.0, sum.squares - sum.count))});
    }
  }
}

}  // namespace

std::string_view name_of(Zone zone) {
  switch (zone) {
    case Zone::toe:
      return "toe";
    case Zone::flank:
      return "flank";
    case Zone::top:
      return "top";
  }
  return "";
}

std::vector<SlumpDisagreement> slump_disagreement(const SlumpTests& tests,
                                                  const std::vector<mpm::SlumpResult>& simulations) {
  std::vector<SlumpDisagreement> all;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (!simulations[i].outlines.empty()) add_test(*tests[i], simulations[i], all);
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  return all;
}

Zone zone_of(const experiments::OutlineStation& station) {
  return station.place < kToe ? Zone::toe : station.place < kFlank ? Zone::flank : Zone::top;
}

std::vector<std::array<double, 3>> roots_by_zone(const experiments::SlumpExperiment& test,
                                                 const experiments::Values& of_stations) {
  std::vector<std::array<double, 3>> roots(test.test().outlines.size(), {0.0, 0.0, 0.0});
  for (std::size_t k = 0; k < of_stations.size(); ++k) {
    const experiments::OutlineStation& station = test.stations()[k];
    double& root = roots[station.outline][static_cast<std::size_t>(zone_of(station))];
    root = std::hypot(root, of_stations[k]);
  }
  return roots;
}

void rank_by_explanation(const SlumpTests& tests, const std::vector<mpm::SlumpResult>& base,
                         const std::vector<mpm::SlumpResult>& explanation,
                         std::vector<SlumpDisagreement>& places) {
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const experiments::SlumpExperiment& test = *tests[i];
    if (test.held_out()) continue;
    experiments::Values change = test.distances(base[i]);
    const experiments::Values with = test.distances(explanation[i]);
    std::transform(change.begin(), change.end(), with.begin(), change.begin(), std::minus<>());
    const auto roots = roots_by_zone(test, test.decorrelated(change));
    for (SlumpDisagreement& place : places) {
      if (place.test != test.name()) continue;
      const auto& outlines = test.test().outlines;
      const auto outline = std::find_if(outlines.begin(), outlines.end(),
                                        [&](const datasets::Outline& one) { return one.time == place.to; });
      place.explained =
          roots[static_cast<std::size_t>(outline - outlines.begin())][static_cast<std::size_t>(place.zone)];
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.explained > b.explained; });
}

double smoothed_outline_gap(const SlumpTests& tests, const std::vector<mpm::SlumpResult>& simulations) {
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (tests[t]->held_out()) continue;
    const experiments::Values d = tests[t]->distances(simulations[t]);
    const std::vector<std::size_t>& outline = tests[t]->outline_index();
    experiments::Values left(d.size());
    for (std::size_t k = 0; k < d.size(); ++k) {
      double sum = 0.0;
      double neighbours = 0.0;
      for (std::size_t j = k - std::min(k, kNeighbours); j < std::min(d.size(), k + kNeighbours + 1); ++j) {
        if (j == k || outline[j] != outline[k]) continue;
        sum += d[j];
        neighbours += 1.0;
      }
      left[k] = d[k] - (neighbours > 0.0 ? sum / neighbours : 0.0);
    }
    for (const double value : tests[t]->decorrelated(left)) {
      squares += value * value;
      count += 1.0;
    }
  }
  return std::sqrt(squares / count);
}

}  // namespace isotach::discovery
