// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/next_experiment.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace isotach::discovery {

namespace {

struct Variation {
  const char* words;
  double height;  ///< factor
  double time;    ///< factor: the same strains or loads, so much slower
};
constexpr Variation kVariations[] = {{"at twice the height", 2.0, 1.0},
                                     {"at half the height", 0.5, 1.0},
                                     {"ten times faster", 1.0, 0.1},
                                     {"ten times slower", 1.0, 10.0},
                                     {"at twice the height, ten times faster", 2.0, 0.1}};

datasets::OedometerTest varied(datasets::OedometerTest test, const Variation& variation) {
  test.height *= variation.height;
  const double begin = test.record.rows.empty() ? 0.0 : test.record.rows.front().time;
  for (datasets::OedometerRow& row : test.record.rows) row.time = begin + variation.time * (row.time - begin);
  return test;
}

/// Root of the sum of squared differences of two predictions over the noise.
std::optional<double> separation(const datasets::OedometerTest& test, const Candidate& a,
                                 const Candidate& b) {
  try {
    const experiments::OedometerExperiment with_a(test, a.fit.effects, {});
    const experiments::OedometerExperiment with_b(test, b.fit.effects, {});
    const auto one = with_a.predict(*a.fit.result.parameters, with_a.local_values());
    const auto other = with_b.predict(*b.fit.result.parameters, with_b.local_values());
    if (!one || !other) return std::nullopt;
    double sum = 0.0;
    for (std::size_t i = 0; i < one->size(); ++i) {
      sum += std::pow(((*one)[i] - (*other)[i]) / with_a.noise()[i], 2.0);
    }
    return std::sqrt(sum);
  } catch (const std::invalid_argument&) {  // a variation that is no test
    return std::nullopt;
  }
}

}  // namespace

std::optional<NextExperiment> tell_apart(const datasets::Study& study, const Candidate& a,
                                         const Candidate& b) {
  std::optional<NextExperiment> best;
  for (const datasets::OedometerTest& test : study.oedometer_tests) {
    if (test.hold_out) continue;
    const auto now = separation(test, a, b);
    for (const Variation& variation : kVariations) {
      const auto then = separation(varied(test, variation), a, b);
      if (!then || (best && *then <= best->separation)) continue;
      best = NextExperiment{test.name, variation.words, *then, now.value_or(std::nan(""))};
    }
  }
  return best;
}

}  // namespace isotach::discovery
