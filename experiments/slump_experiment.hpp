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

/// What a slump test's simulations are made with.
struct SlumpModel {
  Simulate simulate = {};                        ///< may be empty where nothing is simulated
  SharedError simulation_error = {};             ///< of the simulations, as corrected
  effects::Values<double> effects = {};          ///< those of slump tests act
  std::vector<effects::ParameterRef> free = {};  ///< of the effects, local quantities that all tests share
  std::vector<datasets::FreeMud> mud = {};       ///< likewise, and before them
  Values correction = {};                        ///< (m) of each measured point's distance; empty: none
};

/// What is compared is the signed distance of each measured point to the simulated outline of the same time,
/// averaged over stations. What a fit sees are these means decorrelated: multiplied by the inverse of the
/// Cholesky factor of their covariance, so that each has unit variance whatever neighbours share. What is
/// "measured" is zero.
class SlumpExperiment final : public Experiment {
 public:
  explicit SlumpExperiment(datasets::SlumpTest test, SlumpModel model = {});

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
  /// The test's mud with the free quantities as `local` has them.
  [[nodiscard]] mpm::Mud mud_at(std::span<const double> local) const;
  /// The simulation behind predict().
  [[nodiscard]] tl::expected<mpm::SlumpResult, PredictionFailure> simulate(
      const model::Parameters<double>& parameters, std::span<const double> local) const;
  /// That with the best numerics there are, which needs no correction.
  [[nodiscard]] tl::expected<mpm::SlumpResult, PredictionFailure> simulate_at_best(
      const model::Parameters<double>& parameters, std::span<const double> local) const;
  /// Signed distance (m) of each measured point from a simulation's outlines.
  [[nodiscard]] Values distances(const mpm::SlumpResult& result) const;
  /// Distances in units of the noise of their points, as the study states it.
  [[nodiscard]] Values in_noise(const Values& distances) const;
  /// By how much a simulation's distances are corrected; empty where they are not.
  [[nodiscard]] const Values& correction() const { return model_.correction; }
  /// What predict() gives where something wanders.
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict_wandering(
      const mpm::Wander& wander, const model::Parameters<double>& parameters,
      std::span<const double> local) const;
  /// Distances as a fit sees them.
  [[nodiscard]] Values decorrelated(const Values& distances) const;
  /// For each point, whether the rim had left the mud by then.
  [[nodiscard]] const std::vector<bool>& mould_gone() const { return mould_gone_; }
  /// For each point, the index of its outline.
  [[nodiscard]] const std::vector<std::size_t>& outline_index() const { return outline_index_; }
  [[nodiscard]] const std::vector<OutlineStation>& stations() const { return stations_; }

 private:
  [[nodiscard]] tl::expected<mpm::SlumpResult, PredictionFailure> simulate(
      mpm::SlumpSetup setup, const model::Parameters<double>& parameters,
      std::span<const double> local) const;

  /// Distances from a simulation's outlines, corrected, as a fit sees them.
  [[nodiscard]] Values seen(const mpm::SlumpResult& result) const;

  datasets::SlumpTest test_;
  SlumpModel model_;
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
