// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/convergence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "verification/named_paths.hpp"
#include "verification/printed_variants.hpp"

namespace isotach::verification {

namespace {

using integrators::Method;

constexpr double kNoControl = 1e30;  // a relative tolerance that no substep misses
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kRosenbrockOrder = 5.0;

/// A general path without symmetry, strain-driven, C_1 = 0.1: strain 0.025 in one increment.
Path general_path() {
  constexpr double kRate = 1e-6;
  Vector6 strain_rate = principal_strain(kRate, -0.4 * kRate, 0.1 * kRate, 1.0).strain_rate;
  strain_rate[3] = 0.7 * kRate;
  strain_rate[5] = -0.2 * kRate;
  return {"general path",
          set_a(0.1),
          {principal_stress_kPa(100.0, 70.0, 80.0), 1.5},
          {integrators::strain_increment<double>(strain_rate, 0.02 / kRate)}};
}

double stress_error(const State& got, const State& expected) {
  return (got.stress - expected.stress).norm() / expected.stress.norm();
}

Path in_equal_increments(const Path& path, int n) {
  Path parts = path;
  Increment<double> part = path.increments.front();
  part.duration /= n;
  parts.increments.assign(static_cast<std::size_t>(n), part);
  return parts;
}

/// Equal steps of a one-step method: increments that are one step each, so many as `steps` says.
Convergence one_step_method(const Path& path, const State& exact, Method method, const char* meaning,
                            const std::vector<int>& steps, double order, double tolerance) {
  Convergence result{std::string(integrators::name(method)), meaning, {}, {}, {}, order, tolerance};
  for (const int n : steps) {
    const auto end = follow(in_equal_increments(path, n), options_of(method, kNoControl));
    if (!end) continue;
    result.step.push_back(driven_strain(path) / n);
    result.error.push_back(stress_error(end->state, exact));
  }
  result.order = fit_order(result.step, result.error);
  return result;
}

Convergence printed(const Path& path, const State& exact, PrintedSlips slips, const char* name,
                    const char* meaning) {
  Convergence result{name, meaning, {}, {}, {}, 0.0, 0.1};
  const Law law(path.parameters);
  for (int level = 0; level < 7; ++level) {
    const int n = 250 << level;
    const auto end = printed_fixed(law, path.start, path.increments.front(), n, slips);
    if (!end.finished) continue;
    result.step.push_back(driven_strain(path) / n);
    result.error.push_back(stress_error(end.state, exact));
  }
  result.order = fit_order(result.step, result.error);
  return result;
}

/// CVODE chooses order and steps: error over the mean step as its tolerance shrinks. No order is claimed.
Convergence multistep(const Path& path, const State& exact) {
  Convergence result{
      "cvode", "BDF of orders 1 to 5 in varying steps: error over the mean step", {}, {}, {}, kNone, kNone};
  for (int level = 0; level < 7; ++level) {
    const auto end = follow(path, options_of(Method::cvode, std::pow(10.0, -3.5 - level)));
    if (!end) continue;
    result.step.push_back(driven_strain(path) / static_cast<double>(end->statistics.accepted));
    result.error.push_back(stress_error(end->state, exact));
  }
  result.order = fit_order(result.step, result.error);
  return result;
}

void measure_estimates(ConvergenceStudy& study) {
  const Law law(study.path.parameters);
  for (int level = 0; level < 7; ++level) {
    Increment<double> substep = study.path.increments.front();
    substep.duration /= 500 << level;
    study.est_step.push_back(substep.strain_rate.norm() * substep.duration);
    study.est_correct.push_back(printed_fixed(law, study.path.start, substep, 1, {}).largest_EST);
    study.est_printed.push_back(
        printed_fixed(law, study.path.start, substep, 1, {.modified_euler = true}).largest_EST);
  }
  study.est_correct_order = fit_order(study.est_step, study.est_correct);
  study.est_printed_order = fit_order(study.est_step, study.est_printed);
}

void measure_slips(ConvergenceStudy& study, const State& exact) {
  struct Variant {
    const char* name;
    PrintedSlips slips;
    bool in_units;
  };
  const std::array<Variant, 5> variants{{{"corrected", {}, true},
                                         {"(5a) as printed", {.modified_euler = true}, false},
                                         {"rejection as printed", {.rejection = true}, false},
                                         {"(6b) as printed", {.step_size = true}, true},
                                         {"all three as printed", {true, true, true}, false}}};
  struct Unit {
    const char* name;
    double seconds;
  };
  const std::array<Unit, 3> units{{{"s", 1.0}, {"h", 3600.0}, {"day", 86400.0}}};
  const Law law(study.path.parameters);
  for (const Variant& variant : variants) {
    for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
      for (const Unit& unit : units) {
        if (unit.seconds != 1.0 && (!variant.in_units || tolerance != 1e-5)) continue;
        const auto end = printed_adaptive(law, study.path.start, study.path.increments.front(), tolerance,
                                          variant.slips, unit.seconds);
        study.slips.push_back({variant.name, tolerance, unit.name, achieved_error(end.state, exact),
                               end.advanced, end.accepted, end.rejected, end.finished});
      }
    }
  }
}

}  // namespace

