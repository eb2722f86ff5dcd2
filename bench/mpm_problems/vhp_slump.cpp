// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/mpm_problems/vhp_slump.hpp"

#include <stdexcept>

#include "model/published_sets.hpp"

namespace isotach::bench {

mpm::SlumpSetup seed_test_1(double cell_size, std::vector<double> times) {
  mpm::SlumpSetup setup;
  setup.mould.diameter = 0.078;
  setup.mould.fill_height = 0.14;
  setup.mould.lift_speed = 0.06;
  setup.mud.void_ratio = 3.891;
  setup.mud.specific_gravity = 2.65;
  setup.mud.overconsolidation_ratio = 1.5;
  setup.numerics.cell_size = cell_size;
  setup.times = std::move(times);
  return setup;
}

mpm::SlumpResult run_seed_mud(const mpm::SlumpSetup& setup) {
  const auto mud = model::Parameters<double>::create(model::seed_mud_values()).value();
  auto result = mpm::run_slump(mud, setup);
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

}  // namespace isotach::bench
