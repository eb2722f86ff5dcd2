// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_next.hpp"

#include <fmt/format.h>

#include <cmath>

#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"
#include "experiments/outline_distance.hpp"

namespace isotach::discovery {

namespace {

constexpr std::size_t kPlaces = 21;  // of an outline at which the two are compared: one in some 4 mm

struct Variation {
  std::string change;
  mpm::SlumpSetup setup;
};

std::vector<Variation> variations_of(const mpm::SlumpSetup& made) {
  std::vector<Variation> all{{"as it was made", made}};
  const auto add = [&](std::string change, auto&& alter) {
    mpm::SlumpSetup setup = made;
    alter(setup);
    all.push_back({std::move(change), std::move(setup)});
  };
  add("filled half as high", [](mpm::SlumpSetup& s) { s.mould.fill_height *= 0.5; });
  add("filled one and a half times as high", [](mpm::SlumpSetup& s) { s.mould.fill_height *= 1.5; });
  if (made.mould.lift_table.empty()) {
    add("lifted six times as fast", [](mpm::SlumpSetup& s) { s.mould.lift_speed *= 6.0; });
    add("lifted at a sixth of the speed", [](mpm::SlumpSetup& s) { s.mould.lift_speed /= 6.0; });
  }
  add("photographed to ten times as long", [](mpm::SlumpSetup& s) {
    s.times.push_back(3.0 * s.times.back());
    s.times.push_back(10.0 / 3.0 * s.times.back());
  });
  return all;
}

/// Root of the sum of squares of distances between two runs' outlines in units of noise.
double separation(const mpm::SlumpResult& a, const mpm::SlumpResult& b, double noise) {
  double squares = 0.0;
  for (std::size_t k = 0; k < a.outlines.size(); ++k) {
    for (const auto& point : experiments::resampled(a.outlines[k].points, kPlaces)) {
      const double d = experiments::signed_distance(point, b.outlines[k].points) / noise;
      squares += d * d;
    }
  }
  return std::sqrt(squares);
}

}  // namespace

std::optional<NextExperiment> tell_slumps_apart(const SlumpBasis& basis, const SlumpCandidate& a,
                                                const SlumpCandidate& b) {
  const datasets::SlumpTest* made = nullptr;
  for (const auto& test : basis.study.slump_tests) {
    if (!test.hold_out && made == nullptr) made = &test;
  }
  if (made == nullptr) return std::nullopt;
  const std::vector<Variation> variations = variations_of(made->setup);
  std::vector<std::optional<mpm::SlumpResult>> runs(2 * variations.size());
  calibration::parallel_for(runs.size(), basis.threads, [&](std::size_t i) {
    const SlumpCandidate& model = i % 2 == 0 ? a : b;
    auto run = basis.simulate(made->name, *model.parameters,
                              datasets::with_effects(variations[i / 2].setup, model.effects));
    if (run) runs[i] = std::move(*run);
  });
  std::optional<NextExperiment> best;
  double now = 0.0;
  for (std::size_t v = 0; v < variations.size(); ++v) {
    if (!runs[2 * v] || !runs[2 * v + 1]) continue;
    const double apart = separation(*runs[2 * v], *runs[2 * v + 1], made->noise.outline);
    if (v == 0) {
      now = apart;
    } else if (!best || apart > best->separation) {
      best = NextExperiment{made->name, variations[v].change, apart, 0.0};
    }
  }
  if (best) best->now = now;
  return best;
}

}  // namespace isotach::discovery
