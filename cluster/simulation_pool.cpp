// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "cluster/simulation_pool.hpp"

#include <chrono>

#include "cluster/message.hpp"

namespace isotach::cluster {

SimulationPool::SimulationPool(const Ranks& ranks)
    : ranks_(ranks), jobs_(static_cast<std::size_t>(ranks.size()), nullptr) {
  // taken from the end: the others first, and rank 0, which has the journal to keep, when they are busy
  for (int rank = 0; rank < ranks.size(); ++rank) free_ranks_.push_back(rank);
  talker_ = std::jthread([this] { talk(); });
}

SimulationPool::~SimulationPool() {
  const std::lock_guard lock(mutex_);
  ending_ = true;
  job_is_new_.notify_one();
}

journal::Simulation SimulationPool::run(const model::Parameters<double>& parameters,
                                        const mpm::SlumpSetup& setup, const journal::RunLimits& limits) {
  const int rank = take_rank();
  journal::Simulation simulation = rank == ranks_.rank() ? journal::simulate(parameters, setup, limits)
                                                         : run_on(rank, parameters, setup, limits);
  give_back(rank);
  return simulation;
}

int SimulationPool::take_rank() {
  std::unique_lock lock(mutex_);
  rank_is_free_.wait(lock, [&] { return !free_ranks_.empty(); });
  const int rank = free_ranks_.back();
  free_ranks_.pop_back();
  return rank;
}

void SimulationPool::give_back(int rank) {
  const std::lock_guard lock(mutex_);
  free_ranks_.push_back(rank);
  rank_is_free_.notify_one();
}

journal::Simulation SimulationPool::run_on(int rank, const model::Parameters<double>& parameters,
                                           const mpm::SlumpSetup& setup, const journal::RunLimits& limits) {
  Job job{rank, bytes_of(Task{parameters, setup, limits.time}), limits.stop};
  auto answer = job.answer.get_future();
  {
    const std::lock_guard lock(mutex_);
    jobs_[static_cast<std::size_t>(rank)] = &job;
    ++unsent_;
    ++under_way_;
  }
  job_is_new_.notify_one();
  auto simulation = simulation_of(answer.get());
  if (simulation) return std::move(*simulation);
  return {mpm::RunStatus::crashed, "the answer of another rank is not whole", 0.0, {}};
}

void SimulationPool::talk() {
  constexpr auto kNap = std::chrono::milliseconds(1);
  std::unique_lock lock(mutex_);
  while (true) {
    job_is_new_.wait(lock, [&] { return ending_ || under_way_ > 0; });
    if (ending_) return;
    send_what_is_due();
    take_answers();
    job_is_new_.wait_for(lock, kNap, [&] { return ending_ || unsent_ > 0; });
  }
}

void SimulationPool::send_what_is_due() {
  for (Job* job : jobs_) {
    if (job == nullptr) continue;
    if (!job->sent) {
      ranks_.send(job->rank, Tag::simulate, job->task);
      job->sent = true;
      --unsent_;
    }
    if (!job->told_to_stop && job->stop != nullptr && *job->stop) {
      ranks_.send(job->rank, Tag::stop, {});
      job->told_to_stop = true;
    }
  }
}

void SimulationPool::take_answers() {
  while (auto message = ranks_.receive()) {
    Job*& job = jobs_[static_cast<std::size_t>(message->from)];
    // the job is gone as soon as its answer is there
    std::promise<std::string> answer = std::move(job->answer);
    job = nullptr;
    --under_way_;
    answer.set_value(std::move(message->bytes));
  }
}

}  // namespace isotach::cluster