ObservedOrder fit_order(const std::vector<double>& step, const std::vector<double>& error) {
  // Student's t at 97.5 %, 1 to 8 degrees of freedom
  constexpr std::array<double, 8> kStudent{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306};
  const std::size_t n = step.size();
  if (n < 3 || n != error.size() || n > kStudent.size() + 2) {
    throw std::invalid_argument("an order needs 3 to 10 pairs of step and error");
  }
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += std::log(step[i]) / static_cast<double>(n);
    mean_y += std::log(error[i]) / static_cast<double>(n);
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = std::log(step[i]) - mean_x;
    const double y = std::log(error[i]) - mean_y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double slope = xy / xx;
  const double variance = std::max(yy - slope * xy, 0.0) / static_cast<double>(n - 2) / xx;
  return {slope, kStudent[n - 3] * std::sqrt(variance)};
}

ConvergenceStudy convergence_study() {
  ConvergenceStudy study{general_path(), {}, {}, {}, {}, {}, {}, {}};
  const State exact = follow(study.path, options_of(Method::cvode, 1e-14)).value().state;
  study.schemes.push_back(one_step_method(study.path, exact, Method::fellin_ostermann,
                                          "extrapolated Euler, equal substeps",
                                          {250, 500, 1000, 2000, 4000, 8000, 16000}, 2.0, 0.1));
  study.schemes.push_back(one_step_method(study.path, exact, Method::rosenbrock,
                                          "linearly implicit, equal steps", {8, 12, 16, 24, 32, 48, 64},
                                          kRosenbrockOrder, 0.75));
  study.schemes.push_back(multistep(study.path, exact));
  study.schemes.push_back(printed(study.path, exact, {.modified_euler = true}, "(5a) as printed",
                                  "w of 1.5 tau, equal substeps"));
  study.schemes.push_back(
      printed(study.path, exact, {}, "(5a) corrected", "the same program without the slip"));
  study.schemes.back().expected = 2.0;
  measure_estimates(study);
  measure_slips(study, exact);
  return study;
}

std::vector<Check> checks_of(const ConvergenceStudy& study) {
  const char* const group = "convergence";
  std::vector<Check> checks;
  for (const Convergence& scheme : study.schemes) {
    if (std::isnan(scheme.expected)) continue;
    checks.push_back({group, "observed order", scheme.scheme, scheme.expected, scheme.order.order,
                      scheme.tolerance, scheme.meaning});
  }
  checks.push_back({group, "order of EST in the substep", "corrected", 2.0, study.est_correct_order.order,
                    0.1, "EST = |w - v| of one substep"});
  checks.push_back({group, "order of EST in the substep", "(5a) as printed", 1.0,
                    study.est_printed_order.order, 0.1, "EST = |w - v| of one substep"});
  for (const SlipRun& run : study.slips) {
    if (run.variant == "corrected" || run.variant == "(5a) as printed") {
      checks.push_back({group, "share of the increment that was advanced", run.variant,
                        run.variant == "corrected" ? 1.0 : 2.0, run.advanced, 1e-3,
                        "ln(1+e) against tr D dt"});
    }
  }
  return checks;
}

}  // namespace isotach::verification
