// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Recovery study: synthetic oedometer tests with known parameters, fitted like any other; how often the 95 %
// intervals cover the truth, and whether what the data cannot hold is ever called identified.
//
//   recovery_study [tests a protocol] [seed] [threads]   prints a Markdown report
//
// Truth: the seed mud's constants, each times exp(u), u uniform so that factors lie within +-25 %. Data:
// CVODES at rtol 1e-12 through the protocol, so another integrator than the fit's; noise relative to stress
// of 0.5, 1 and 2 % (strain of loaded tests: 1e-4, 2e-4, 4e-4), half of the tests with first-order
// autocorrelation 0.6. The fits are told a noise of 1 % (2e-4), right for a third of them, and no
// autocorrelation; they start from the constructions on the data and a material that is off by up to 25 %
// itself.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <vector>

#include "bench/synthetic_oedometer.hpp"
#include "calibration/fit_oedometer.hpp"
#include "calibration/parallel.hpp"
#include "calibration/uncertainty.hpp"

namespace {

using namespace isotach;
using bench::Protocol;
using model::ParameterId;

constexpr std::array kProtocols{Protocol::crs_steps, Protocol::crs_single_rate, Protocol::incremental};
constexpr std::array kNames{"CRS, rate steps, unloading, relaxation", "CRS, one rate, no unloading",
                            "incremental loading with creep"};
constexpr std::array kNoise{0.005, 0.01, 0.02};
constexpr double kCorrelation = 0.6;

/// One quantity of one fit.
struct Outcome {
  std::string name;
  double z;  ///< (estimate - truth) in standard errors
  bool covered;
  bool identified;
  bool hopeless;  ///< the expected half width of the interval, at the truth, is twice what may be identified
};

struct Trial {
  Protocol protocol;
  double noise;
  bool correlated;
  std::vector<Outcome> outcomes;
  double rho = 0.0;
  double level_ratio = 0.0;  ///< estimated over true
  std::string failure;
};

/// Standard errors that a fit can have at best: at the truth, by the noise that was added.
Eigen::VectorXd expected_errors(const datasets::Study& study, const model::Parameters<double>& truth,
                                const calibration::OedometerFit& fit, double level, double rho) {
  const calibration::Experiments all(fit.experiments.begin(), fit.experiments.end());
  calibration::Problem problem(
      all, calibration::Parametrisation(truth, study.fit.oedometer, {}, fit.result.gauge, all), 1);
  calibration::ExperimentWeights weights;
  for (const auto& from : all.front()->channels()) {
    calibration::Channel channel;
    channel.residuals = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(from.values.size()));
    channel.jacobian.resize(channel.residuals.size(), 0);
    channel.inverse_stress = from.inverse_stress;
    channel.known_variance = from.known_variance;
    channel.chain_starts = from.chains;
    calibration::NoiseModel noise;
    noise.level = level;
    noise.rho = rho;
    weights.push_back({from.values, calibration::Whitening(noise, channel)});
  }
  problem.set_weights({weights});
  const auto uncertainty = calibration::estimate_uncertainty(problem, problem.parametrisation().start(),
                                                             calibration::Correlation::whitened);
  if (!uncertainty) throw std::runtime_error(uncertainty.error().message);
  Eigen::VectorXd errors = uncertainty->covariance.diagonal().cwiseSqrt();
  for (Eigen::Index k = 0; k < errors.size(); ++k) {
    if (uncertainty->in_null_direction(static_cast<std::size_t>(k))) errors[k] = HUGE_VAL;
  }
  return errors;
}

Trial run(Protocol protocol, double noise, bool correlated, bool gauged_fit, std::uint64_t seed) {
  Trial trial{protocol, noise, correlated, {}, 0.0, 0.0, {}};
  std::mt19937_64 random(seed);
  const model::Parameters<double> truth = bench::random_parameters(random);
  const double ocr = 1.2 + 0.8 * bench::uniform(random);
  datasets::OedometerTest test = bench::exact_test(protocol, truth, ocr);
  bench::add_noise(test, noise, correlated ? kCorrelation : 0.0, random);
  test.name = "synthetic";
  const bool strain_noise = protocol == Protocol::incremental;

  datasets::Study study{"synthetic", {}, bench::random_parameters(random), {}, {}, {}, {}, {}};
  study.fit.oedometer = {ParameterId::e100, ParameterId::lambda, ParameterId::kappa,
                         ParameterId::D_r,  ParameterId::I_v,    ParameterId::C_1};
  if (!gauged_fit) study.fit.gauge = datasets::Gauge::none;
  study.oedometer_tests.push_back(test);
  calibration::OedometerFitOptions options;
  options.depth = calibration::Depth::answer;
  const auto fit = calibration::fit_oedometer(study, study.material, study.fit.oedometer, options);
  if (!fit) {
    trial.failure = fit.error().message;
    return trial;
  }
  const auto& result = fit->result;
  trial.rho = fit->noise.channels.front().model.neighbours();
  trial.level_ratio =
      fit->noise.channels.front().model.level / (strain_noise ? bench::strain_noise(noise) : noise);

  // the truth in the fit's gauge: same predictions, D_r as the gauge has it
  model::ParameterValues<double> gauged = truth.values();
  if (result.gauged) {
    const auto steady = integrators::steady_oedometric(truth, fit->reference_rate);
    const double ratio = steady->viscous_rate / truth.D_r();
    gauged[ParameterId::e100] = (1.0 + truth.e100()) * std::pow(ratio, truth.lambda() * truth.I_v()) - 1.0;
    gauged[ParameterId::D_r] = steady->viscous_rate;
  }
  const Eigen::VectorXd expected =
      expected_errors(study, *model::Parameters<double>::create(gauged), *fit,
                      strain_noise ? bench::strain_noise(noise) : noise, correlated ? kCorrelation : 0.0);
  for (std::size_t k = 0; k < result.free.size(); ++k) {
    const ParameterId id = result.free[k];
    const auto& estimate = result.estimates[static_cast<std::size_t>(id)];
    const double true_value = gauged[id];
    const auto i = static_cast<Eigen::Index>(k);
    const double coordinate = result.coordinates[k].logarithmic ? std::log(true_value) : true_value;
    const double error = std::sqrt(result.uncertainty.covariance(i, i));
    Outcome outcome{};
    outcome.name = model::info(id).name;
    outcome.z = (result.main.coordinates[k] - coordinate) / error;
    outcome.covered = true_value >= estimate.ci95_lower && true_value <= estimate.ci95_upper;
    outcome.identified = estimate.verdict == calibration::Verdict::identified;
    const double half_width = 1.96 * expected[i] * (result.coordinates[k].logarithmic ? true_value : 1.0);
    outcome.hopeless = half_width > 2.0 * 0.25 * calibration::range_of(id, truth);
    if (result.uncertainty.in_null_direction(k)) outcome.z = 0.0;  // no error to measure by
    if (std::abs(outcome.z) > 4.5) {
      fmt::print(stderr,
                 "far off: {} z {:.1f} of {} (protocol {}, noise {}, seed {}): {:.5g} instead of {:.5g}; "
                 "cost {:.5g}\n",
                 outcome.name, outcome.z, error, static_cast<int>(protocol), noise, seed, estimate.value,
                 true_value, result.main.cost);
    }
    trial.outcomes.push_back(outcome);
  }
  return trial;
}

}  // namespace

