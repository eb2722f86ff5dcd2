// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/next_test.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "calibration/fit_oedometer.hpp"
#include "calibration/fit_slump.hpp"
#include "calibration/oedometer_information.hpp"
#include "calibration/slump_information.hpp"
#include "integrators/steady_oedometric.hpp"

namespace isotach::calibration {

namespace {

constexpr double kPointSpacing = 2e-3;  // m along an outline, where the study has none to go by
constexpr std::size_t kSequence = 4;
constexpr double kWorthMaking = 0.02;  // gain in ln det: 1 % of a standard error

using experiments::SlumpExperiment;

/// All parameters that are found along, each once: those of both lists, and I_v and C_1.
std::vector<model::ParameterId> wanted(const datasets::FitSettings& fit) {
  std::vector<model::ParameterId> all = fit.oedometer;
  const auto add = [&](model::ParameterId id) {
    if (std::find(all.begin(), all.end(), id) == all.end()) all.push_back(id);
  };
  for (const model::ParameterId id : fit.slump) add(id);
  add(model::ParameterId::I_v);
  add(model::ParameterId::C_1);
  return all;
}

/// The gauge in which the material's own D_r stands: that of the rate at which it is steady.
tl::expected<GaugeChoice, FitFailure> gauge_of(const datasets::Study& study) {
  if (study.fit.gauge == datasets::Gauge::fixed) return GaugeChoice{study.fit.gauge, 0.0};
  constexpr double kAnyRate = 1e-6;  // viscous rates go with it
  const auto steady = integrators::steady_oedometric(study.material, kAnyRate);
  if (!steady) return tl::unexpected(FitFailure{"steady oedometric compression: " + steady.error()});
  return GaugeChoice{datasets::Gauge::crs_rate, kAnyRate * study.material.D_r() / steady->viscous_rate};
}

/// The study's oedometer tests that are fitted.
tl::expected<Experiments, FitFailure> experiments_of(const datasets::Study& study) {
  Experiments all;
  for (const auto& test : study.oedometer_tests) {
    if (test.hold_out) continue;
    try {
      all.push_back(std::make_shared<experiments::OedometerExperiment>(test));
    } catch (const std::invalid_argument& error) {  // nothing is left to be compared
      return tl::unexpected(FitFailure{error.what()});
    }
  }
  return all;
}

/// Distance between neighbouring points of the study's outlines.
double point_spacing(const datasets::Study& study) {
  double length = 0.0;
  double count = 0.0;
  for (const datasets::SlumpTest& test : study.slump_tests) {
    for (const datasets::Outline& outline : test.outlines) {
      for (std::size_t i = 1; i < outline.points.size(); ++i) {
        length += std::hypot(outline.points[i].r - outline.points[i - 1].r,
                             outline.points[i].z - outline.points[i - 1].z);
        ++count;
      }
    }
  }
  return count > 0.0 ? length / count : kPointSpacing;
}

/// A test's information on coordinates, filled up with zeros for numerics that it does not see.
Eigen::MatrixXd information_of(const Eigen::MatrixXd& jacobian, Eigen::Index size) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  information.topLeftCorner(jacobian.cols(), jacobian.cols()) = jacobian.transpose() * jacobian;
  return information;
}

/// The work of rate_candidates, step by step.
class Rating {
 public:
  Rating(const datasets::Study& study, const NextTestOptions& options, const GaugeChoice& gauge,
         Experiments oedometers)
      : study_(study),
        options_(options),
        oedometers_(std::move(oedometers)),
        parametrisation_(study.material, wanted(study.fit), {study.fit.bounds, study.fit.priors}, gauge,
                         oedometers_),
        x_(parametrisation_.start()),
        coordinates_(static_cast<Eigen::Index>(parametrisation_.size())),
        size_(coordinates_ + static_cast<Eigen::Index>(kNumericalVariants)),
        present_(Eigen::MatrixXd::Zero(size_, size_)) {
    result_.coordinates = parametrisation_.coordinates();
    result_.reference_rate = gauge.reference_rate;
    const auto& free = parametrisation_.free();
    const auto index = [&](model::ParameterId id) {
      return static_cast<Eigen::Index>(std::find(free.begin(), free.end(), id) - free.begin());
    };
    result_.interest = {index(model::ParameterId::I_v), index(model::ParameterId::C_1)};
    // amplitudes of numerics have unit variance
    present_.bottomRightCorner(size_ - coordinates_, size_ - coordinates_).setIdentity();
    add_priors();
    count_runs();
  }

