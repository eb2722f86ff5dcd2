// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The oedometer tests of a benchmark study before they are run: what the apparatus is told to do, and when it
// reads.
#pragma once

#include <random>
#include <vector>

#include "datasets/study.hpp"

namespace isotach::bench {

enum class Programme {
  poor,  ///< one test at one rate, as many laboratories make them
  rich   ///< two heights, rate steps, unloading and reloading, relaxation
};
[[nodiscard]] std::string_view name_of(Programme programme);

/// The tests to be fitted, 1 or 2, and behind them one to be held out, at a height and rates of its own.
/// Strain drives; the rows have time, strain, stage and temperature, and a placeholder for the stress.
/// Readings come at jittered times, but for the last of a stage, as loggers are triggered; the room's
/// temperature swings by the day. Specimens start at 8 kPa, at the K0 of steady compression and an
/// overconsolidation ratio between 1.2 and 1.8, which the study knows as void ratio and K0.
[[nodiscard]] std::vector<datasets::OedometerTest> blank_tests(Programme programme,
                                                               const model::Parameters<double>& truth,
                                                               std::mt19937_64& random);

}  // namespace isotach::bench
