// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/start_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/law.hpp"

namespace isotach::calibration {

namespace {

constexpr double kLargestKappaShare = 0.5;  // of lambda

std::optional<double> median_if_any(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  return median(values);
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

StartValue read_lambda(const std::vector<Constructions>& tests) {
  std::vector<double> slopes;
  std::string why;
  for (const Constructions& test : tests) {
    if (test.virgin) {
      slopes.push_back(-test.virgin->line.slope);
    } else {
      why = test.virgin.error();
    }
  }
  if (slopes.empty()) return {std::nullopt, "no virgin compression line: " + (why.empty() ? "no test" : why)};
  return {median_if_any(slopes), "slope of " + counted(slopes.size(), "virgin compression line",
                                                       "virgin compression lines (median)")};
}

StartValue read_kappa(const std::vector<Constructions>& tests, std::optional<double> lambda, double phi_c,
                      double K0) {
  std::vector<double> slopes;
  for (const Constructions& test : tests) {
    for (const Line& line : test.swelling) {
      slopes.push_back(isotropic_swelling_index(-line.slope, phi_c, K0));
    }
  }
  const auto read = median_if_any(slopes);
  if (!read) return {std::nullopt, "no unloading branch to draw a swelling line through"};
  std::string source = "slope of " + counted(slopes.size(), "swelling line", "swelling lines (median)") +
                       fmt::format(", made isotropic at K0 = {:.3g}", K0);
  if (lambda && *read > kLargestKappaShare * *lambda) {
    return {kLargestKappaShare * *lambda,
            source + fmt::format("; that is {:.3g}, too near to lambda to be swelling alone: half of lambda "
                                 "is taken",
                                 *read)};
  }
  return {read, source};
}

StartValue read_I_v(const std::vector<Constructions>& tests) {
  std::vector<double> jumps;
  std::vector<double> relaxations;
  std::vector<double> creeps;
  for (const Constructions& test : tests) {
    for (const RateStep& step : test.rate_steps) jumps.push_back(step.I_v);
    for (const TimeLine& line : test.relaxation) relaxations.push_back(line.slope);
    if (!test.virgin) continue;
    // the first steps of a test creep on the way to yield: less than virgin soil
    const double yield = test.becker ? test.becker->yield_stress : 0.0;
    for (const TimeLine& line : test.creep) {
      if (line.stress > yield) creeps.push_back(-line.slope / test.virgin->line.slope);
    }
  }
  if (const auto value = median_if_any(jumps)) {
    return {value, counted(jumps.size(), "jump of strain rate", "jumps of strain rate (median)") +
                       " in virgin compression: step of ln stress over step of ln rate"};
  }
  if (const auto value = median_if_any(relaxations)) {
    return {value, counted(relaxations.size(), "relaxation", "relaxations (median)") +
                       ": slope of ln stress against ln time"};
  }
  if (const auto value = median_if_any(creeps)) {
    return {value, counted(creeps.size(), "creep line", "creep lines (median)") +
                       ": slope of ln(1+e) against ln time over lambda"};
  }
  return {std::nullopt, "no jump of rate, relaxation or creep in virgin compression"};
}

/// -d ln(1+e)/dt on a test's virgin line (1/s); 0 where it is unknown.
double rate_on(const Constructions& test) {
  if (test.virgin->rate > 0.0) return test.virgin->rate;
  std::vector<double> rates;
  for (const TimeLine& line : test.creep) {
    if (line.stress >= test.virgin->line.from_stress * (1.0 - 1e-9)) {
      rates.push_back(line.slope / line.duration);
    }
  }
  return median_if_any(rates).value_or(0.0);
}

StartValue read_e100(const std::vector<Constructions>& tests, std::optional<double> I_v, double phi_c,
                     double K0, double reference_rate) {
  const double sine = std::sin(phi_c);
  const double M = 6.0 * sine / (3.0 - sine);
  // p_B+ over the axial stress: p = (1 + 2 K0)/3, q = 1 - K0 of it
  const double p = (1.0 + 2.0 * K0) / 3.0;
  const double equivalent = p + (1.0 - K0) * (1.0 - K0) / (M * M * p);
  const double log_stress = std::log(model::Law<double>::kReferencePressure / equivalent);
  std::vector<double> values;
  std::size_t moved = 0;
  for (const Constructions& test : tests) {
    if (!test.virgin) continue;
    const double rate = rate_on(test);
    double shift = 0.0;
    if (I_v && rate > 0.0) {
      shift = *I_v * std::log(reference_rate / rate);
      ++moved;
    }
    const Line& line = test.virgin->line;
    values.push_back(std::expm1(line.intercept + line.slope * (log_stress - shift)));
  }
  const auto value = median_if_any(values);
  if (!value) return {std::nullopt, "no virgin compression line"};
  if (!(*value > 0.0)) {
    return {std::nullopt, fmt::format("the virgin line has the void ratio {:.3g} at 100 kPa", *value)};
  }
  std::string source = counted(values.size(), "virgin line", "virgin lines (median)") +
                       fmt::format(" at the axial stress of {:.4g} kPa, where p_B+ = 100 kPa at K0 = {:.3g}",
                                   1e-3 * std::exp(log_stress), K0);
  if (moved == values.size()) {
    source += ", moved to the reference rate";
  } else if (moved == 0) {
    source += ", at the test's own rate";
  } else {
    source += fmt::format(", {} of them moved to the reference rate", moved);
  }
  return {value, source};
}

}  // namespace

StartValues start_values(std::span<const std::vector<CurvePoint>> tests, double phi_c, double K0,
                         double reference_rate) {
  if (!(phi_c > 0.0 && phi_c < 0.5 * std::numbers::pi && K0 > 0.0 && K0 <= 1.0 && reference_rate > 0.0 &&
        std::isfinite(reference_rate))) {
    throw std::invalid_argument("start values need phi_c in (0, pi/2), K0 in (0, 1], a positive rate");
  }
  StartValues result;
  for (const std::vector<CurvePoint>& curve : tests) {
    result.tests.push_back({virgin_line(curve), swelling_lines(curve), casagrande_yield(curve),
                            becker_yield(curve), rate_steps(curve), relaxation_lines(curve),
                            creep_lines(curve)});
  }
  result.lambda = read_lambda(result.tests);
  result.kappa = read_kappa(result.tests, result.lambda.value, phi_c, K0);
  result.I_v = read_I_v(result.tests);
  result.e100 = read_e100(result.tests, result.I_v.value, phi_c, K0, reference_rate);
  return result;
}

}  // namespace isotach::calibration
