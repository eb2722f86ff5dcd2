// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/interrupt.hpp"

#include <csignal>

namespace isotach::app {

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void on_signal(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

const std::atomic<bool>& interrupted() {
  return stop;
}

}  // namespace isotach::app