  std::optional<FitFailure> add_oedometer_tests() {
    tell(0.0, "oedometer tests");
    if (oedometers_.empty()) return std::nullopt;
    OedometerFitOptions fit_options;
    fit_options.threads = options_.threads;
    fit_options.depth = Depth::answer;
    fit_options.start_from_data = false;
    fit_options.control.stop = options_.stop;
    Problem problem(oedometers_, parametrisation_, options_.threads);
    if (problem.fitted().empty()) return std::nullopt;
    const auto fit = fit_oedometer(study_, study_.material, study_.fit.oedometer, fit_options);
    if (fit) {
      noise_ = fit->noise;
      problem.set_weights(noise_->weights);
    } else if (fit.error().interrupted) {
      return fit.error();
    } else {
      result_.warnings.push_back(
          "oedometer tests have the noise that the study states, since their own was "
          "not found: " +
          fit.error().message);
    }
    const auto at = problem.linearise(x_);
    if (!at) return FitFailure{"oedometer tests at the study's material: " + at.error().message};
    Eigen::Index row = 0;
    for (const auto& test : problem.fitted()) {
      const auto count = static_cast<Eigen::Index>(test->measured().size());
      add_present(test->name(), test->measured().size(), at->jacobian.middleRows(row, count));
      row += count;
    }
    if (noise_) widen_by_remaining(problem, *at);
    return std::nullopt;
  }

  std::optional<FitFailure> add_slump_tests(const datasets::Candidates& candidates) {
    datasets::Study fitted = study_;
    std::erase_if(fitted.slump_tests, [](const auto& test) { return test.hold_out; });
    std::vector<NamedSetup> setups;
    for (const auto& test : fitted.slump_tests) setups.push_back({test.name, test.setup});
    std::vector<NamedSetup> candidate_setups;
    for (const auto& slump : candidates.slumps) candidate_setups.push_back({slump.name, known(slump.setup)});
    runs_expected_ =
        (setups.size() + candidate_setups.size()) * simulations_around(parametrisation_.free().size());
    const auto present = around(setups);
    if (!present) return present.error();
    auto simulated = around(candidate_setups);
    if (!simulated) return simulated.error();
    if (const auto& error = present->error ? present->error : simulated->error) {
      result_.simulation_error = *error;
    }
    for (std::size_t i = 0; i < setups.size(); ++i) {
      const SlumpExperiment experiment(fitted.slump_tests[i],
                                       {.simulation_error = result_.simulation_error.error});
      const auto jacobian = slump_jacobian(experiment, present->runs[i], parametrisation_.size());
      if (!jacobian) {
        return FitFailure{setups[i].name + " at the study's material: " + jacobian.error()};
      }
      add_present(setups[i].name, experiment.measured().size(), *jacobian);
    }
    candidate_runs_ = std::move(simulated->runs);
    return std::nullopt;
  }

  void rate(const datasets::Candidates& candidates) {
    tell(0.98, "table of candidates");
    rate_present();
    rate_slumps(candidates);
    rate_oedometers(candidates);
    rate_programmes();
    find_sequence();
    find_pair();
  }

  NextTest take() {
    result_.runs = tally_;
    return std::move(result_);
  }

 private:
  void tell(double fraction, const std::string& what) const {
    if (options_.progress) options_.progress(fraction, what);
  }

  void add_priors() {
    for (Eigen::Index k = 0; k < coordinates_; ++k) {
      const auto& prior = parametrisation_.coordinates()[static_cast<std::size_t>(k)].prior;
      if (prior) present_(k, k) += 1.0 / (prior->std_error * prior->std_error);
    }
  }

  void count_runs() {
    const experiments::Simulate simulate =
        options_.simulate ? options_.simulate : plain_simulation(options_.stop);
    simulate_ = [this, simulate](const std::string& test, const model::Parameters<double>& parameters,
                                 const mpm::SlumpSetup& setup) {
      auto run = simulate(test, parameters, setup);
      const std::lock_guard lock(mutex_);
      ++tally_[run ? mpm::status_of(*run) : run.error().status];
      const double share = static_cast<double>(tally_.total()) / static_cast<double>(runs_expected_);
      tell(std::min(0.97, 0.02 + 0.95 * share),
           fmt::format("simulation {} of {}", tally_.total(), runs_expected_));
      return run;
    };
  }

  void add_present(const std::string& name, std::size_t values, const Eigen::MatrixXd& jacobian) {
    HeldTest test;
    test.name = name;
    test.values = values;
    present_parts_.push_back(information_of(jacobian, size_));
    present_ += present_parts_.back();
    result_.tests.push_back(std::move(test));
  }

