// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Rank 0's simulations, one at a time on each rank.
#pragma once

#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "cluster/ranks.hpp"
#include "journal/simulation.hpp"

namespace isotach::cluster {

/// Runs simulations from any number of threads; as many at a time as there are ranks, this one included, and
/// the others wait. One thread does all that is MPI; it sleeps a millisecond between looks at what has
/// arrived, and altogether where nothing is under way. While a pool lives, nobody else may use the ranks.
class SimulationPool {
 public:
  /// On rank 0. `ranks` must outlive the pool.
  explicit SimulationPool(const Ranks& ranks);
  /// No run() may be under way.
  ~SimulationPool();
  SimulationPool(const SimulationPool&) = delete;
  SimulationPool& operator=(const SimulationPool&) = delete;

  /// Simulations at a time.
  [[nodiscard]] int size() const { return ranks_.size(); }

  /// As journal::simulate(), to the last bit. The time limit is that of the simulation itself, without the
  /// wait for a rank.
  [[nodiscard]] journal::Simulation run(const model::Parameters<double>& parameters,
                                        const mpm::SlumpSetup& setup, const journal::RunLimits& limits);

 private:
  /// A simulation on another rank.
  struct Job {
    int rank;
    std::string task;
    const std::atomic<bool>* stop;
    bool sent = false;
    bool told_to_stop = false;
    std::promise<std::string> answer = {};
  };

  [[nodiscard]] int take_rank();
  void give_back(int rank);
  [[nodiscard]] journal::Simulation run_on(int rank, const model::Parameters<double>& parameters,
                                           const mpm::SlumpSetup& setup, const journal::RunLimits& limits);
  void talk();
  void send_what_is_due();
  void take_answers();

  const Ranks& ranks_;
  std::mutex mutex_;  // of all below
  std::condition_variable rank_is_free_;
  std::condition_variable job_is_new_;
  std::vector<int> free_ranks_;
  std::vector<Job*> jobs_;  // by rank; null where it has none
  int unsent_ = 0;
  int under_way_ = 0;
  bool ending_ = false;
  std::jthread talker_;
};

}  // namespace isotach::cluster
