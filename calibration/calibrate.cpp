// Copyright Isotach contributors. SPDX-License-Identifier: Apache-2.0
#include "calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace isotach::calibration {

namespace {

// Rounds stop when parameters move by less than simulations can tell.
constexpr double kStandingStill = 0.01;      // of ln I_v and of the other positive parameters
constexpr double kStandingStillC1 = 0.02;
constexpr int kFirstEvaluations = 30;
constexpr int kLaterEvaluations = 10;
constexpr double kLaterStep = 0.04;

double largest_move(const model::Parameters<double>& a, const model::Parameters<double>& b) {
  double largest = 0.0;
  for (const auto& parameter : model::kParameterTable) {
    const double before = a[parameter.id];
    const double after = b[parameter.id];
    const double move = parameter.id == model::ParameterId::C_1
                            ? std::abs(after - before) * (kStandingStill / kStandingStillC1)
                            : std::abs(std::log(after / before));
    largest = std::max(largest, move);
  }
  return largest;
}

bool contains(const std::vector<model::ParameterId>& list, model::ParameterId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

}  // namespace

tl::expected<Calibration, FitFailure> calibrate(const datasets::Study& study, const CalibrateOptions& options) {
  Calibration calibration;
  const auto report = [&](double fraction, const std::string& what) {
    if (options.progress) options.progress(fraction, what);
  };
  // what the slump determines is not the oedometer's to move any more
  std::vector<model::ParameterId> at_slump;
  for (const model::ParameterId id : study.fit.oedometer) {
    if (!contains(study.fit.slump, id)) at_slump.push_back(id);
  }

  OedometerFitOptions oedometer_options;
  oedometer_options.threads = options.threads;
  oedometer_options.control.stop = options.stop;
  report(0.0, "oedometer fit");
  auto first = fit_oedometer(study, study.material, study.fit.oedometer, oedometer_options);
  if (!first) return tl::unexpected(first.error());
  calibration.first_oedometer = *first;
  calibration.oedometer = std::move(*first);

  // expected work: the first round, one short round, uncertainty and comparison
  constexpr double kExpected = kFirstEvaluations + kLaterEvaluations + 8.0;
  double done = 0.0;
  for (int round = 0; round < options.max_rounds; ++round) {
    const bool is_first = round == 0;
    SlumpFitOptions slump_options;
    slump_options.threads = options.threads;
    slump_options.uncertainty = false;
    slump_options.control.stop = options.stop;
    if (is_first) {
      slump_options.max_evaluations = kFirstEvaluations;
    } else {
      slump_options.max_evaluations = kLaterEvaluations;
      slump_options.first_step = kLaterStep;
      slump_options.first_step_C_1 = kLaterStep;
    }
    slump_options.control.callback = [&](int evaluations, double cost) {
      report(std::min(0.95, (done + evaluations) / kExpected),
             fmt::format("slump fit, round {}, evaluation {}, cost {:.4g}", round + 1, evaluations, cost));
    };
    const model::Parameters<double> before = *calibration.oedometer.result.parameters;
    // the slump's own parameters start where the last round left them
    model::ParameterValues<double> start = before.values();
    if (!is_first) {
      for (const auto id : study.fit.slump) start[id] = calibration.rounds.back().after_slump[id];
    }
    const auto admissible = model::Parameters<double>::create(start);
    if (!admissible) return tl::unexpected(FitFailure{admissible.error().message()});
    auto slump = fit_slump(study, *admissible, slump_options);
    if (!slump) return tl::unexpected(slump.error());
    done += is_first ? kFirstEvaluations : kLaterEvaluations;
    calibration.rounds.push_back({before, *slump->result.parameters});
    calibration.slump = std::move(*slump);

    auto refit = fit_oedometer(study, calibration.rounds.back().after_slump, at_slump, oedometer_options);
    if (!refit) return tl::unexpected(refit.error());
    calibration.oedometer = std::move(*refit);
    const double oedometer_move =
        largest_move(calibration.rounds.back().after_slump, *calibration.oedometer.result.parameters);
    const double slump_move =
        is_first ? HUGE_VAL
                 : largest_move(calibration.rounds[calibration.rounds.size() - 2].after_slump,
                                calibration.rounds.back().after_slump);
    if (oedometer_move < kStandingStill && (slump_move < kStandingStill || is_first)) {
      calibration.settled = true;
      break;
    }
  }

  report(0.95, "uncertainty and comparison of all tests");
  SlumpFitOptions last;
  last.threads = options.threads;
  last.max_evaluations = 1;
  last.control.stop = options.stop;
  auto final_slump = fit_slump(study, *calibration.oedometer.result.parameters, last);
  if (!final_slump) return tl::unexpected(final_slump.error());
  // the search is that of the rounds; this call only measured its answer
  final_slump->result.main = calibration.slump.result.main;
  final_slump->result.warnings = calibration.slump.result.warnings;
  final_slump->simulations += calibration.slump.simulations;
  calibration.slump = std::move(*final_slump);
  report(1.0, "done");
  return calibration;
}

}  // namespace isotach::calibration
