// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How plainly an effect shows in slump tests of the discovery benchmark, by short tests in coarse cells.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/discovery/slump_visibility.hpp"
#include "effects/wall_adhesion.hpp"

namespace isotach::bench {
namespace {

constexpr double kNoise = 1e-3;  // m
constexpr KnownBeforehand kKnown{.viscosity = 0.03, .c1 = 0.005};

datasets::Study mud_a() {
  return datasets::read_study(std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets/mud-a/study.toml");
}

/// Two tests of mud-a up to two seconds, as they show the study's material in so many cells across the
/// mould's radius.
SlumpGenerator measured(int cells, double noise = kNoise) {
  const datasets::Study study = mud_a();
  std::vector<datasets::SlumpTest> tests(study.slump_tests.begin(), study.slump_tests.begin() + 2);
  for (datasets::SlumpTest& test : tests) {
    constexpr double kLongest = 2.0;
    std::erase_if(test.outlines, [](const datasets::Outline& outline) { return outline.time > kLongest; });
    test.setup.times.clear();
    for (const datasets::Outline& outline : test.outlines) test.setup.times.push_back(outline.time);
    test.setup.numerics.cell_size = 0.5 * test.setup.mould.diameter / cells;
    test.noise = {noise, noise, 0.0};
    test.hold_out = false;
  }
  SlumpGenerator generator(std::move(tests), study.material);
  if (const auto failure = generator.measure({})) throw std::runtime_error(*failure);
  return generator;
}

effects::Values<double> adhesion(double kilopascal) {
  return *effects::Values<double>::create(
      {effects::with_amplitude(effects::wall_adhesion::kEffect, kilopascal * 1e3)});
}

double shows(const std::array<SlumpGenerator, 2>& numerics, const effects::Values<double>& effects) {
  const auto visibility = SlumpVisibility::at(numerics, {}, kKnown);
  if (!visibility) throw std::runtime_error("no derivatives at the truth");
  return visibility->of(effects).value().ratio;
}

TEST(SlumpVisibility, OfNothingIsTheLeast) {
  EXPECT_EQ(shows({measured(4), measured(5)}, {}), SlumpVisibility::kLeast);
}

// Less noise by half, and all shows twice as plainly but for what the parameters take up, of which as much is
// known as before.
TEST(SlumpVisibility, GrowsAsNoiseFalls) {
  const auto strong = adhesion(0.05);
  const double in_noise = shows({measured(4), measured(5)}, strong);
  const double in_less = shows({measured(4, 0.5 * kNoise), measured(5, 0.5 * kNoise)}, strong);
  EXPECT_GT(in_noise, 3.0);
  EXPECT_GT(in_less, 1.3 * in_noise);
  EXPECT_LT(in_less, 2.0 * in_noise + 1e-9);
}

// With the same numerics twice the two changes are one, whose size is their mean's; with different ones less
// is agreed upon than the changes' sizes would have it.
TEST(SlumpVisibility, IsWhatTwoNumericsAgreeOn) {
  const auto weak = adhesion(0.01);
  const double four = shows({measured(4), measured(4)}, weak);
  const double five = shows({measured(5), measured(5)}, weak);
  const double both = shows({measured(4), measured(5)}, weak);
  EXPECT_LT(both, std::sqrt(four * five));
  EXPECT_GT(both, 0.3 * std::sqrt(four * five));
}

}  // namespace
}  // namespace isotach::bench
