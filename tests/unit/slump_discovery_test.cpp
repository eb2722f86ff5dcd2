// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Discovery in slumps whose simulation is a formula: what it names, what it does not, and the search by
// secants behind it.
#include "discovery/slump_discovery.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "datasets/slump_effects.hpp"
#include "discovery/limits.hpp"
#include "effects/bleeding.hpp"
#include "effects/wall_adhesion.hpp"
#include "effects/yield_stress.hpp"
#include "tests/set_a.hpp"

namespace isotach::discovery {
namespace {

using enum model::ParameterId;

constexpr double kReading = 8e-4;  // m

model::Parameters<double> material(double viscosity_index, double factor) {
  auto values = model::set_a_values();
  values[I_v] = viscosity_index;
  values[C_1] = factor;
  return model::Parameters<double>::create(values).value();
}

constexpr double kFine = 5.5e-3;  // m, cells that make no error in this world

/// A mound of the fill's volume. I_v and C_1 change how high it is; adhesion holds up a shoulder until the
/// mould has gone, a yield stress and drainage, alike, stop it late, layers move its bulge. Large cells make
/// it too high.
tl::expected<mpm::SlumpResult, mpm::RunFailure> mound(const std::string& /*test*/,
                                                      const model::Parameters<double>& parameters,
                                                      const mpm::SlumpSetup& setup) {
  mpm::SlumpResult result;
  const double fill = setup.mould.fill_height;
  for (const double time : setup.times) {
    const double lifting = std::exp(-time * setup.mould.lift_speed / fill);
    const double late = std::log1p(time);
    const double height =
        fill * (0.5 + 0.1 * setup.wander.in_time(mpm::WanderSlot::strength_in_time, time) +
                0.15 * std::log(parameters.I_v() / 0.03) - 0.03 * late -
                0.8 * (parameters.C_1() - 0.05) * lifting) +
        2e-4 * setup.wall_at(time).adhesion * lifting +
        0.3 * std::max(0.0, setup.numerics.cell_size - kFine) +
        fill * late * (1e-3 * setup.effects.resistance.yield_stress + 0.04 * setup.effects.draining_rate);
    const double power =
        2.0 + 0.02 * setup.wall_at(time).adhesion * lifting + 0.5 * setup.effects.void_ratio_gradient;
    const double radius = 0.5 * setup.mould.diameter;
    // volume: pi toe^2 height (1 - 2/(power + 2))
    const double toe = radius * std::sqrt(fill / (height * (1.0 - 2.0 / (power + 2.0))));
    mpm::Outline outline{time, {}};
    for (int i = 0; i <= 60; ++i) {
      const double r = toe * (1.0 - i / 60.0);
      outline.points.push_back({r, height * (1.0 - std::pow(r / toe, power))});
    }
    result.outlines.push_back(std::move(outline));
  }
  mpm::HistoryRow end{};  // at rest
  end.time = setup.times.back();
  end.potential = 1.0;
  result.history.push_back(end);
  return result;
}

/// Five slumps, the last held out, of mud with effects, read with noise; `bend` lifts the outlines' middle as
/// no effect does.
datasets::Study study_of(const effects::Values<double>& hidden, unsigned seed, double bend = 0.0) {
  datasets::FitSettings fit;
  fit.oedometer = {};
  fit.gauge = datasets::Gauge::fixed;
  datasets::Study study{.file = {},
                        .material = material(0.03, 0.05),
                        .fit = fit,
                        .oedometer_tests = {},
                        .slump_tests = {},
                        .assumptions = {}};
  std::mt19937 random(seed);
  std::normal_distribution<double> reading(0.0, kReading);
  for (int k = 0; k < 5; ++k) {
    datasets::SlumpTest test{"slump-" + std::to_string(k + 1), {}, {}, {}, {kReading, kReading, 0.0}, k == 4};
    test.setup.mould.fill_height = k % 2 == 0 ? 0.14 : 0.07;
    test.setup.mould.lift_speed = k < 2 || k == 4 ? 0.06 : 0.01;
    test.setup.mud.void_ratio = 4.0;
    test.setup.times = {0.5, 1.0, 3.0, 10.0, 30.0};
    const auto run = *mound("", material(0.032, 0.06), datasets::with_effects(test.setup, hidden));
    for (const mpm::Outline& outline : run.outlines) {
      datasets::Outline read{outline.time, {}};
      for (const mpm::OutlinePoint& point : experiments::resampled(outline.points, 30)) {
        const double share = point.r / outline.toe();
        read.points.push_back(
            {point.r + reading(random), point.z + reading(random) + bend * std::sin(12.0 * share)});
      }
      test.outlines.push_back(std::move(read));
    }
    study.slump_tests.push_back(std::move(test));
  }
  return study;
}

SlumpDiscovery discovered(const datasets::Study& study) {
  SlumpDiscoverOptions options;
  options.simulate = mound;
  auto found = discover_slump(study, options);
  EXPECT_TRUE(found.has_value()) << found.error().message;
  return std::move(*found);
}

effects::Values<double> only(const effects::Effect& effect, double amplitude) {
  return *effects::Values<double>::create({effects::with_amplitude(effect, amplitude)});
}

TEST(SlumpDiscovery, FindsNothingWhereNothingIsHidden) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SlumpDiscovery found = discovered(study_of({}, seed));
    EXPECT_EQ(found.verdict, Verdict::adequate) << seed;
    EXPECT_NEAR(found.base.candidate.parameters->I_v(), 0.032, 1e-3) << seed;
    EXPECT_NEAR(found.base.gap.fitted, 1.0, 0.2) << seed;
  }
}