  /// Where a fit's misfit keeps its correlation, the covariance of the oedometer tests is what the fit makes
  /// of it; each test is then taken to hold less in proportion.
  void widen_by_remaining(const Problem& problem, const Linearised& at) {
    if (noise_->remaining.empty()) return;
    const Eigen::MatrixXd information = at.jacobian.transpose() * at.jacobian;
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(information);
    if (!lu.isInvertible()) {
      result_.warnings.push_back(
          "residuals of oedometer tests are correlated, which is not counted, since the tests do not hold "
          "all "
          "parameters");
      return;
    }
    const Eigen::MatrixXd covariance = lu.inverse();
    const Eigen::MatrixXd wider = with_remaining_correlation(problem, at, *noise_, covariance);
    const double share = std::exp((std::log(covariance.determinant()) - std::log(wider.determinant())) /
                                  static_cast<double>(coordinates_));
    for (Eigen::MatrixXd& part : present_parts_) {
      present_ -= (1.0 - share) * part;
      part *= share;
    }
    result_.warnings.push_back(fmt::format(
        "residuals of oedometer tests are correlated beyond noise: the study's are taken to hold {:.2g} of "
        "what independent ones would",
        share));
  }

  tl::expected<SimulatedSetups, FitFailure> around(const std::vector<NamedSetup>& setups) {
    return simulate_around(study_, parametrisation_, x_, setups, simulate_, options_.threads);
  }

  /// The setup with the void ratio that a stated strength means at the study's material: it is what a test
  /// would state.
  mpm::SlumpSetup known(mpm::SlumpSetup setup) const {
    if (setup.mud.void_ratio || !setup.mud.undrained_strength) return setup;
    setup.mud.void_ratio =
        mpm::void_ratio_from_strength(study_.material, *setup.mud.undrained_strength,
                                      setup.mud.strength_rate.value_or(study_.material.D_r()));
    setup.mud.undrained_strength.reset();
    setup.mud.strength_rate.reset();
    return setup;
  }

  Outlook outlook(const Eigen::MatrixXd& information) const {
    return outlook_of(information, result_.interest);
  }

  /// As if all but the two and the numerics were known.
  Outlook held(const Eigen::MatrixXd& information) const {
    std::vector<Eigen::Index> kept{result_.interest.first, result_.interest.second};
    for (Eigen::Index i = coordinates_; i < size_; ++i) kept.push_back(i);
    return outlook_of(information(kept, kept), {0, 1});
  }

  int directions(const Eigen::MatrixXd& information) const {
    return directions_held(information.topLeftCorner(coordinates_, coordinates_));
  }

  void rate_present() {
    knowledge_ = knowledge_of_others(present_, result_.interest);
    result_.present = outlook(present_);
    result_.present_held = held(present_);
    for (std::size_t i = 0; i < present_parts_.size(); ++i) {
      HeldTest& test = result_.tests[i];
      test.directions = directions(present_parts_[i]);
      test.alone = outlook(knowledge_ + present_parts_[i]);
      test.without = outlook(present_ - present_parts_[i]);
    }
  }

  void add_rating(CandidateRating rating, const tl::expected<Eigen::MatrixXd, std::string>& jacobian) {
    if (!jacobian) {
      rating.failure = jacobian.error().empty() ? "a simulation failed" : jacobian.error();
    } else {
      rating.values = static_cast<std::size_t>(jacobian->rows());
      rating.information = information_of(*jacobian, size_);
      rating.directions = directions(rating.information);
      rating.alone = outlook(knowledge_ + rating.information);
      rating.with_present = outlook(present_ + rating.information);
      rating.with_present_held = held(present_ + rating.information);
    }
    result_.candidates.push_back(std::move(rating));
  }

  void rate_slumps(const datasets::Candidates& candidates) {
    const double spacing = point_spacing(study_);
    datasets::SlumpNoise noise;
    for (const auto& test : study_.slump_tests) {
      if (test.hold_out) continue;
      noise = test.noise;
      break;
    }
    for (std::size_t i = 0; i < candidates.slumps.size(); ++i) {
      const datasets::CandidateSlump& slump = candidates.slumps[i];
      const SlumpRuns& runs = candidate_runs_[i];
      bool first = true;
      for (const datasets::PictureTimes& pictures : slump.pictures) {
        CandidateRating rating;
        rating.name = pictures.name.empty() ? slump.name : slump.name + ", " + pictures.name;
        rating.slump = true;
        if (first) rating.programme = slump.programme;
        first = false;
        tl::expected<Eigen::MatrixXd, std::string> jacobian = tl::unexpected(runs.failure);
        if (runs.base) {
          const SlumpExperiment experiment(test_of(runs, pictures.times, spacing, noise),
                                           {.simulation_error = result_.simulation_error.error});
          jacobian = slump_jacobian(experiment, runs, parametrisation_.size());
        }
        add_rating(std::move(rating), jacobian);
      }
    }
  }

