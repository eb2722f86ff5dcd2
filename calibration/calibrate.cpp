// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace isotach::calibration {

namespace {

// Rounds stop when parameters move by less than simulations can tell.
constexpr double kStandingStill = 0.01;  // of ln I_v and of the other positive parameters
constexpr double kStandingStillFromZero = 0.02;
constexpr int kFirstEvaluations = 30;
constexpr int kLaterEvaluations = 10;
constexpr double kLaterStep = 0.04;

double largest_move(const model::Parameters<double>& a, const model::Parameters<double>& b) {
  double largest = 0.0;
  for (const auto& parameter : model::kParameterTable) {
    const double before = a[parameter.id];
    const double after = b[parameter.id];
    const double move = model::may_be_zero(parameter.id)
                            ? std::abs(after - before) * (kStandingStill / kStandingStillFromZero)
                            : std::abs(std::log(after / before));
    largest = std::max(largest, move);
  }
  return largest;
}

bool contains(const std::vector<model::ParameterId>& list, model::ParameterId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

/// `list` without what `drop` says.
template <class Drop>
std::vector<model::ParameterId> without(const std::vector<model::ParameterId>& list, Drop&& drop) {
  std::vector<model::ParameterId> kept;
  std::copy_if(list.begin(), list.end(), std::back_inserter(kept),
               [&](model::ParameterId id) { return !drop(id); });
  return kept;
}

/// What an oedometer fit says of I_v, if it moved I_v, holds it, and the slumps move it too.
std::optional<datasets::Prior> knowledge_of_I_v(const FitResult& oedometer,
                                                const std::vector<model::ParameterId>& slump_list) {
  using model::ParameterId;
  if (!contains(oedometer.free, ParameterId::I_v) || !contains(slump_list, ParameterId::I_v)) {
    return std::nullopt;
  }
  const ParameterEstimate& estimate = oedometer.estimates[static_cast<std::size_t>(ParameterId::I_v)];
  const bool held = estimate.verdict == Verdict::identified || estimate.verdict == Verdict::weak;
  if (!held || !(estimate.std_error > 0.0) || !std::isfinite(estimate.std_error)) return std::nullopt;
  return datasets::Prior{estimate.value, estimate.std_error};
}

}  // namespace

tl::expected<Calibration, FitFailure> calibrate(const datasets::Study& study,
                                                const CalibrateOptions& options) {
  using model::ParameterId;
  Calibration calibration;
  const std::vector<ParameterId>& slump_list = study.fit.slump;
  const std::vector<ParameterId> oedometer_list = without(study.fit.oedometer, [&](ParameterId id) {
    return id == ParameterId::I_v && contains(slump_list, id);
  });
  const std::vector<ParameterId> later_slump_list =
      without(slump_list, [&](ParameterId id) { return contains(oedometer_list, id); });

  // expected work in evaluations of the slump tests; the real number decides itself
  constexpr double kExpected = 120.0;
  constexpr double kReferenceSets = 9.0;  // four for the error of simulations, and one a correction
  const double reference = reference_cost(study);
  const double expected = kExpected + kReferenceSets * reference;
  double done = 0.0;
  const auto report = [&](double evaluations, const std::string& what) {
    if (options.progress) options.progress(std::min(0.97, (done + evaluations) / expected), what);
  };
  OedometerFitOptions oedometer_options;
  oedometer_options.threads = options.threads;
  oedometer_options.control.stop = options.stop;
  oedometer_options.depth = Depth::answer;
  SlumpFitOptions slump_options;
  slump_options.threads = options.slump_threads;
  slump_options.control.stop = options.stop;
  slump_options.simulate = options.simulate;

  report(0.0, "oedometer fit");
  auto first = fit_oedometer(study, study.material, study.fit.oedometer, oedometer_options);
  if (!first) return tl::unexpected(first.error());
  calibration.first_oedometer = *first;
  calibration.oedometer = std::move(*first);

  // the slumps alone
  slump_options.max_evaluations = kFirstEvaluations;
  slump_options.control.callback = [&](int evaluations, double cost) {
    report(evaluations, fmt::format("slump fit, evaluation {}, cost {:.4g}", evaluations, cost));
  };
  report(0.0, "slump fit: error of the simulations");
  done += 5.0 * reference;
  auto search = search_slump(study, *calibration.oedometer.result.parameters, slump_list, slump_options);
  if (!search) return tl::unexpected(search.error());
  SlumpSearch found = std::move(*search);
  done += found.search.evaluations;
  slump_options.simulation_error = found.simulation_error;
  slump_options.map = true;
  slump_options.stage = [&](SlumpFitStage stage) {
    report(0.0, fmt::format("slump fit: {}", name_of(stage)));
  };
  slump_options.control.callback = [&](int simulations, double) {
    report(simulations / static_cast<double>(study.slump_tests.size()),
           fmt::format("map of the slump fit, {} simulations", simulations));
  };
  auto alone = assess_slump(study, found, slump_list, slump_options);
  if (!alone) return tl::unexpected(alone.error());
  found.at = {*alone->result.parameters, alone->effects, alone->mud};  // the map may have led on
  mpm::RunCounts runs = alone->runs;                                   // the search's among them
  calibration.slump_alone = std::move(*alone);
  slump_options.map = false;
  slump_options.stage = nullptr;
  done += 2.0 * static_cast<double>(slump_list.size()) + 23.0;

  calibration.handed_on = knowledge_of_I_v(calibration.first_oedometer.result, slump_list);
  slump_options.priors[static_cast<std::size_t>(ParameterId::I_v)] = calibration.handed_on;
  slump_options.max_evaluations = kLaterEvaluations;
  slump_options.first_step = slump_options.first_step_C_1 = kLaterStep;
  for (int round = 1; round <= options.max_rounds && !calibration.settled; ++round) {
    const model::Parameters<double> before = *calibration.oedometer.result.parameters;
    if (round > 1 || calibration.handed_on) {
      if (later_slump_list.empty()) {
        calibration.settled = true;  // the oedometer moves all that the slump could
        break;
      }
      slump_options.control.callback = [&](int evaluations, double cost) {
        report(evaluations,
               fmt::format("slump fit, round {}, evaluation {}, cost {:.4g}", round, evaluations, cost));
      };
      done += reference;
      search = search_slump(study, before, later_slump_list, slump_options);
      if (!search) return tl::unexpected(search.error());
      done += search->search.evaluations;
      found = std::move(*search);
      runs += found.runs;
    }

    const model::Parameters<double> after = found.at.parameters;
    oedometer_options.start_from_data = false;  // the answer before is nearer
    auto refit = fit_oedometer(study, after, oedometer_list, oedometer_options);
    if (!refit) return tl::unexpected(refit.error());
    calibration.oedometer = std::move(*refit);
    const double oedometer_move = largest_move(before, *calibration.oedometer.result.parameters);
    calibration.rounds.push_back({before, after});
    calibration.settled = oedometer_move < kStandingStill;
  }

  report(0.0, "how far the oedometer fit can be trusted");
  oedometer_options.depth = Depth::assessment;
  auto assessed =
      fit_oedometer(study, *calibration.oedometer.result.parameters, oedometer_list, oedometer_options);
  if (!assessed) return tl::unexpected(assessed.error());
  calibration.oedometer = std::move(*assessed);

  report(0.0, "uncertainty and comparison of all tests");
  slump_options.control.callback = nullptr;
  found.at.parameters = *calibration.oedometer.result.parameters;
  found.runs = runs;
  const std::vector<ParameterId>& last_list = later_slump_list.empty() ? slump_list : later_slump_list;
  auto slump = assess_slump(study, found, last_list, slump_options);
  if (!slump) return tl::unexpected(slump.error());
  calibration.slump = std::move(*slump);
  JointFitOptions joint_options;
  joint_options.threads = options.slump_threads;
  joint_options.seed = study.fit.seed;
  joint_options.control.stop = options.stop;
  joint_options.simulate = options.simulate;
  joint_options.control.callback = [&](int simulations, double) {
    report(simulations / static_cast<double>(study.slump_tests.size()),
           fmt::format("joint fit, {} simulations", simulations));
  };
  auto joint = fit_jointly(study, calibration.first_oedometer, calibration.slump_alone, joint_options);
  if (joint) {
    calibration.joint = std::move(*joint);
  } else if (joint.error().interrupted) {
    return tl::unexpected(joint.error());
  } else {
    calibration.joint_failure = joint.error().message;
  }
  if (options.progress) options.progress(1.0, "done");
  return calibration;
}

}  // namespace isotach::calibration
