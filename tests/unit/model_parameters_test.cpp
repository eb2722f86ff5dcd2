// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Parameters: what is admitted, and how what is not is named.
#include <gtest/gtest.h>

#include <cmath>

#include "model/parameters.hpp"
#include "tests/set_a.hpp"

namespace isotach::model {
namespace {

using tests::set_a_values;

std::optional<ParameterError> error_with(ParameterId id, double value) {
  auto values = set_a_values();
  values[id] = value;
  const auto parameters = Parameters<double>::create(values);
  if (parameters) return std::nullopt;
  return parameters.error();
}

TEST(Parameters, SetAIsAdmissibleAndKeepsItsValues) {
  const auto parameters = Parameters<double>::create(set_a_values());
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->e100(), 1.5);
  EXPECT_EQ(parameters->lambda(), 0.1);
  EXPECT_EQ(parameters->kappa(), 0.02);
  EXPECT_EQ(parameters->I_v(), 0.05);
  EXPECT_EQ(parameters->D_r(), 1e-6);
  EXPECT_EQ(parameters->phi_c(), 25.0 * std::numbers::pi / 180.0);
  EXPECT_EQ(parameters->C_1(), 0.0);
  EXPECT_EQ(parameters->lode(), LodeDependence::matsuoka_nakai);
}

TEST(Parameters, TableStandsInTheOrderOfTheIdsAndFindsNames) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kParameterTable[i].id), i);
    EXPECT_EQ(find_parameter(kParameterTable[i].name), kParameterTable[i].id);
  }
  EXPECT_EQ(find_parameter("D_r"), ParameterId::D_r);
  EXPECT_EQ(find_parameter("D_r_per_s"), std::nullopt);  // a key, not a name
  EXPECT_EQ(find_parameter(""), std::nullopt);
}

TEST(Parameters, ValueAtOrBelowLowerBoundIsRejectedByName) {
  for (const ParameterId id : {ParameterId::e100, ParameterId::lambda, ParameterId::kappa, ParameterId::I_v,
                               ParameterId::D_r, ParameterId::phi_c, ParameterId::C_1}) {
    SCOPED_TRACE(info(id).name);
    const auto below = error_with(id, -1e-9);
    ASSERT_TRUE(below);
    EXPECT_EQ(below->id, id);
    EXPECT_EQ(below->message().find(std::string(info(id).key) + " = -"), 0U) << below->message();
    const auto at = error_with(id, 0.0);
    if (id == ParameterId::C_1) {
      EXPECT_FALSE(at);  // the only bound that is itself admissible
    } else {
      ASSERT_TRUE(at);
      EXPECT_EQ(at->id, id);
    }
  }
}

TEST(Parameters, NaNAndInfinityAreRejectedByName) {
  for (const ParameterInfo& parameter : kParameterTable) {
    for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
      const auto error = error_with(parameter.id, value);
      ASSERT_TRUE(error) << parameter.name << " " << value;
      EXPECT_EQ(error->id, parameter.id);
    }
  }
}

TEST(Parameters, FrictionAngleMustBeBelowNinetyDegrees) {
  const double degree = std::numbers::pi / 180.0;
  EXPECT_FALSE(error_with(ParameterId::phi_c, 89.999 * degree));
  const auto error = error_with(ParameterId::phi_c, 90.0 * degree);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->id, ParameterId::phi_c);
  EXPECT_EQ(error->message(), "phi_c_deg = 90 is not admissible; accepted: > 0 deg and < 90 deg");
}

TEST(Parameters, KappaMustBeBelowLambda) {
  EXPECT_FALSE(error_with(ParameterId::kappa, 0.0999));
  for (const double kappa : {0.1, 0.2}) {
    const auto error = error_with(ParameterId::kappa, kappa);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->id, ParameterId::kappa);
    EXPECT_EQ(error->value, kappa);
    EXPECT_EQ(error->accepted, "> 0 and < lambda = 0.1");
  }
}

TEST(Parameters, C1MustLeaveASteadyCompression) {
  // 1 - kappa/lambda = 0.8
  EXPECT_FALSE(error_with(ParameterId::C_1, 0.7999));
  for (const double C_1 : {0.8001, 0.95, 1.0, 2.0}) {
    const auto error = error_with(ParameterId::C_1, C_1);
    ASSERT_TRUE(error) << C_1;
    EXPECT_EQ(error->id, ParameterId::C_1);
    EXPECT_EQ(error->value, C_1);
  }
}

TEST(Parameters, MessageNamesKeyValueAndRange) {
  EXPECT_EQ(error_with(ParameterId::D_r, -2e-7)->message(),
            "D_r_per_s = -2e-07 is not admissible; accepted: > 0 1/s and finite");
  EXPECT_EQ(error_with(ParameterId::C_1, -0.5)->message(),
            "C_1 = -0.5 is not admissible; accepted: >= 0 and < 1");
}

TEST(Parameters, JetsAreCheckedByTheirValueAndCastKeepsIt) {
  using Jet = ceres::Jet<double, 2>;
  ParameterValues<Jet> values;
  for (const ParameterInfo& parameter : kParameterTable)
    values[parameter.id] = Jet(set_a_values()[parameter.id], 1);
  values.lode = LodeDependence::none;
  const auto parameters = Parameters<Jet>::create(values);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->lambda().v[1], 1.0);
  const Parameters<double> plain = parameters->cast<double>();
  EXPECT_EQ(plain.lambda(), 0.1);
  EXPECT_EQ(plain.lode(), LodeDependence::none);
  EXPECT_EQ(plain.cast<Jet>().lambda().v[1], 0.0);
  values[ParameterId::lambda].a = 0.01;
  EXPECT_EQ(Parameters<Jet>::create(values).error().id, ParameterId::kappa);
}

}  // namespace
}  // namespace isotach::model
