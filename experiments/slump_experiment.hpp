// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump test: measured outlines against those of an MPM simulation.
#pragma once

#include <Eigen/Cholesky>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "datasets/study.hpp"
#include "experiments/experiment.hpp"
#include "experiments/outline_covariance.hpp"
#include "mpm/run_status.hpp"
#include "mpm/slump.hpp"

namespace isotach::experiments {

/// How the simulation of a test of that name is had: run, or known already. Called from several threads.
using Simulate = std::function<tl::expected<mpm::SlumpResult, mpm::RunFailure>(
    const std::string& test, const model::Parameters<double>& parameters, const mpm::SlumpSetup& setup)>;

/// What is compared is the signed distance of each measured point to the simulated outline of the same time,
/// averaged over stations. What a fit sees are these means decorrelated: multiplied by the inverse of the
/// Cholesky factor of their covariance, so that each has unit variance whatever neighbours share. What is
/// "measured" is zero.
class SlumpExperiment final : public Experiment {
 public:
  /// `simulate` may be empty where nothing is predicted; `simulation_error` is that of the simulations.
  /// Those of `effects` that are of slump tests act; `free` parameters of them are local quantities, which
  /// all tests share.
  SlumpExperiment(datasets::SlumpTest test, Simulate simulate, const SharedError& simulation_error = {},
                  effects::Values<double> effects = {}, std::vector<effects::ParameterRef> free = {});

  [[nodiscard]] const std::string& name() const override { return test_.name; }
  [[nodiscard]] bool held_out() const override { return test_.hold_out; }
  [[nodiscard]] const Values& measured() const override { return zeros_; }
  [[nodiscard]] std::string_view quantity() const override {
    return "distance between outlines, decorrelated (-)";
  }
  [[nodiscard]] const Values& noise() const override { return ones_; }
  [[nodiscard]] std::vector<LocalQuantity> locals() const override;
  /// By fill and duration.
  [[nodiscard]] double cost() const override;
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict(const model::Parameters<double>& parameters,
                                                                std::span<const double> local) const override;

  [[nodiscard]] const datasets::SlumpTest& test() const { return test_; }
  /// The test's effects with the free parameters as `local` has them.
  [[nodiscard]] tl::expected<effects::Values<double>, PredictionFailure> effects_at(
      std::span<const double> local) const;
  /// The simulation behind predict().
  [[nodiscard]] tl::expected<mpm::SlumpResult, PredictionFailure> simulate(
      const model::Parameters<double>& parameters, std::span<const double> local) const;
  /// Signed distance (m) of each measured point from a simulation's outlines.
  [[nodiscard]] Values distances(const mpm::SlumpResult& result) const;
  /// Distances in units of the noise of their points, as the study states it.
  [[nodiscard]] Values in_noise(const Values& distances) const;
  /// Distances as a fit sees them.
  [[nodiscard]] Values decorrelated(const Values& distances) const;
  /// For each point, whether the rim had left the mud by then.
  [[nodiscard]] const std::vector<bool>& mould_gone() const { return mould_gone_; }
  /// For each point, the index of its outline.
  [[nodiscard]] const std::vector<std::size_t>& outline_index() const { return outline_index_; }
  [[nodiscard]] const std::vector<OutlineStation>& stations() const { return stations_; }

 private:
  datasets::SlumpTest test_;
  Simulate simulate_;
  effects::Values<double> effects_;
  std::vector<effects::ParameterRef> free_;
  std::vector<double> point_noise_;
  std::vector<bool> mould_gone_;
  std::vector<std::size_t> outline_index_;
  std::vector<OutlineStation> stations_;
  Eigen::LLT<Eigen::MatrixXd> factor_;  ///< of the stations' covariance (m2)
  Values zeros_;
  Values ones_;
};

/// How a study's noise parts into a point's own error and what neighbours share.
[[nodiscard]] OutlineErrors errors_of(const datasets::SlumpNoise& noise, const SharedError& simulation);

}  // namespace isotach::experiments
