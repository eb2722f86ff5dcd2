// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/slump_information.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"

namespace isotach::calibration {

namespace {

// Heights move by some 0.4 mm for such a step of ln I_v or C_1, and scatter by 0.01 mm.
constexpr double kStep = 0.03;

/// Why simulations failed, by the name of the setup.
class Failures {
 public:
  void add(const std::string& name, const std::string& message) {
    const std::lock_guard lock(mutex_);
    messages_[name] = message;
  }
  [[nodiscard]] std::string of(const std::string& name) const {
    const auto found = messages_.find(name);
    return found == messages_.end() ? std::string() : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> messages_;
};

/// The setups as tests of a study, as measure_simulation_error wants them.
datasets::Study study_of(datasets::Study study, const std::vector<NamedSetup>& setups) {
  study.slump_tests.clear();
  for (const NamedSetup& setup : setups) {
    study.slump_tests.push_back({setup.name, {}, {}, setup.setup, {}, false});
  }
  return study;
}

/// The outlines of a run at some of its times.
mpm::SlumpResult at_times(const mpm::SlumpResult& run, const std::vector<double>& all,
                          const std::vector<double>& wanted) {
  mpm::SlumpResult result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (std::find(wanted.begin(), wanted.end(), all[k]) != wanted.end()) {
      result.outlines.push_back(run.outlines[k]);
    }
  }
  return result;
}

}  // namespace

std::size_t simulations_around(std::size_t material_coordinates) {
  return 1 + kNumericalVariants + kNudgedSimulations + 2 * material_coordinates;
}

tl::expected<SimulatedSetups, FitFailure> simulate_around(
    const datasets::Study& study, const Parametrisation& parametrisation, const std::vector<double>& x,
    const std::vector<NamedSetup>& setups, const experiments::Simulate& simulate, int threads) {
  SimulatedSetups result;
  std::vector<SlumpRuns>& all = result.runs;
  if (setups.empty()) return result;
  const auto here = parametrisation.at(x);
  if (!here) return tl::unexpected(FitFailure{here.error(), false});
  const auto failures = std::make_shared<Failures>();
  std::atomic<bool> interrupted{false};
  const experiments::Simulate recorded = [&](const std::string& name, const auto& parameters,
                                             const mpm::SlumpSetup& setup) {
    auto run = simulate(name, parameters, setup);
    if (!run) {
      failures->add(name, run.error().message);
      if (run.error().status == mpm::RunStatus::interrupted) interrupted = true;
    }
    return run;
  };
  auto error = measure_simulation_error(study_of(study, setups), *here, recorded, threads);
  if (!error && error.error().interrupted) return tl::unexpected(error.error());
  const std::size_t coordinates = parametrisation.free().size();
  for (std::size_t s = 0; s < setups.size(); ++s) {
    SlumpRuns runs{setups[s].name, setups[s].setup, {}, {}, {}, {}};
    if (error) {
      runs.base = std::move(error->runs[s]);
      for (NumericalVariant& variant : error->variants) runs.variants.push_back(std::move(variant.runs[s]));
    }
    runs.variants.resize(kNumericalVariants);
    for (std::size_t k = 0; k < coordinates; ++k) {
      const Coordinate& coordinate = parametrisation.coordinates()[k];
      const auto inside = [&](double step) {
        return coordinate.logarithmic || x[k] + step >= 0.0 ? step : 0.0;  // C_1 is none below 0
      };
      runs.moved.push_back({SlumpRuns::Side{inside(-kStep)}, SlumpRuns::Side{inside(kStep)}});
    }
    all.push_back(std::move(runs));
  }
  const std::size_t sides = 2 * coordinates;
  parallel_for(setups.size() * sides, threads, [&](std::size_t i) {
    SlumpRuns& runs = all[i / sides];
    const std::size_t k = i % sides / 2;
    SlumpRuns::Side& side = runs.moved[k][i % 2];
    if (!runs.base || side.step == 0.0 || interrupted) return;
    std::vector<double> moved = x;
    moved[k] += side.step;
    const auto parameters = parametrisation.at(moved);
    if (!parameters) return;  // not admissible: one-sided
    auto run = recorded(runs.name, *parameters, datasets::with_effects(runs.setup, study.effects));
    if (run) side.run = std::move(*run);
  });
  if (interrupted) return tl::unexpected(FitFailure{"interrupted", true});
  for (SlumpRuns& runs : all) runs.failure = failures->of(runs.name);
  if (error) result.error = std::move(*error);
  return result;
}

datasets::SlumpTest test_of(const SlumpRuns& runs, const std::vector<double>& times, double spacing,
                            const datasets::SlumpNoise& noise) {
  datasets::SlumpTest test{runs.name, {}, {}, runs.setup, noise, false};
  test.setup.times = times;
  for (const mpm::Outline& outline : at_times(*runs.base, runs.setup.times, times).outlines) {
    double length = 0.0;
    for (std::size_t i = 1; i < outline.points.size(); ++i) {
      length += std::hypot(outline.points[i].r - outline.points[i - 1].r,
                           outline.points[i].z - outline.points[i - 1].z);
    }
    datasets::Outline read{outline.time, {}};
    const auto count = static_cast<std::size_t>(std::max(4.0, std::round(length / spacing) + 1.0));
    for (const mpm::OutlinePoint& point : experiments::resampled(outline.points, count)) {
      read.points.push_back({point.r, point.z});
    }
    test.outlines.push_back(std::move(read));
  }
  return test;
}

tl::expected<Eigen::MatrixXd, std::string> slump_jacobian(const experiments::SlumpExperiment& experiment,
                                                          const SlumpRuns& runs, std::size_t coordinates) {
  if (!runs.base) return tl::unexpected(runs.failure);
  const std::vector<double>& wanted = experiment.test().setup.times;
  const auto values = [&](const mpm::SlumpResult& run) -> Eigen::VectorXd {
    const experiments::Values white =
        experiment.decorrelated(experiment.distances(at_times(run, runs.setup.times, wanted)));
    return Eigen::Map<const Eigen::VectorXd>(white.data(), static_cast<Eigen::Index>(white.size()));
  };
  const Eigen::VectorXd base = values(*runs.base);
  const auto first_variant = static_cast<Eigen::Index>(coordinates);
  Eigen::MatrixXd jacobian =
      Eigen::MatrixXd::Zero(base.size(), first_variant + static_cast<Eigen::Index>(runs.variants.size()));
  for (std::size_t k = 0; k < runs.moved.size(); ++k) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(base.size());
    double width = 0.0;
    for (const SlumpRuns::Side& side : runs.moved[k]) {
      if (!side.run) continue;
      const double sign = side.step > 0.0 ? 1.0 : -1.0;
      difference += sign * (values(*side.run) - base);
      width += std::abs(side.step);
    }
    if (!(width > 0.0)) return tl::unexpected(runs.failure);
    jacobian.col(static_cast<Eigen::Index>(k)) = difference / width;
  }
  for (std::size_t v = 0; v < runs.variants.size(); ++v) {
    if (!runs.variants[v]) continue;
    jacobian.col(first_variant + static_cast<Eigen::Index>(v)) = values(*runs.variants[v]) - base;
  }
  return jacobian;
}

}  // namespace isotach::calibration
