// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C as a flag that long work looks at.
#pragma once

#include <atomic>

namespace isotach::app {

/// From now on SIGINT and SIGTERM set interrupted(); a second one ends the program at once.
void watch_interrupts();

/// True once the user has asked to stop.
[[nodiscard]] const std::atomic<bool>& interrupted();

}  // namespace isotach::app
