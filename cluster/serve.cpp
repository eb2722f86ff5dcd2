// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "cluster/serve.hpp"

#include <charconv>
#include <chrono>
#include <future>
#include <thread>

#include "cluster/message.hpp"

namespace isotach::cluster {

namespace {

using namespace std::chrono_literals;

constexpr auto kIdleNap = 1ms;   // a simulation asked for waits this long at most
constexpr auto kBusyNap = 10ms;  // a wish to stop

/// Simulates on another thread while this one watches for a wish to stop.
journal::Simulation simulate(const Ranks& ranks, const std::string& bytes,
                             const std::atomic<bool>& interrupted) {
  const auto task = task_of(bytes);
  if (!task) return {mpm::RunStatus::crashed, "a simulation asked for that is not whole", 0.0, {}};
  std::atomic<bool> stop{false};
  auto running = std::async(std::launch::async, [&] {
    return journal::simulate(task->parameters, task->setup, {task->time_limit, &stop});
  });
  while (running.wait_for(kBusyNap) != std::future_status::ready) {
    if (interrupted) stop = true;
    if (const auto message = ranks.receive()) stop = stop || message->tag == Tag::stop;
  }
  return running.get();
}

}  // namespace

int serve(const Ranks& ranks, const std::atomic<bool>& interrupted) {
  while (true) {
    const auto message = ranks.receive();
    if (!message) {
      std::this_thread::sleep_for(kIdleNap);
    } else if (message->tag == Tag::simulate) {
      ranks.send(message->from, Tag::done, bytes_of(simulate(ranks, message->bytes, interrupted)));
    } else if (message->tag == Tag::leave) {
      int code = 0;
      std::from_chars(message->bytes.data(), message->bytes.data() + message->bytes.size(), code);
      return code;
    }
    // a wish to stop what has ended already says nothing
  }
}

void let_leave(const Ranks& ranks, int exit_code) {
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, Tag::leave, std::to_string(exit_code));
}

}  // namespace isotach::cluster