int main(int argc, char** argv) {
  const int each = argc > 1 ? std::atoi(argv[1]) : 240;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const int threads = argc > 3 ? std::atoi(argv[3]) : 2;
  std::vector<Trial> trials(static_cast<std::size_t>(each) * kProtocols.size());
  calibration::parallel_for(trials.size(), threads, [&](std::size_t i) {
    const std::size_t n = i / kProtocols.size();
    // one fit in eight goes without a gauge: e100 and D_r must then never be called identified
    trials[i] = run(kProtocols[i % kProtocols.size()], kNoise[(n / 2) % kNoise.size()], n % 2 == 1, n % 8 < 7,
                    1'000'003 * seed + i);
  });

  struct Count {
    int fits = 0, identified = 0, covered = 0, covered_all = 0;
    double z2 = 0.0, z = 0.0;
  };
  const auto print = [&](const std::string& title, auto&& chosen) {
    std::map<std::string, Count> counts;
    for (const Trial& trial : trials) {
      if (!chosen(trial)) continue;
      for (const Outcome& outcome : trial.outcomes) {
        Count& count = counts[outcome.name];
        ++count.fits;
        count.covered_all += outcome.covered;
        if (!outcome.identified) continue;
        ++count.identified;
        count.covered += outcome.covered;
        count.z += outcome.z;
        count.z2 += outcome.z * outcome.z;
      }
    }
    fmt::print(
        "\n{}\n\n| parameter | fits | called identified | covered, of these | mean z | rms z | covered, of "
        "all |\n"
        "|---|---|---|---|---|---|---|\n",
        title);
    for (const auto& [name, c] : counts) {
      fmt::print("| {} | {} | {} | {} | {} | {} | {:.1f} % |\n", name, c.fits, c.identified,
                 c.identified > 0 ? fmt::format("{:.1f} %", 100.0 * c.covered / c.identified) : "-",
                 c.identified > 0 ? fmt::format("{:+.2f}", c.z / c.identified) : "-",
                 c.identified > 0 ? fmt::format("{:.2f}", std::sqrt(c.z2 / c.identified)) : "-",
                 100.0 * c.covered_all / c.fits);
    }
  };
  int failed = 0;
  int false_claims = 0;
  int hopeless = 0;
  for (const Trial& trial : trials) {
    failed += !trial.failure.empty();
    if (!trial.failure.empty()) fmt::print(stderr, "failed: {}\n", trial.failure);
    for (const Outcome& outcome : trial.outcomes) {
      hopeless += outcome.hopeless;
      if (outcome.identified && outcome.hopeless) ++false_claims;
    }
  }
  fmt::print(
      "{} tests, {} a protocol, seed {}; {} fits failed; called identified though hopeless: {} of {}\n",
      trials.size(), each, seed, failed, false_claims, hopeless);
  print("All protocols", [](const Trial&) { return true; });
  for (std::size_t p = 0; p < kProtocols.size(); ++p) {
    print(kNames[p], [&](const Trial& trial) { return trial.protocol == kProtocols[p]; });
  }
  for (const bool correlated : {false, true}) {
    print(correlated ? "Autocorrelated noise, all protocols" : "Independent noise, all protocols",
          [&](const Trial& trial) { return trial.correlated == correlated; });
  }
  for (const double noise : kNoise) {
    print(fmt::format("Noise {} %, all protocols", 100.0 * noise),
          [&](const Trial& trial) { return trial.noise == noise; });
  }
  for (const bool correlated : {false, true}) {
    double rho = 0.0;
    double level = 0.0;
    int count = 0;
    for (const Trial& trial : trials) {
      if (trial.correlated != correlated || !trial.failure.empty()) continue;
      rho += trial.rho;
      level += trial.level_ratio;
      ++count;
    }
    fmt::print("\nEstimated noise, {}: autocorrelation {:.3f} (true {}), level {:.3f} of the true one\n",
               correlated ? "autocorrelated" : "independent", rho / count, correlated ? kCorrelation : 0.0,
               level / count);
  }
  return failed == 0 && false_claims == 0 ? 0 : 1;
}
