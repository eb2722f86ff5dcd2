// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Fellin-Ostermann and CVODE against each other, point by point along element tests.
//
// Tolerance: CVODE runs at 1e-12, so the difference is Fellin-Ostermann's global error. At tolerance 1e-9
// that is about 1e-9 a stage; 2e-8 of |T| allows for its growth over up to five stages with reversals.
#include <gtest/gtest.h>

#include "integrators/element_test.hpp"
#include "tests/set_a.hpp"

namespace isotach::tests {
namespace {

using integrators::Increment;
using integrators::Stage;

constexpr double kRate = 1e-6;  // 1/s

Stage strain_stage(const Vector6& strain_rate, double duration) {
  return {"stage", integrators::strain_increment<double>(strain_rate, duration), 20};
}

void expect_agreement(const Law& law, const State& start, const std::vector<Stage>& stages) {
  auto options = tight(integrators::Method::fellin_ostermann);
  options.fellin_ostermann.relative = 1e-9;
  const auto a = integrators::run_element_test(law, start, stages, options);
  const auto b = integrators::run_element_test(law, start, stages, tight(integrators::Method::cvode));
  ASSERT_TRUE(a) << a.error().failure.message();
  ASSERT_TRUE(b) << b.error().failure.message();
  ASSERT_EQ(a->size(), 1 + 20 * stages.size());
  ASSERT_EQ(a->size(), b->size());
  for (std::size_t i = 0; i < a->size(); ++i) {
    const auto& row_a = (*a)[i];
    const auto& row_b = (*b)[i];
    EXPECT_EQ(row_a.time, row_b.time);
    EXPECT_LE((row_a.state.stress - row_b.state.stress).norm(), 2e-8 * row_b.state.stress.norm())
        << "row " << i;
    EXPECT_NEAR(row_a.state.void_ratio, row_b.state.void_ratio, 2e-8) << "row " << i;
    EXPECT_LE((row_a.strain - row_b.strain).norm(), 2e-8) << "row " << i;
  }
}

TEST(IntegratorsAgree, OedometerLoadUnloadRelaxReload) {
  const Law law(set_a(0.1));
  const Vector6 load = compression_rate(kRate, 0.0, 0.0);
  expect_agreement(law, {stress_kPa(100.0, 65.0, 65.0), 1.5},
                   {strain_stage(load, 1e5), strain_stage(-load, 2e4), strain_stage(Vector6::Zero(), 1e5),
                    strain_stage(10.0 * load, 5e3), strain_stage(load, 5e4)});
}

TEST(IntegratorsAgree, DrainedTriaxialByMixedControlWithUnloading) {
  const Law law(set_a(0.1));
  Increment<double> drained;
  drained.duration = 1e5;
  drained.strain_rate[0] = -kRate;
  drained.stress_controlled = {false, true, true, false, false, false};
  Increment<double> unload = drained;
  unload.duration = 5e3;
  unload.strain_rate[0] = kRate;
  Increment<double> creep = drained;
  creep.stress_controlled[0] = true;
  expect_agreement(law, {stress_kPa(100.0, 100.0, 100.0), 1.4},
                   {Stage{"shear", drained, 20}, Stage{"unload", unload, 20}, Stage{"creep", creep, 20}});
}

TEST(IntegratorsAgree, SimpleShearWithSpinInAllPlanes) {
  const Law law(set_a(0.1));
  Increment<double> shear;
  shear.duration = 5e5;
  shear.strain_rate << 0.0, 0.0, 0.0, 5e-7 * std::numbers::sqrt2, 2e-7, -1e-7;
  shear.spin << 5e-7, 2e-7 / std::numbers::sqrt2, -1e-7 / std::numbers::sqrt2;
  Increment<double> back = shear;
  back.strain_rate = -shear.strain_rate;
  back.spin = -shear.spin;
  expect_agreement(law, {stress_kPa(100.0, 80.0, 70.0), 1.5},
                   {Stage{"shear", shear, 20}, Stage{"back", back, 20}});
}

TEST(IntegratorsAgree, ShearAtConstantNormalStressWithSpin) {
  const Law law(set_a(0.05));
  Increment<double> shear;
  shear.duration = 3e5;
  shear.strain_rate[3] = 5e-7 * std::numbers::sqrt2;
  shear.spin[0] = 5e-7;
  shear.stress_controlled[1] = true;
  expect_agreement(law, {stress_kPa(70.0, 100.0, 70.0), 1.5}, {Stage{"shear", shear, 20}});
}

}  // namespace
}  // namespace isotach::tests
