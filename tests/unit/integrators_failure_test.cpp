// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Integration failures are results: their kind, time and last state, for both integrators.
#include <gtest/gtest.h>

#include <string>

#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::p_kPa;
using tests::set_a;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

class IntegrationFailure : public testing::TestWithParam<Method> {
 protected:
  const Law law_{set_a()};
  Options options_;
  void SetUp() override { options_.method = GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(EveryIntegrator, IntegrationFailure, testing::ValuesIn(kMethods),
                         [](const auto& method) { return tests::test_name(method.param); });

TEST_P(IntegrationFailure, StartOutsideTheDomainIsSaidAtTimeZero) {
  for (const State& start :
       {State{stress_kPa(0.0, 0.0, 0.0), 1.5}, State{stress_kPa(-10.0, 5.0, 4.0), 1.5},
        State{stress_kPa(100.0, 100.0, 100.0), -0.1}, State{stress_kPa(400.0, -20.0, -20.0), 1.5}}) {
    const auto end =
        integrate(law_, start, strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 1e3), options_);
    ASSERT_FALSE(end);
    EXPECT_EQ(end.error().kind, FailureKind::outside_domain);
    EXPECT_EQ(end.error().time, 0.0);
    EXPECT_EQ(end.error().last_state.stress, start.stress);
    EXPECT_EQ(end.error().last_state.void_ratio, start.void_ratio);
  }
}

TEST_P(IntegrationFailure, NaNInTheIncrementIsAFailureNotANumber) {
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  auto by_strain = strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 1e3);
  by_strain.strain_rate[4] = std::nan("");
  EXPECT_FALSE(integrate(law_, start, by_strain, options_));
  Increment<double> by_stress;
  by_stress.duration = 1e3;
  by_stress.stress_controlled[1] = true;
  by_stress.stress_rate[1] = std::nan("");
  EXPECT_FALSE(integrate(law_, start, by_stress, options_));
}

TEST_P(IntegrationFailure, LimitOfSubstepsEndsWithTheLastStateReached) {
  options_.fellin_ostermann.max_substeps = 20;
  options_.cvode.max_steps = 20;
  options_.rosenbrock.relative = 1e-10;  // or it would be there in less
  options_.rosenbrock.max_substeps = 20;
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto increment = strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 1e5);
  const auto end = integrate(law_, start, increment, options_);
  ASSERT_FALSE(end);
  const Failure& failure = end.error();
  EXPECT_EQ(failure.kind, FailureKind::too_many_substeps);
  EXPECT_GT(failure.time, 0.0);
  EXPECT_LT(failure.time, 1e5);
  // the last state belongs to the time given: 1 + e = 2.5 exp(-r t)
  EXPECT_NEAR(1.0 + failure.last_state.void_ratio, 2.5 * std::exp(-1e-6 * failure.time), 1e-7);
}

TEST_P(IntegrationFailure, UnloadingIntoTensionStopsWherePressureVanishes) {
  // p = 100 kPa falls by 1 kPa/s and vanishes after 100 s
  const State start{stress_kPa(100.0, 100.0, 100.0), 0.2};
  Increment<double> unload;
  unload.duration = 150.0;
  unload.stress_rate.head<3>().setConstant(1e3);
  unload.stress_controlled.fill(true);
  const auto end = integrate(law_, start, unload, options_);
  ASSERT_FALSE(end);
  const Failure& failure = end.error();
  EXPECT_NE(failure.kind, FailureKind::outside_domain);  // the start was inside
  EXPECT_NEAR(failure.time, 100.0, 1e-6);
  EXPECT_TRUE(law_.in_domain(failure.last_state));
  EXPECT_NEAR(p_kPa(failure.last_state), 100.0 - failure.time, 1e-9);
  EXPECT_EQ(p_kPa(start), 100.0);
}

TEST_P(IntegrationFailure, MessageSaysWhenWhereAndWhy) {
  const auto end = integrate(law_, {stress_kPa(-3.0, -3.0, -3.0), 1.5},
                             strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 1e3), options_);
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error().message(),
            "integration failed 0 s into the increment, at p = -3 kPa, e = 1.5: the state is outside the "
            "law's domain "
            "(p > 0, q < 3p, e > 0, (3/2) Omega:Omega < M^2, free strain rates solvable)");
}

TEST(IntegratorNames, AreThoseOfTheCommandLine) {
  EXPECT_EQ(name(Method::fellin_ostermann), "fellin-ostermann");
  EXPECT_EQ(name(Method::cvode), "cvode");
}

}  // namespace
}  // namespace isotach::integrators
