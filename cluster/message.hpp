// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A simulation asked for and one done, as bytes that give every number back to the last bit. Bytes are those
// of this machine and this version: they go between processes of one run.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "journal/simulation.hpp"

namespace isotach::cluster {

/// A simulation asked for.
struct Task {
  model::Parameters<double> parameters;
  mpm::SlumpSetup setup;
  double time_limit;  ///< s of wall time
};

[[nodiscard]] std::string bytes_of(const Task& task);
[[nodiscard]] std::string bytes_of(const journal::Simulation& simulation);

/// The reverse; nothing where the bytes are not whole.
[[nodiscard]] std::optional<Task> task_of(std::string_view bytes);
[[nodiscard]] std::optional<journal::Simulation> simulation_of(std::string_view bytes);

}  // namespace isotach::cluster
