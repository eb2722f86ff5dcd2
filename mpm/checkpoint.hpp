// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump run on disk, halfway.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "model/parameters.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::mpm {

/// What a run is made of, as a number: parameters, setup, what is recorded and the version of the program.
/// Equal for equal runs.
[[nodiscard]] std::uint64_t run_key(const model::Parameters<double>& parameters, const SlumpSetup& setup,
                                    bool history, bool snapshots, std::size_t frames);

/// Writes the state of the run with that key, first to a temporary name. Returns whether it could.
[[nodiscard]] bool write_checkpoint(const std::filesystem::path& file, std::uint64_t key,
                                    std::string_view state);

/// The state that was written; nothing where there is no such file, where it belongs to another run, or where
/// it is not whole.
[[nodiscard]] std::optional<std::string> read_checkpoint(const std::filesystem::path& file,
                                                         std::uint64_t key);

}  // namespace isotach::mpm
