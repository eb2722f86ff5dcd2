// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The studies themselves: that they measure what they say, and can fail.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "verification/convergence.hpp"
#include "verification/named_paths.hpp"
#include "verification/printed_variants.hpp"
#include "verification/random_path.hpp"
#include "verification/random_paths.hpp"
#include "verification/reference_rows.hpp"

namespace isotach::verification {
namespace {

TEST(Check, PassesWithinItsToleranceAndNeverForNaN) {
  EXPECT_TRUE((Check{"", "", "", 1.0, 1.1, 0.1 + 1e-15}.pass()));
  EXPECT_FALSE((Check{"", "", "", 1.0, 1.2, 0.1}.pass()));
  EXPECT_FALSE((Check{"", "", "", 1.0, std::nan(""), 0.1}.pass()));
  EXPECT_FALSE((Check{"", "", "", 0.0, 1.0, std::nan("")}.pass()));
}

TEST(FitOrder, IsTheSlopeInLogarithmsWithStudentsInterval) {
  // exact powers have no interval
  const ObservedOrder exact = fit_order({1.0, 0.5, 0.25, 0.125}, {3.0, 0.75, 0.1875, 0.046875});
  EXPECT_NEAR(exact.order, 2.0, 1e-13);
  EXPECT_NEAR(exact.half_width, 0.0, 1e-6);
  // ln(step) = -1, 0, 1 and ln(error) = 0, 0, 1 by hand: slope 1/2, residual sum of squares 1/6, t(1)
  // = 12.706
  const ObservedOrder rough = fit_order({std::exp(-1.0), 1.0, std::exp(1.0)}, {1.0, 1.0, std::exp(1.0)});
  EXPECT_NEAR(rough.order, 0.5, 1e-14);
  EXPECT_NEAR(rough.half_width, 12.706 * std::sqrt(1.0 / 6.0 / 2.0), 1e-12);
  EXPECT_THROW(static_cast<void>(fit_order({1.0, 0.5}, {1.0, 0.25})), std::invalid_argument);
}

TEST(RandomPath, IsTheSameForTheSameSeedAndIndexOnly) {
  const Path a = random_path(7, 12);
  const Path b = random_path(7, 12);
  EXPECT_EQ(a.start.stress, b.start.stress);
  EXPECT_EQ(a.increments.size(), b.increments.size());
  EXPECT_NE(a.start.stress, random_path(8, 12).start.stress);
  EXPECT_NE(a.start.stress, random_path(7, 13).start.stress);
}

TEST(RandomPath, StaysWithinTheRangesItStatesAndReachesTheirEnds) {
  double least_ocr = HUGE_VAL;
  double largest_ocr = 0.0;
  double largest_ratio = 0.0;
  double least_rate = HUGE_VAL;
  double largest_rate = 0.0;
  double least_I_v = HUGE_VAL;
  int holds = 0;
  int reversals = 0;
  int inclined = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Path path = random_path(1, i);
    const Law law(path.parameters);
    ASSERT_TRUE(law.in_domain(path.start));
    const auto upright = law.measures(path.start.stress);
    const double q = std::sqrt(1.5) * model::deviator<double, 6>(path.start.stress).norm();
    largest_ratio = std::max(largest_ratio, q / (upright.F * law.critical_ratio() * upright.p));
    const double ocr = law.overconsolidation_ratio(path.start);
    least_ocr = std::min(least_ocr, ocr);
    largest_ocr = std::max(largest_ocr, ocr);
    least_I_v = std::min(least_I_v, path.parameters.I_v());
    EXPECT_LE(driven_strain(path), 0.5 + 1e-12);
    inclined += path.start.omega.norm() > 0.0 ? 1 : 0;
    Vector6 last = Vector6::Zero();
    for (const auto& increment : path.increments) {
      const double rate = increment.strain_rate.norm();
      if (rate == 0.0) {
        ++holds;
        continue;
      }
      least_rate = std::min(least_rate, rate);
      largest_rate = std::max(largest_rate, rate);
      if (last.norm() > 0.0 && increment.strain_rate.normalized().dot(last) < -1.0 + 1e-12) ++reversals;
      last = increment.strain_rate.normalized();
    }
  }
  EXPECT_GE(least_ocr, 0.8 - 1e-9);
  EXPECT_LT(least_ocr, 0.81);
  EXPECT_LE(largest_ocr, 50.0 + 1e-6);
  EXPECT_GT(largest_ocr, 49.0);
  EXPECT_LE(largest_ratio, 0.95 + 1e-9);
  EXPECT_GT(largest_ratio, 0.94);
  EXPECT_LT(least_rate, 2e-9);
  EXPECT_GT(largest_rate, 5e2);
  EXPECT_LT(least_I_v, 0.0101);
  EXPECT_GT(holds, 500);
  EXPECT_GT(reversals, 500);
  EXPECT_GT(inclined, 500);
}

TEST(RandomPaths, ErrorFallsWithTheTolerance) {
  std::vector<double> medians;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const auto study = random_path_study({3, 60, tolerance, 0, 2}, {}, nullptr);
    EXPECT_EQ(study.count(PathOutcome::failed), 0U);
    medians.push_back(quantile(study.errors_over_tolerance(), 0.5) * tolerance);
  }
  EXPECT_NEAR(std::log10(medians[0] / medians[1]), 1.0, 0.4);
  EXPECT_NEAR(std::log10(medians[1] / medians[2]), 1.0, 0.4);
}

