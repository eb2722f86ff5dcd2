// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace isotach::calibration {

namespace {

using model::ParameterId;

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

bool contains(const std::vector<ParameterId>& list, ParameterId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

/// `list` without what `drop` says.
template <class Drop>
std::vector<ParameterId> without(const std::vector<ParameterId>& list, Drop&& drop) {
  std::vector<ParameterId> kept;
  std::copy_if(list.begin(), list.end(), std::back_inserter(kept), [&](ParameterId id) { return !drop(id); });
  return kept;
}

/// Whether an oedometer fit moved I_v and holds it.
bool holds_I_v(const FitResult& oedometer) {
  if (!contains(oedometer.free, ParameterId::I_v)) return false;
  const Verdict verdict = oedometer.estimates[static_cast<std::size_t>(ParameterId::I_v)].verdict;
  return verdict == Verdict::identified || verdict == Verdict::weak;
}

class Chain {
 public:
  Chain(const datasets::Study& study, const CalibrateOptions& options)
      : study_(study), options_(options), reference_(reference_cost(study)) {
    const std::vector<ParameterId>& slump_list = study.fit.slump;
    oedometer_list_ = without(study.fit.oedometer, [&](ParameterId id) {
      return id == ParameterId::I_v && contains(slump_list, id);
    });
    later_slump_list_ = without(slump_list, [&](ParameterId id) { return contains(oedometer_list_, id); });
    oedometer_.threads = options.threads;
    oedometer_.control.stop = options.stop;
    oedometer_.depth = Depth::answer;
    slump_.threads = options.slump_threads;
    slump_.control.stop = options.stop;
    slump_.simulate = options.simulate;
  }

  tl::expected<Calibration, FitFailure> run() && {
    for (const auto step : {&Chain::fit_oedometer_alone, &Chain::fit_slumps_alone, &Chain::fit_both,
                            &Chain::settle, &Chain::assess}) {
      if (auto failure = (this->*step)()) return tl::unexpected(std::move(*failure));
    }
    if (options_.progress) options_.progress(1.0, "done");
    return std::move(result_);
  }

 private:
  std::optional<FitFailure> fit_oedometer_alone() {
    report(0.0, "oedometer fit");
    auto fit = fit_oedometer(study_, study_.material, study_.fit.oedometer, oedometer_);
    if (!fit) return fit.error();
    result_.first_oedometer = *fit;
    result_.oedometer = std::move(*fit);
    oedometer_.start_from_data = false;  // from now on the answer before is nearer
    return std::nullopt;
  }

  std::optional<FitFailure> fit_slumps_alone() {
    slump_.max_evaluations = kFirstEvaluations;
    report(0.0, "slump fit: error of the simulations");
    done_ += 5.0 * reference_;
    if (auto failure = search(at_study(), study_.fit.slump, "slump fit")) return failure;
    slump_.simulation_error = found_->simulation_error;
    slump_.map = true;
    slump_.stage = [this](SlumpFitStage stage) { report(0.0, fmt::format("slump fit: {}", name_of(stage))); };
    slump_.control.callback = [this](int simulations, double) {
      report(sets_of(simulations), fmt::format("map of the slump fit, {} simulations", simulations));
    };
    auto alone = assess_slump(study_, *found_, study_.fit.slump, slump_);
    if (!alone) return alone.error();
    found_->at = {*alone->result.parameters, alone->effects, alone->mud};  // the map may have led on
    runs_ = alone->runs;                                                   // the search's among them
    result_.slump_alone = std::move(*alone);
    slump_.map = false;
    slump_.stage = nullptr;
    done_ += 2.0 * static_cast<double>(study_.fit.slump.size()) + 23.0;
    return std::nullopt;
  }

  std::optional<FitFailure> settle() {
    const bool both_move = contains(later_slump_list_, ParameterId::I_v);
    if (result_.joint && both_move && holds_I_v(result_.first_oedometer.result)) return take_joint_answer();
    return go_round();
  }

  /// The oedometer at the joint fit's I_v, and the slumps as they are there.
  std::optional<FitFailure> take_joint_answer() {
    const model::Parameters<double> before = *result_.oedometer.result.parameters;
    const model::Parameters<double> joint = *result_.joint->result.parameters;
    result_.I_v_is_joint = true;
    if (auto failure = refit_oedometer(joint)) return failure;
    result_.rounds.push_back({before, joint});
    result_.settled = largest_move(joint, *result_.oedometer.result.parameters) < kStandingStill;
    slump_.max_evaluations = 1;
    const SlumpPlace there{*result_.oedometer.result.parameters, found_->at.effects, found_->at.mud};
    if (auto failure = search(there, later_slump_list_, "slumps at the joint answer")) return failure;
    runs_ += found_->runs;
    found_->search.route = "joint fit";
    found_->search.termination = "the answer of the joint fit";
    found_->search.converged = true;
    found_->warnings.clear();
    return std::nullopt;
  }

  std::optional<FitFailure> refit_oedometer(const model::Parameters<double>& at) {
    auto refit = fit_oedometer(study_, at, oedometer_list_, oedometer_);
    if (!refit) return refit.error();
    result_.oedometer = std::move(*refit);
    return std::nullopt;
  }

  /// The two in turn until they stand still.
  std::optional<FitFailure> go_round() {
    slump_.max_evaluations = kLaterEvaluations;
    slump_.first_step = slump_.first_step_C_1 = kLaterStep;
    for (int round = 1; round <= options_.max_rounds && !result_.settled; ++round) {
      const model::Parameters<double> before = *result_.oedometer.result.parameters;
      if (round > 1) {  // in the first the slumps have just been fitted by themselves
        if (later_slump_list_.empty()) {
          result_.settled = true;  // the oedometer moves all that the slump could
          break;
        }
        done_ += reference_;
        const SlumpPlace start{before, found_->at.effects, found_->at.mud};
        if (auto failure = search(start, later_slump_list_, fmt::format("slump fit, round {}", round))) {
          return failure;
        }
        runs_ += found_->runs;
      }
      const model::Parameters<double> after = found_->at.parameters;
      if (auto failure = refit_oedometer(after)) return failure;
      result_.rounds.push_back({before, after});
      result_.settled = largest_move(before, *result_.oedometer.result.parameters) < kStandingStill;
    }
    return std::nullopt;
  }

  /// How far the answers can be trusted.
  std::optional<FitFailure> assess() {
    report(0.0, "how far the oedometer fit can be trusted");
    oedometer_.depth = Depth::assessment;
    auto oedometer = fit_oedometer(study_, *result_.oedometer.result.parameters, oedometer_list_, oedometer_);
    if (!oedometer) return oedometer.error();
    result_.oedometer = std::move(*oedometer);
    report(0.0, "uncertainty and comparison of all tests");
    slump_.control.callback = nullptr;
    found_->at.parameters = *result_.oedometer.result.parameters;
    found_->runs = runs_;
    auto slump = assess_slump(study_, *found_,
                              later_slump_list_.empty() ? study_.fit.slump : later_slump_list_, slump_);
    if (!slump) return slump.error();
    result_.slump = std::move(*slump);
    return std::nullopt;
  }

  std::optional<FitFailure> fit_both() {
    JointFitOptions joint_options;
    joint_options.threads = options_.slump_threads;
    joint_options.seed = study_.fit.seed;
    joint_options.control.stop = options_.stop;
    joint_options.simulate = options_.simulate;
    joint_options.control.callback = [this](int simulations, double) {
      report(sets_of(simulations), fmt::format("joint fit, {} simulations", simulations));
    };
    auto joint = fit_jointly(study_, result_.first_oedometer, result_.slump_alone, joint_options);
    if (joint) {
      result_.joint = std::move(*joint);
    } else if (joint.error().interrupted) {
      return joint.error();
    } else {
      result_.joint_failure = joint.error().message;
    }
    return std::nullopt;
  }

  std::optional<FitFailure> search(const SlumpPlace& start, const std::vector<ParameterId>& list,
                                   const std::string& what) {
    slump_.control.callback = [this, what](int evaluations, double cost) {
      report(evaluations, fmt::format("{}, evaluation {}, cost {:.4g}", what, evaluations, cost));
    };
    auto found = search_slump(study_, start, list, slump_);
    if (!found) return found.error();
    found_ = std::move(*found);
    done_ += found_->search.evaluations;
    return std::nullopt;
  }

  [[nodiscard]] SlumpPlace at_study() const {
    return {*result_.oedometer.result.parameters, study_.effects, {}};
  }
  [[nodiscard]] double sets_of(int simulations) const {
    return simulations / static_cast<double>(study_.slump_tests.size());
  }
  /// Work in evaluations of the slump tests; how much it will be is a guess, for their number decides itself.
  void report(double evaluations, const std::string& what) const {
    constexpr double kExpected = 120.0;
    constexpr double kReferenceSets = 9.0;  // four for the error of simulations, and one a correction
    const double expected = kExpected + kReferenceSets * reference_;
    if (options_.progress) options_.progress(std::min(0.97, (done_ + evaluations) / expected), what);
  }

  const datasets::Study& study_;
  const CalibrateOptions& options_;
  std::vector<ParameterId> oedometer_list_;    ///< after its first fit
  std::vector<ParameterId> later_slump_list_;  ///< after theirs
  OedometerFitOptions oedometer_;
  SlumpFitOptions slump_;
  double reference_;  ///< cost of the tests by the reference's numerics, in evaluations
  double done_ = 0.0;
  std::optional<SlumpSearch> found_;  ///< the last
  mpm::RunCounts runs_;
  Calibration result_;
};

}  // namespace

tl::expected<Calibration, FitFailure> calibrate(const datasets::Study& study,
                                                const CalibrateOptions& options) {
  return Chain(study, options).run();
}

}  // namespace isotach::calibration
