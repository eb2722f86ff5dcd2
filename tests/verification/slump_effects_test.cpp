// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Effects in whole slumps: nothing at zero, growing from there, in the sense their words have.
#include "datasets/slump_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "datasets/slump_file.hpp"
#include "effects/basal_slip.hpp"
#include "effects/bleeding.hpp"
#include "effects/lift_delay.hpp"
#include "effects/water_layering.hpp"
#include "mpm/setup_fields.hpp"
#include "mpm/slump.hpp"

namespace isotach::mpm {
namespace {

effects::Values<double> only(const effects::Effect& effect, double amplitude) {
  return *effects::Values<double>::create({effects::with_amplitude(effect, amplitude)});
}

class SlumpEffect : public testing::TestWithParam<const effects::Effect*> {
 protected:
  SlumpEffect() {
    setup_.numerics.cell_size = 0.013;
    setup_.times = {0.3, 0.6, 1.2, 3.0};
  }
  [[nodiscard]] SlumpResult run(const SlumpSetup& setup) const {
    auto result = run_slump(file_.material, setup);
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
  }
  [[nodiscard]] SlumpResult run(const effects::Effect& effect, double amplitude) const {
    return run(datasets::with_effects(setup_, only(effect, amplitude)));
  }

  const datasets::SlumpFile file_ = datasets::read_slump_file(std::filesystem::path(ISOTACH_SOURCE_DIR) /
                                                              "datasets/checks/slump-test-1.toml");
  SlumpSetup setup_ = file_.setup;
};

/// Largest change (m) of height and toe.
double change(const SlumpResult& a, const SlumpResult& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.outlines.size(); ++i) {
    largest = std::max(largest, std::abs(a.outlines[i].height() - b.outlines[i].height()));
    largest = std::max(largest, std::abs(a.outlines[i].toe() - b.outlines[i].toe()));
  }
  return largest;
}

std::string text_of(const SlumpSetup& setup) {
  std::string text;
  visit_fields(setup, [&](std::string_view name, const auto& value) {
    text += name;
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) text += std::to_string(value);
  });
  return text;
}

TEST_P(SlumpEffect, IsNothingAtZeroAndGrowsFromThere) {
  const effects::Effect& effect = *GetParam();
  EXPECT_EQ(text_of(datasets::with_effects(setup_, only(effect, 0.0))), text_of(setup_));
  const double typical = effect.parameters[0].typical_si();
  const SlumpResult base = run(setup_);
  // an outline of some dozen points can jump by a part of a cell's point, even for a small cause
  EXPECT_LT(change(base, run(effect, 1e-6 * typical)), 2e-4);
  const double typically = change(base, run(effect, typical));
  EXPECT_GT(typically, 2e-5) << "it does not show";
  EXPECT_LT(typically, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, SlumpEffect, testing::ValuesIn([] {
                           std::vector<const effects::Effect*> all;
                           for (const effects::Effect* effect : effects::catalogue()) {
                             if (effect->test == effects::TestKind::slump) all.push_back(effect);
                           }
                           return all;
                         }()),
                         [](const auto& one) { return std::string(one.param->name); });

using Slumps = SlumpEffect;

TEST_F(Slumps, OfMudThatSticksLessRunFurtherWhateverTheSlip) {
  setup_.numerics.cell_size = 0.0065;
  setup_.times = {1.0};
  double before = 0.0;
  for (const double length : {1e-3, 1e-2, 3e-2, 0.1}) {
    const SlumpResult result = run(effects::basal_slip::kEffect, length);
    EXPECT_GT(result.outlines.back().toe(), before) << length;
    EXPECT_LT(result.energy_error, 0.08) << length;
    before = result.outlines.back().toe();
  }
}

// Whatever the layers, mud in a mould that has not been lifted is at rest.
TEST_F(Slumps, OfLayeredMudStandInTheMouldUntilItRises) {
  setup_.mould.lift_delay = 10.0;
  setup_.times = {0.05, 0.3};
  for (const double gradient : {-0.5, 0.0, 0.5}) {
    const SlumpResult result = run(effects::water_layering::kEffect, gradient);
    for (const Outline& outline : result.outlines) {
      EXPECT_NEAR(outline.height(), setup_.mould.fill_height, 4e-4) << gradient;
      EXPECT_NEAR(outline.toe(), 0.5 * setup_.mould.diameter, 4e-4) << gradient;
    }
  }
}

TEST_F(Slumps, OfMudThatBleedsLoseVolume) {
  setup_.times = {10.0};
  const double kept = run(effects::bleeding::kEffect, 0.0).volume_error;
  const double bled = run(effects::bleeding::kEffect, 0.5).volume_error;
  EXPECT_GT(bled, kept + 0.002);
}

TEST_F(Slumps, WhoseMouldStartsLaterAreTheSameThatMuchLater) {
  constexpr double kDelay = 0.25;
  setup_.mould.lift_delay = 0.1;  // long enough to settle in the mould
  setup_.times = {0.4, 0.9};
  const SlumpResult first = run(setup_);
  for (double& time : setup_.times) time += kDelay;
  const SlumpResult later = run(effects::lift_delay::kEffect, kDelay);
  EXPECT_LT(change(first, later), 1e-3);
}

}  // namespace
}  // namespace isotach::mpm
