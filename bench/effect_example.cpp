// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Writes the two tests of docs/effects.md, with ring friction: effect_example FOLDER.
#include <fmt/format.h>

#include "bench/example_test.hpp"
#include "effects/ring_friction.hpp"

namespace {

using namespace isotach;
using datasets::Stage;

/// Two rates, unloading, reloading, a relaxation, a hold at 60 kPa and the way on.
datasets::OedometerTest test_of(double height) {
  bench::ExampleTest test("example", height);
  test.ramp(0.08, 1e-6, 30);
  test.ramp(0.12, 1e-5, 20);
  test.ramp(0.105, 3e-6, 20);
  test.ramp(0.15, 3e-6, 25);
  test.rest(4e4, 15, Stage::relax);
  test.ramp(0.18, 3e-6, 15);
  test.rest(4e4, 15, Stage::hold);
  test.ramp(0.21, 2e-6, 15);
  return test.test();
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: effect_example FOLDER\n");
    return 2;
  }
  const auto effects =
      *effects::Values<double>::create({effects::with_amplitude(effects::ring_friction::kEffect, 0.08)});
  const std::string comment =
      "synthetic: ring friction 0.08, noise of 0.5 % of stress and 2e-5 of strain where stress is held";
  std::mt19937_64 random(1);
  const std::filesystem::path folder(arguments[1]);
  bench::write_readings(folder / "low.csv", comment, test_of(0.02), effects, random);
  bench::write_readings(folder / "high.csv", comment, test_of(0.04), effects, random);
  return 0;
}