TEST(SlumpDiscovery, NamesTheAdhesionThatIsHidden) {
  constexpr double kAdhesion = 40.0;  // Pa
  int held = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SlumpDiscovery found = discovered(study_of(only(effects::wall_adhesion::kEffect, kAdhesion), seed));
    ASSERT_EQ(found.verdict, Verdict::named) << seed;
    ASSERT_EQ(found.amplitudes.size(), 1U);
    const AmplitudeInterval& interval = found.amplitudes.front();
    if (interval.lower < kAdhesion && interval.upper > kAdhesion) ++held;
    EXPECT_LT(interval.upper - interval.lower, 0.4 * kAdhesion);
    const SlumpTrial& best = found.trials[*found.chosen];
    ASSERT_EQ(name_of(best.candidate), "wall_adhesion") << seed;
    const double amplitude =
        best.candidate.effects[effects::ParameterRef{&effects::wall_adhesion::kEffect, 0}];
    EXPECT_NEAR(amplitude, kAdhesion, 0.1 * kAdhesion) << seed;
    EXPECT_GT(found.base.gap.fitted, 2.0);
    EXPECT_NEAR(best.gap.fitted, 1.0, 0.2);
    EXPECT_GT(found.base.gap.held_out, 2.0);
    EXPECT_NEAR(best.gap.held_out, 1.0, 0.25);
    ASSERT_FALSE(found.disagreement.empty());
    EXPECT_LE(found.disagreement.front().to, 10.0) << "late, when the mould has long gone";
    EXPECT_LT(std::abs(found.disagreement.front().mean_by_best),
              0.5 * std::abs(found.disagreement.front().mean));
  }
  EXPECT_GE(held, 4) << "of five intervals of 95 %";
}

// Base and explanation are least squares of nested models: what the one's chi-squared has more than the
// other's is the square of what lies between their fits.
TEST(SlumpDiscovery, RanksPlacesByWhatTheExplanationChanges) {
  const SlumpDiscovery found = discovered(study_of(only(effects::wall_adhesion::kEffect, 40.0), 3));
  ASSERT_EQ(found.verdict, Verdict::named);
  double total = 0.0;
  for (std::size_t k = 0; k < found.disagreement.size(); ++k) {
    const SlumpDisagreement& place = found.disagreement[k];
    EXPECT_EQ(place.explained.has_value(), !place.held_out);
    if (k > 0) {
      EXPECT_GE(found.disagreement[k - 1].explained, place.explained);
    }
    if (place.explained) total += std::pow(*place.explained, 2);
  }
  const double gain = found.base.candidate.chi_squared - found.trials[*found.chosen].candidate.chi_squared;
  EXPECT_GT(gain, 100.0);
  EXPECT_NEAR(total / gain, 1.0, 0.1);
  EXPECT_TRUE(found.disagreement.front().lifting) << "when adhesion acts";
}

