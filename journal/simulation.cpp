// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "journal/simulation.hpp"

#include <chrono>
#include <exception>

namespace isotach::journal {

Simulation simulate(const model::Parameters<double>& parameters, const mpm::SlumpSetup& setup,
                    const RunLimits& limits) {
  mpm::RunOptions options;
  options.stop = limits.stop;
  options.history = false;
  options.time_limit = limits.time;
  Simulation simulation;
  const auto begin = std::chrono::steady_clock::now();
  try {
    auto result = mpm::run_slump(parameters, setup, options);
    if (result) {
      simulation.status = mpm::status_of(*result);
      simulation.result = std::move(*result);
    } else {
      simulation.status = mpm::status_of(result.error());
      simulation.message = std::move(result.error().message);
    }
  } catch (const std::exception& error) {  // memory, above all: the fit can go on elsewhere
    simulation.status = mpm::RunStatus::crashed;
    simulation.message = error.what();
  }
  simulation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return simulation;
}

}  // namespace isotach::journal
