// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump test: measured outlines against those of an MPM simulation.
#pragma once

#include <functional>
#include <string>

#include "datasets/study.hpp"
#include "experiments/experiment.hpp"
#include "mpm/run_status.hpp"
#include "mpm/slump.hpp"

namespace isotach::experiments {

/// How the simulation of a test of that name is had: run, or known already. Called from several threads.
using Simulate = std::function<tl::expected<mpm::SlumpResult, mpm::RunFailure>(
    const std::string& test, const model::Parameters<double>& parameters, const mpm::SlumpSetup& setup)>;

/// The value of each measured point is its signed distance to the simulated outline of the same time (m);
/// what is "measured" is therefore zero.
class SlumpExperiment final : public Experiment {
 public:
  /// `simulate` may be empty where nothing is predicted.
  SlumpExperiment(datasets::SlumpTest test, Simulate simulate);

  [[nodiscard]] const std::string& name() const override { return test_.name; }
  [[nodiscard]] bool held_out() const override { return test_.hold_out; }
  [[nodiscard]] const Values& measured() const override { return zeros_; }
  [[nodiscard]] std::string_view quantity() const override { return "distance between outlines (m)"; }
  [[nodiscard]] const Values& noise() const override { return noise_; }
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict(const model::Parameters<double>& parameters,
                                                                std::span<const double> local) const override;

  [[nodiscard]] const datasets::SlumpTest& test() const { return test_; }
  /// The simulation behind predict().
  [[nodiscard]] tl::expected<mpm::SlumpResult, PredictionFailure> simulate(
      const model::Parameters<double>& parameters) const;
  /// Values of a simulation.
  [[nodiscard]] Values distances(const mpm::SlumpResult& result) const;
  /// For each value, whether the rim had left the mud by then.
  [[nodiscard]] const std::vector<bool>& mould_gone() const { return mould_gone_; }
  /// For each value, the index of its outline.
  [[nodiscard]] const std::vector<std::size_t>& outline_index() const { return outline_index_; }
  /// Relative cost of a simulation, for sharing work out.
  [[nodiscard]] double cost() const;

 private:
  datasets::SlumpTest test_;
  Simulate simulate_;
  Values zeros_;
  Values noise_;
  std::vector<bool> mould_gone_;
  std::vector<std::size_t> outline_index_;
};

}  // namespace isotach::experiments
