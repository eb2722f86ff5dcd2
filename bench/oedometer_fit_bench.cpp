// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How long an oedometer fit takes: four parameters (e100, lambda, kappa, D_r by the gauge) to a synthetic CRS
// test of 600 rows, from the automatic start, noise and covariance included, on one thread.
//
//   oedometer_fit_bench [CSV]    prints the median of 21 fits; writes the test's rows for
//   compare_with_scipy.py
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

#include "bench/synthetic_oedometer.hpp"
#include "calibration/fit_oedometer.hpp"

namespace {

using namespace isotach;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void write_csv(const char* file, const datasets::OedometerTest& test) {
  std::FILE* const out = std::fopen(file, "w");
  if (out == nullptr) throw std::runtime_error(fmt::format("cannot write {}", file));
  fmt::print(
      out, "# void_ratio {:.12g} K0 {:.12g} stress_kPa {:.12g}\ntime_s,axial_strain,axial_stress_kPa,stage\n",
      test.void_ratio, test.initial_K0, 1e-3 * *test.initial_axial_stress);
  for (const auto& row : test.record.rows) {
    fmt::print(out, "{:.10g},{:.12g},{:.10g},{}\n", row.time, row.axial_strain, 1e-3 * row.axial_stress,
               datasets::name_of(row.stage));
  }
  std::fclose(out);
}

}  // namespace

int main(int argc, char** argv) {
  std::mt19937_64 random(7);
  const model::Parameters<double> truth = bench::random_parameters(random);
  datasets::OedometerTest test = bench::exact_test(bench::Protocol::crs_steps, truth, 1.5, 2.72);
  bench::add_noise(test, 0.01, 0.0, random);
  test.name = "synthetic";
  if (argc > 1) write_csv(argv[1], test);
  // what is not fitted is known
  model::ParameterValues<double> values = bench::random_parameters(random).values();
  for (const auto id : {model::ParameterId::I_v, model::ParameterId::C_1}) values[id] = truth[id];
  datasets::Study study{"synthetic", {}, *model::Parameters<double>::create(values), {}, {}, {test}, {}, {}};
  calibration::OedometerFitOptions options;
  options.depth = calibration::Depth::answer;
  std::vector<double> seconds;
  tl::expected<calibration::OedometerFit, calibration::FitFailure> fit;
  for (int i = 0; i < 21; ++i) {
    const double begin = now();
    fit = calibration::fit_oedometer(study, study.material, study.fit.oedometer, options);
    seconds.push_back(now() - begin);
    if (!fit) {
      fmt::print(stderr, "{}\n", fit.error().message);
      return 1;
    }
  }
  std::sort(seconds.begin(), seconds.end());
  fmt::print("rows {}  median_ms {:.2f}  least_ms {:.2f}  evaluations {}\n", test.record.rows.size(),
             1e3 * seconds[seconds.size() / 2], 1e3 * seconds.front(), fit->result.main.evaluations);
  fmt::print(
      "truth lambda {:.6g} kappa {:.6g} phi_c_deg {:.6g} I_v {:.6g} C_1 {:.6g} reference_rate {:.8g}\n",
      truth.lambda(), truth.kappa(), truth.phi_c() * 57.29577951308232, truth.I_v(), truth.C_1(),
      fit->reference_rate);
  for (const auto& estimate : fit->result.estimates) {
    if (estimate.verdict == calibration::Verdict::fixed) continue;
    fmt::print("fit_{} {:.8g} +- {:.3g}\n", model::info(estimate.id).name, estimate.value,
               estimate.std_error);
  }
}
