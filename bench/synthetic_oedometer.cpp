// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/synthetic_oedometer.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "integrators/integrate.hpp"
#include "integrators/steady_oedometric.hpp"

namespace isotach::bench {

namespace {

using datasets::Stage;

constexpr double kStartStress = 10e3;
constexpr double kHeight = 0.02;

/// Within +-25 %.
double factor(std::mt19937_64& random) {
  return 0.75 + 0.5 * uniform(random);
}

}  // namespace

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1.0p-53;
}

model::Parameters<double> random_parameters(std::mt19937_64& random) {
  model::ParameterValues<double> values;
  values.values = {1.358 * factor(random), 0.154 * factor(random),  0.0129 * factor(random),
                   0.03 * factor(random),  6.8e-7 * factor(random), 14.2 * std::numbers::pi / 180.0,
                   0.05 * factor(random)};
  return *model::Parameters<double>::create(values);
}

namespace {

/// A row of the protocol to be run: either a strain or a stress, and when.
struct Target {
  double time;
  double strain;  ///< engineering; strain-controlled
  double stress;  ///< Pa; stress-controlled
  Stage stage;
  bool begins_step;
};

std::vector<Target> targets(Protocol protocol, double density) {
  std::vector<Target> rows;
  double time = 0.0;
  double strain = 0.0;
  const auto ramp = [&](double to, double rate, int rows_at_1, Stage stage) {
    const int count = static_cast<int>(density * rows_at_1);
    const double from = strain;
    const double begin = time;
    for (int i = 1; i <= count; ++i) {
      const double share = static_cast<double>(i) / count;
      time = begin + share * std::abs(to - from) / rate;
      rows.push_back({time, from + share * (to - from), 0.0, stage, false});
    }
    strain = to;
  };
  if (protocol == Protocol::crs_steps) {
    ramp(0.12, 1e-6, 60, Stage::load);
    ramp(0.18, 1e-5, 40, Stage::load);
    ramp(0.165, 2e-6, 30, Stage::unload);
    ramp(0.24, 2e-6, 50, Stage::load);
    const double begin = time;
    for (int i = 1; i <= 30; ++i) {
      time = begin + 10.0 * std::pow(1e4, i / 30.0);
      rows.push_back({time, strain, 0.0, Stage::relax, false});
    }
    ramp(0.28, 1e-6, 30, Stage::load);
  } else if (protocol == Protocol::crs_single_rate) {
    ramp(0.25, 2e-6, 200, Stage::load);
  } else {
    const std::array loads{20e3, 40e3, 80e3, 160e3, 80e3, 20e3, 80e3, 160e3, 320e3};
    double last = kStartStress;
    for (const double load : loads) {
      for (int i = 0; i < 24; ++i) {
        const double after = 60.0 * std::pow(1440.0, i / 23.0);
        rows.push_back({time + after, 0.0, load, load > last ? Stage::load : Stage::unload, i == 0});
      }
      time += 86400.0;
      last = load;
    }
  }
  return rows;
}

}  // namespace

datasets::OedometerTest exact_test(Protocol protocol, const model::Parameters<double>& truth, double ocr,
                                   double density) {
  const model::Law<double> law(truth);
  const auto steady = integrators::steady_oedometric(truth, 1e-6);
  const double K0 = steady->K0;
  model::State<double> state{model::Mandel<double>::Zero(), 0.0};
  state.stress[0] = -kStartStress;
  state.stress[1] = state.stress[2] = -K0 * kStartStress;
  state.void_ratio = law.void_ratio_at(ocr * law.measures(state).equivalent_pressure);
  const double e0 = state.void_ratio;

  datasets::OedometerTest test{};
  test.record.file = "synthetic";
  test.record.control =
      protocol == Protocol::incremental ? datasets::Control::stress : datasets::Control::strain;
  test.height = kHeight;
  test.void_ratio = e0;
  test.initial_K0 = K0;
  test.initial_axial_stress = kStartStress;
  test.end_of_primary.rule = datasets::EndOfPrimary::Rule::none;
  integrators::Options options;
  options.method = integrators::Method::cvode;
  options.cvode.relative = 1e-11;
  double time = 0.0;
  double height = 1.0;
  for (const Target& target : targets(protocol, density)) {
    const auto advance = [&](double duration, double stress) {
      integrators::Increment<double> increment;
      increment.duration = duration;
      if (test.record.control == datasets::Control::stress) {
        increment.stress_controlled[0] = true;
        increment.stress_rate[0] = (-stress - state.stress[0]) / duration;
      } else {
        increment.strain_rate[0] = std::log((1.0 - target.strain) / height) / duration;
      }
      const auto result = integrators::integrate(law, state, increment, options);
      if (!result) throw std::runtime_error(result.error().message());
      state = result->state;
      time += duration;
    };
    if (target.begins_step) {
      test.record.steps.push_back({time, target.stress, target.stage, test.record.rows.size(), 0});
      // the same short ramp as the fit's own protocol: a tenth of the time to the first reading
      advance(0.1 * (target.time - time), target.stress);
    }
    advance(target.time - time, target.stress);
    height = (1.0 + state.void_ratio) / (1.0 + e0);
    test.record.rows.push_back(
        {test.record.rows.size() + 2, time, 1.0 - height, -state.stress[0], target.stage, {}, {}, {}});
    if (!test.record.steps.empty()) ++test.record.steps.back().count;
  }
  return test;
}

void add_noise(datasets::OedometerTest& test, double level, double rho, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double error = normal(random);
  for (auto& row : test.record.rows) {
    if (test.record.control == datasets::Control::stress) {
      row.axial_strain += strain_noise(level) * error;
    } else {
      row.axial_stress *= std::exp(level * error);
    }
    error = rho * error + std::sqrt(1.0 - rho * rho) * normal(random);
  }
  test.noise = {0.01, 1.0, 1e-9};
  if (test.record.control == datasets::Control::stress) test.noise.strain = strain_noise(0.01);
}

}  // namespace isotach::bench
