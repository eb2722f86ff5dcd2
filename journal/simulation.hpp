// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slump simulation under limits: how it ended, what came out, what it took.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "model/parameters.hpp"
#include "mpm/run_status.hpp"
#include "mpm/slump.hpp"

namespace isotach::journal {

struct Simulation {
  mpm::RunStatus status = mpm::RunStatus::ok;
  std::string message;                     ///< why it failed, without the test's name; empty where it did not
  double seconds = 0.0;                    ///< wall time taken
  std::optional<mpm::SlumpResult> result;  ///< without snapshots, fields and frames; none where it failed
};

struct RunLimits {
  double time = 3600.0;                     ///< s of wall time, > 0
  const std::atomic<bool>* stop = nullptr;  ///< once true, the simulation ends as interrupted
};

/// Runs a simulation, history at the output times only. Never throws: exceptions from below, as for want of
/// memory, are a status.
[[nodiscard]] Simulation simulate(const model::Parameters<double>& parameters, const mpm::SlumpSetup& setup,
                                  const RunLimits& limits);

/// Where simulations are run: simulate() or what does the same elsewhere. Called from several threads.
using Execute = std::function<Simulation(const model::Parameters<double>& parameters,
                                         const mpm::SlumpSetup& setup, const RunLimits& limits)>;

}  // namespace isotach::journal