TEST(RandomPaths, DoNotDependOnThreads) {
  const auto one = random_path_study({5, 200, 1e-4, 0, 1}, {}, nullptr);
  const auto two = random_path_study({5, 200, 1e-4, 0, 2}, {}, nullptr);
  for (std::size_t i = 0; i < one.records.size(); ++i) EXPECT_EQ(one.records[i].error, two.records[i].error);
}

TEST(PrintedVariants, WithoutSlipsAreTheSchemeItself) {
  const Path path{"",
                  set_a(0.1),
                  {principal_stress_kPa(100.0, 70.0, 80.0), 1.5},
                  {principal_strain(1e-6, -4e-7, 1e-7, 2e4)}};
  const Law law(path.parameters);
  const auto printed = printed_adaptive(law, path.start, path.increments.front(), 1e-6, {});
  Options options;
  options.fellin_ostermann.estimate_share = 1.0;
  options.fellin_ostermann.absolute_stress = 0.0;
  const auto end = follow(path, options);
  ASSERT_TRUE(end);
  EXPECT_EQ(printed.accepted, end->statistics.accepted);
  EXPECT_EQ(printed.rejected, end->statistics.rejected);
  EXPECT_LE(achieved_error(printed.state, end->state), 1e-12);
}

TEST(PrintedVariants, ModifiedEulerAsPrintedAdvancesTwice) {
  // ln(1+e) is linear in time: whatever the substeps, it moves by tr D times the time advanced
  const Path path{
      "", set_a(), {principal_stress_kPa(100.0, 100.0, 100.0), 1.5}, {principal_strain(1e-6, 0.0, 0.0, 1e4)}};
  const Law law(path.parameters);
  for (const int n : {200, 2000}) {
    EXPECT_NEAR(printed_fixed(law, path.start, path.increments.front(), n, {.modified_euler = true}).advanced,
                2.0, 1e-3);
    EXPECT_NEAR(printed_fixed(law, path.start, path.increments.front(), n, {}).advanced, 1.0, 1e-6);
  }
}

TEST(PrintedVariants, RejectionAsPrintedKeepsNoSubstepThatMeetsItsTolerance) {
  const Law law(set_a());
  const auto small = principal_strain(1e-6, 0.0, 0.0, 1.0);
  const State start{principal_stress_kPa(100.0, 100.0, 100.0), 1.5};
  const auto printed = printed_adaptive(law, start, small, 1e-4, {.rejection = true}, 1.0, 1000);
  EXPECT_FALSE(printed.finished);
  EXPECT_EQ(printed.accepted, 0);
}

TEST(ReferenceTable, ChecksAllowTenTolerancesPerTenthOfStrainAndHalfADigit) {
  ReferenceTable table{{{integrators::Method::fellin_ostermann, 1e-6}, {integrators::Method::cvode, 1e-10}},
                       {{"row", 100.0, 5e-7, 0.05, {100.0004, 100.0}}}};
  const auto checks = checks_of(table);
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_NEAR(checks[0].tolerance, 10.0 * 1e-6 * 0.5 * 100.0 + 5e-7, 1e-12);
  EXPECT_TRUE(checks[0].pass());
  EXPECT_NEAR(checks[1].tolerance, 1e-4 + 5e-7, 1e-12);
}

}  // namespace
}  // namespace isotach::verification