  void rate_oedometers(const datasets::Candidates& candidates) {
    const OedometerSetting setting = setting_of(study_, study_.material);
    const auto noise = noise_ ? noisiest_stress(*noise_) : std::nullopt;
    if (noise) {
      result_.stress_noise = noise->model.level;
      result_.stress_correlation = noise->model.neighbours();
    } else if (!candidates.oedometers.empty()) {
      result_.stress_noise = setting.noise.stress_relative;
    }
    for (const datasets::CandidateOedometer& candidate : candidates.oedometers) {
      CandidateRating rating;
      rating.name = candidate.name;
      rating.programme = candidate.programme;
      tl::expected<Eigen::MatrixXd, std::string> jacobian = tl::unexpected(std::string());
      const auto test = test_of(candidate, setting, study_.material);
      if (test) {
        jacobian = oedometer_jacobian(experiments::OedometerExperiment(*test), parametrisation_, x_, noise);
      } else {
        jacobian = tl::unexpected(test.error());
      }
      add_rating(std::move(rating), jacobian);
    }
  }

  void rate_programmes() {
    for (std::size_t i = 0; i < result_.candidates.size(); ++i) {
      const CandidateRating& candidate = result_.candidates[i];
      if (candidate.programme.empty() || !candidate.failure.empty()) continue;
      auto& all = result_.programmes;
      auto found = std::find_if(all.begin(), all.end(),
                                [&](const auto& programme) { return programme.name == candidate.programme; });
      if (found == all.end()) {
        all.push_back({candidate.programme, {}, {}, {}, {}});
        found = std::prev(all.end());
      }
      found->tests.push_back(i);
    }
    for (ProgrammeRating& programme : result_.programmes) {
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size_, size_);
      for (const std::size_t i : programme.tests) sum += result_.candidates[i].information;
      programme.alone = outlook(knowledge_ + sum);
      programme.with_present = outlook(present_ + sum);
      for (const std::size_t i : programme.tests) {
        programme.without.push_back(outlook(knowledge_ + sum - result_.candidates[i].information));
      }
    }
  }

  void find_sequence() {
    Eigen::MatrixXd known = present_;
    Outlook before = result_.present;
    while (result_.sequence.size() < kSequence) {
      std::optional<SequenceStep> best;
      for (std::size_t i = 0; i < result_.candidates.size(); ++i) {
        if (!result_.candidates[i].failure.empty()) continue;
        const Outlook after = outlook(known + result_.candidates[i].information);
        if (!best || after.log_det < best->after.log_det) best = SequenceStep{i, after};
      }
      if (!best || !std::isfinite(best->after.log_det)) return;
      if (before.log_det - best->after.log_det < kWorthMaking) return;
      known += result_.candidates[best->candidate].information;
      before = best->after;
      result_.sequence.push_back(*best);
    }
  }

  void find_pair() {
    for (std::size_t i = 0; i < result_.candidates.size(); ++i) {
      if (!result_.candidates[i].failure.empty()) continue;
      for (std::size_t j = i; j < result_.candidates.size(); ++j) {
        if (!result_.candidates[j].failure.empty()) continue;
        const Outlook after =
            outlook(present_ + result_.candidates[i].information + result_.candidates[j].information);
        if (!(after.log_det < result_.after_pair.log_det)) continue;
        result_.after_pair = after;
        result_.pair = {i, j};
      }
    }
  }

  const datasets::Study& study_;
  const NextTestOptions& options_;
  Experiments oedometers_;  // fitted
  Parametrisation parametrisation_;
  std::vector<double> x_;
  Eigen::Index coordinates_;
  Eigen::Index size_;  // coordinates and amplitudes of numerics
  Eigen::MatrixXd present_;
  std::vector<Eigen::MatrixXd> present_parts_;  // by test
  Eigen::MatrixXd knowledge_;                   // of all but I_v and C_1
  std::optional<NoiseFit> noise_;
  std::vector<SlumpRuns> candidate_runs_;
  experiments::Simulate simulate_;
  std::mutex mutex_;  // of tally_
  mpm::RunCounts tally_;
  std::size_t runs_expected_ = 1;
  NextTest result_;
};

}  // namespace

double gain(const Outlook& before, const Outlook& after) {
  return std::isfinite(before.log_det) ? before.log_det - after.log_det : std::nan("");
}

tl::expected<NextTest, FitFailure> rate_candidates(const datasets::Study& study,
                                                   const datasets::Candidates& candidates,
                                                   const NextTestOptions& options) {
  const auto gauge = gauge_of(study);
  if (!gauge) return tl::unexpected(gauge.error());
  const auto oedometers = experiments_of(study);
  if (!oedometers) return tl::unexpected(oedometers.error());
  Rating rating(study, options, *gauge, *oedometers);
  if (auto failure = rating.add_oedometer_tests()) return tl::unexpected(*failure);
  if (auto failure = rating.add_slump_tests(candidates)) return tl::unexpected(*failure);
  rating.rate(candidates);
  return rating.take();
}

}  // namespace isotach::calibration
