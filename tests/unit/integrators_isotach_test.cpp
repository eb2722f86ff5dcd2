// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Isotachs: against integration at constant rate, and the spacing that the viscosity index means.
#include <gtest/gtest.h>

#include "integrators/isotach.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::Law;
using tests::set_a;
using tests::State;
using tests::stress_kPa;

constexpr double kRate = 1e-6;  // 1/s

TEST(Isotach, IsWhereLongConstantRateCompressionEnds) {
  const Law law(set_a(0.1));
  const Isotach isotach = Isotach::create(law.parameters(), kRate).value();
  const State end =
      tests::strained(law, {stress_kPa(100.0, 65.0, 65.0), 1.5}, tests::compression_rate(kRate, 0.0, 0.0),
                      0.4 / kRate, tests::tight(Method::fellin_ostermann));
  EXPECT_NEAR(isotach.axial_stress_at(end.void_ratio) / -end.stress[0], 1.0, 1e-6);
  EXPECT_NEAR(isotach.void_ratio_at(-end.stress[0]), end.void_ratio, 1e-6);
  EXPECT_NEAR(isotach.K0(), end.stress[1] / end.stress[0], 1e-6);
  EXPECT_NEAR(isotach.ocr(), law.overconsolidation_ratio(end), 1e-6);
}

TEST(Isotach, TenfoldRateMovesItByTenToIvInStress) {
  const Law law(set_a(0.0));
  const Isotach slow = Isotach::create(law.parameters(), kRate).value();
  const Isotach fast = Isotach::create(law.parameters(), 10.0 * kRate).value();
  EXPECT_NEAR(fast.axial_stress_at(1.2) / slow.axial_stress_at(1.2), std::pow(10.0, law.parameters().I_v()),
              1e-12);
}

TEST(Isotach, RefusesARateThatIsNone) {
  EXPECT_FALSE(Isotach::create(set_a(0.0), 0.0));
}

}  // namespace
}  // namespace isotach::integrators
