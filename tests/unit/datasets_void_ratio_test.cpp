// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The initial void ratio by every route, its derivative, and what is assumed on the way.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/datasets_small_study.hpp"

namespace isotach::datasets {
namespace {

class VoidRatioKeysOfStudy : public SmallStudy {
 protected:
  VoidRatioKeysOfStudy() {
    folder_.write("crs.csv", "time_s,axial_strain,axial_stress_kPa\n0,0,4\n1,0.01,5\n2,0.02,6\n");
  }
  static std::string keys(std::string_view more) {
    return "data = \"crs.csv\"\nheight_mm = 20\ndiameter_mm = 50\n" + std::string(more) + "\n";
  }
};

TEST_F(VoidRatioKeysOfStudy, BulkDensityAndWaterContentNeedNoSaturation) {
  // By hand: dry density 1600/1.25 = 1280 kg/m3; e = 2700/1280 - 1 = 1.109375; S_r = 0.25 2.7/1.109375 =
  // 0.608
  const Study study =
      read_test(keys("bulk_density_g_per_cm3 = 1.6\nwater_content = 0.25\nspecific_gravity = 2.7"));
  const OedometerTest& test = study.oedometer_tests[0];
  EXPECT_NEAR(test.void_ratio, 1.109375, 1e-14);
  EXPECT_NE(test.void_ratio_source.find("degree of saturation 0.608"), std::string::npos);
  EXPECT_TRUE(assumes(study, "degree of saturation of 0.608, outside 0.9 to 1.05"));
  EXPECT_FALSE(assumes(study, "specific gravity not given"));
  // 1.8 g/cm3, w = 0.4: 2.7/(1.8/1.4) - 1 = 1.1, S_r = 1.08/1.1 = 0.98
  const Study ordinary =
      read_test(keys("bulk_density_g_per_cm3 = 1.8\nwater_content = 0.4\nspecific_gravity = 2.7"));
  EXPECT_NEAR(ordinary.oedometer_tests[0].void_ratio, 1.1, 1e-14);
  EXPECT_FALSE(assumes(ordinary, "degree of saturation"));
}

TEST_F(VoidRatioKeysOfStudy, TheDerivativeIsTheSlopeBetweenTwoSpecificGravities) {
  for (const std::string& route : {std::string("water_content = 0.4"), std::string("dry_mass_g = 40"),
                                   std::string("bulk_density_g_per_cm3 = 1.8\nwater_content = 0.4")}) {
    const auto at = [&](const char* gravity) {
      return read_test(keys(route + "\nspecific_gravity = " + gravity)).oedometer_tests[0];
    };
    const OedometerTest lower = at("2.6");
    const OedometerTest upper = at("2.8");
    EXPECT_NEAR(lower.void_ratio_per_specific_gravity.value(), (upper.void_ratio - lower.void_ratio) / 0.2,
                1e-12)
        << route;
  }
  const Study given = read_test(keys("void_ratio = 1.1"));
  EXPECT_FALSE(given.oedometer_tests[0].void_ratio_per_specific_gravity.has_value());
}

TEST_F(VoidRatioKeysOfStudy, AWetSoilsGrainsAreNotAssumedSilently) {
  expect_test_refused(keys("water_content = 3.0"), {"key specific_gravity in [[oedometer]]", "it is missing",
                                                    "soil = \"mineral\" | \"peat\""});
  const Study peat = read_test(keys("water_content = 3.0\nsoil = \"peat\""));
  EXPECT_NEAR(peat.oedometer_tests[0].void_ratio, 4.5, 1e-14);
  EXPECT_TRUE(assumes(peat, "specific gravity not given, 1.5 assumed (peat)"));
  const Study mineral = read_test(keys("water_content = 3.0\nsoil = \"mineral\""));
  EXPECT_NEAR(mineral.oedometer_tests[0].void_ratio, 7.95, 1e-14);
  EXPECT_TRUE(assumes(mineral, "specific gravity not given, 2.65 assumed"));
  EXPECT_NO_THROW(static_cast<void>(read_test(keys("water_content = 1.5"))));
}

TEST_F(VoidRatioKeysOfStudy, WhatDoesNotMakeAVoidRatioIsRefused) {
  expect_test_refused(keys("bulk_density_g_per_cm3 = 1.6"), {"key water_content", "it is missing"});
  expect_test_refused(keys("bulk_density_g_per_cm3 = 1.6\nvoid_ratio = 1"),
                      {"key bulk_density_g_per_cm3", "together with"});
  expect_test_refused(keys("bulk_density_g_per_cm3 = 1600\nwater_content = 0.4"),
                      {"key bulk_density_g_per_cm3", "1600 is out of range", ">= 0.5 and <= 5"});
  expect_test_refused(keys("bulk_density_g_per_cm3 = 4.5\nwater_content = 0.1\nspecific_gravity = 2.6"),
                      {"key bulk_density_g_per_cm3", "void ratio of -0.36"});
  expect_test_refused(keys("void_ratio = 1\nsoil = \"sand\""), {"key soil", "\"mineral\" or \"peat\""});
}

}  // namespace
}  // namespace isotach::datasets
