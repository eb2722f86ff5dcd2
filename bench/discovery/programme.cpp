// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/programme.hpp"

#include <cmath>
#include <numbers>

#include "bench/synthetic_oedometer.hpp"
#include "integrators/steady_oedometric.hpp"
#include "model/law.hpp"

namespace isotach::bench {

namespace {

using datasets::Stage;

constexpr double kStartStress = 8e3;
constexpr double kPlaceholder = 50e3;
constexpr double kDay = 86400.0;

/// Writes rows as a test goes on.
class Rows {
 public:
  Rows(std::vector<datasets::OedometerRow>& rows, std::mt19937_64& random) : rows_(rows), random_(random) {
    swing_ = 1.0 + 1.5 * uniform(random);
    phase_ = 2.0 * std::numbers::pi * uniform(random);
  }

  void ramp(double to, double rate, int count) {
    const Stage stage = to > strain_ ? Stage::load : Stage::unload;
    const double duration = std::abs(to - strain_) / rate;
    for (int i = 1; i <= count; ++i) {
      const double share = jittered(i, count);
      add(time_ + share * duration, strain_ + share * (to - strain_), stage);
    }
    time_ += duration;
    strain_ = to;
  }
  /// Readings evenly over the logarithm of time, from a thousandth of the duration.
  void relax(double duration, int count) {
    for (int i = 1; i <= count; ++i) {
      add(time_ + duration * std::pow(1e-3, 1.0 - jittered(i, count)), strain_, Stage::relax);
    }
    time_ += duration;
  }

 private:
  /// i/count, moved by up to a third of the distance to its neighbours; the last one stays.
  double jittered(int i, int count) {
    const double moved = i == count ? 0.0 : (uniform(random_) - 0.5) * 2.0 / 3.0;
    return (i + moved) / count;
  }
  void add(double time, double strain, Stage stage) {
    const double temperature = 20.0 + swing_ * std::sin(2.0 * std::numbers::pi * time / kDay + phase_);
    rows_.push_back({rows_.size() + 2, time, strain, kPlaceholder, stage, {}, temperature, {}});
  }

  std::vector<datasets::OedometerRow>& rows_;
  std::mt19937_64& random_;
  double swing_ = 0.0;  // of the room (K)
  double phase_ = 0.0;
  double time_ = 0.0;
  double strain_ = 0.0;
};

datasets::OedometerTest specimen(const std::string& name, double height,
                                 const model::Parameters<double>& truth, std::mt19937_64& random) {
  const model::Law<double> law(truth);
  datasets::OedometerTest test{};
  test.name = name;
  test.record.file = "synthetic";
  test.height = height;
  test.diameter = 0.063;
  test.initial_K0 = integrators::steady_oedometric(truth, 1e-6)->K0;
  test.initial_axial_stress = kStartStress;
  model::State<double> state{model::Mandel<double>::Zero(), 0.0};
  state.stress[0] = -kStartStress;
  state.stress[1] = state.stress[2] = -test.initial_K0 * kStartStress;
  const double ocr = 1.2 + 0.6 * uniform(random);
  test.void_ratio = law.void_ratio_at(ocr * law.measures(state).equivalent_pressure);
  return test;
}

}  // namespace

std::string_view name_of(Programme programme) {
  return programme == Programme::poor ? "poor" : "rich";
}

std::vector<datasets::OedometerTest> blank_tests(Programme programme, const model::Parameters<double>& truth,
                                                 std::mt19937_64& random) {
  std::vector<datasets::OedometerTest> tests;
  const auto begin = [&](const std::string& name, double height) {
    tests.push_back(specimen(name, height, truth, random));
    return Rows(tests.back().record.rows, random);
  };
  if (programme == Programme::poor) {
    begin("single rate", 0.02).ramp(0.25, 2e-6, 120);
  } else {
    Rows low = begin("low", 0.02);
    low.ramp(0.06, 1e-6, 40);
    low.ramp(0.10, 1e-5, 25);
    low.ramp(0.14, 1e-6, 25);
    low.ramp(0.125, 2e-6, 20);
    low.ramp(0.18, 2e-6, 30);
    low.relax(6e4, 25);
    low.ramp(0.25, 1e-6, 30);
    Rows high = begin("high", 0.04);
    high.ramp(0.08, 5e-6, 35);
    high.relax(4e4, 25);
    high.ramp(0.13, 5e-7, 30);
    high.ramp(0.11, 5e-6, 25);
    high.ramp(0.17, 5e-6, 35);
    high.ramp(0.25, 2e-6, 30);
  }
  Rows other = begin("held out", 0.03);
  tests.back().hold_out = true;
  other.ramp(0.10, 3e-6, 35);
  other.ramp(0.085, 3e-6, 20);
  other.ramp(0.16, 3e-6, 35);
  other.relax(2e4, 20);
  other.ramp(0.22, 1e-5, 25);
  return tests;
}

}  // namespace isotach::bench