// Of wall, base and strength it is the wall that would have to be another, in every test by as much.
TEST(SlumpDiscovery, SaysWhatWouldHaveToWander) {
  constexpr double kAdhesion = 40.0;  // Pa
  const SlumpDiscovery found = discovered(study_of(only(effects::wall_adhesion::kEffect, kAdhesion), 2));
  ASSERT_TRUE(found.wandering);
  EXPECT_LT(found.wandering->p_value, 0.002);
  ASSERT_EQ(found.wandering->slots.size(), 5U);
  const WanderingSlot& first = found.wandering->slots.front();
  ASSERT_EQ(first.slot.name, "wall_adhesion");
  ASSERT_EQ(first.curves.size(), 4U) << "one for each fitted test";
  for (const WanderCurve& curve : first.curves) {
    ASSERT_EQ(curve.at.size(), kWanderKnots);
    EXPECT_LT(curve.at.back(), 30.0) << "a wall acts while the mould is lifted";
    for (std::size_t k = 0; k < curve.at.size(); ++k) {
      if (curve.at[k] < 0.5) continue;  // before the first outline, which says little of what came before
      EXPECT_LT(curve.std_error[k], 10.0);
      EXPECT_NEAR(curve.change[k], kAdhesion, 0.1 * kAdhesion + 4.0 * curve.std_error[k])
          << curve.test << " after " << curve.at[k] << " s";
    }
  }
}

TEST(SlumpDiscovery, LetsNothingWanderWhereTheModelSuffices) {
  EXPECT_FALSE(discovered(study_of({}, 1)).wandering);
}

/// The study by cells that are 3 mm off, and the present ones for a reference.
datasets::Study by_quick_cells(datasets::Study study) {
  for (datasets::SlumpTest& test : study.slump_tests) {
    test.reference = test.setup.numerics;
    test.setup.numerics.cell_size = kFine + 0.01;
  }
  return study;
}

TEST(SlumpDiscovery, FindsNothingByQuickCellsThatAreCorrected) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SlumpDiscovery found = discovered(by_quick_cells(study_of({}, seed)));
    EXPECT_EQ(found.verdict, Verdict::adequate) << seed;
    EXPECT_TRUE(found.by_gain);
    EXPECT_NEAR(found.base.candidate.parameters->I_v(), 0.032, 1e-3) << seed;
    EXPECT_NEAR(found.base.gap.fitted, 1.0, 0.2) << seed;
    EXPECT_NEAR(found.base.gap.held_out, 1.0, 0.25) << seed;
  }
}

// An adhesion that leaves every test within 1.3 times its noise.
TEST(SlumpDiscovery, WithAReferenceHeedsGainsThatTheSizeOfTheMisfitHides) {
  constexpr double kAdhesion = 9.0;  // Pa
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const datasets::Study study = study_of(only(effects::wall_adhesion::kEffect, kAdhesion), seed);
    EXPECT_EQ(discovered(study).verdict, Verdict::adequate) << seed;
    const SlumpDiscovery found = discovered(by_quick_cells(study));
    ASSERT_EQ(found.verdict, Verdict::named) << seed;
    const SlumpTrial& best = found.trials[*found.chosen];
    ASSERT_EQ(name_of(best.candidate), "wall_adhesion") << seed;
    EXPECT_NEAR((best.candidate.effects[effects::ParameterRef{&effects::wall_adhesion::kEffect, 0}]),
                kAdhesion, 0.3 * kAdhesion)
        << seed;
  }
}

// In this world a yield stress and drainage do the same.
TEST(SlumpDiscovery, CallsAmbiguousWhatTwoEffectsDoAlike) {
  const SlumpDiscovery found = discovered(study_of(only(effects::yield_stress::kEffect, 40.0), 3));
  ASSERT_EQ(found.verdict, Verdict::ambiguous);
  std::vector<std::string> names;
  for (const std::size_t k : found.equivalent) names.push_back(name_of(found.trials[k].candidate));
  EXPECT_NE(std::find(names.begin(), names.end(), "yield_stress"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "bleeding"), names.end());
  EXPECT_FALSE(found.chosen);
  EXPECT_TRUE(found.next);
}

TEST(SlumpDiscovery, NamesNothingForWhatNoEffectDoes) {
  const SlumpDiscovery found = discovered(study_of({}, 4, 4e-3));
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_FALSE(found.chosen);
  EXPECT_GT(found.base.gap.fitted, 1.3);
}

TEST(SlumpDiscovery, TakesWhatOedometersKnowForKnown) {
  datasets::Study study = study_of({}, 1);
  SlumpDiscoverOptions options;
  options.simulate = mound;
  MaterialKnowledge knowledge{material(0.027, 0.06), {}};
  knowledge.priors[static_cast<std::size_t>(I_v)] = datasets::Prior{0.027, 0.027 * 1e-4};
  options.knowledge = knowledge;
  const auto found = discover_slump(study, options);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->base.candidate.parameters->I_v(), 0.027, 1e-4) << "held by the prior";
  EXPECT_NE(found->verdict, Verdict::adequate);
}

}  // namespace
}  // namespace isotach::discovery
