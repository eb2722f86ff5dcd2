// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [effects] of a study, and what [fit] may say of its parameters.
#include <gtest/gtest.h>

#include "effects/rate_dependent_viscosity.hpp"
#include "effects/seating.hpp"
#include "effects/temperature.hpp"
#include "tests/unit/datasets_small_study.hpp"

namespace isotach::datasets {
namespace {

constexpr std::string_view kTest = "data = \"t.csv\"\nheight_mm = 20\ndiameter_mm = 50\nvoid_ratio = 2\n";

class EffectsOfAStudy : public SmallStudy {
 protected:
  EffectsOfAStudy() {
    folder_.write("t.csv", "time_s,axial_strain,axial_stress_kPa\n1,0,10\n2,0.01,20\n3,0.02,30\n4,0.03,40\n");
  }
  Study with(const std::string& text, std::string_view test = kTest) const { return read_test(test, text); }
  /// Lines count from 9, the first of `text`.
  void refused(const std::string& text, std::initializer_list<std::string_view> parts,
               std::string_view test = kTest) const {
    expect_test_refused(test, parts, text);
  }
};

TEST_F(EffectsOfAStudy, AreReadInTheUnitsOfTheirKeys) {
  const Study study =
      with("[effects]\nseating = { delta_m = 2e-4, sigma_s_kPa = 15 }\nring_friction = { mu = 0 }\n");
  ASSERT_EQ(study.effects.chosen().size(), 2);
  EXPECT_EQ(study.effects.chosen()[0].effect->name, "ring_friction");
  const auto& seating = *study.effects.find(effects::seating::kEffect);
  EXPECT_EQ(seating[effects::seating::delta], 2e-4);
  EXPECT_EQ(seating[effects::seating::sigma_s], 15e3);
  EXPECT_TRUE(study.fit.oedometer_effects.empty());
  EXPECT_TRUE(with("").effects.empty());
  EXPECT_TRUE(with("[effects]\n").effects.empty());
}

TEST_F(EffectsOfAStudy, ConventionsHaveDefaults) {
  const Study study = with("[effects]\nrate_dependent_viscosity = { b = 0.1 }\n");
  EXPECT_EQ((*study.effects.find(
                effects::rate_dependent_viscosity::kEffect))[effects::rate_dependent_viscosity::D_ref],
            1e-6);  // D_r of the material
  const Study other = with("[effects]\nrate_dependent_viscosity = { b = 0.1, D_ref_per_s = 3e-5 }\n");
  EXPECT_EQ((*other.effects.find(
                effects::rate_dependent_viscosity::kEffect))[effects::rate_dependent_viscosity::D_ref],
            3e-5);
}

TEST_F(EffectsOfAStudy, MistakesAreNamedWithWhatIsAccepted) {
  refused("[effects]\nwind = { v = 1 }\n",
          {"study.toml:10: key wind in [effects]: it is unknown", "ring_friction, apparatus_compliance"});
  refused("[effects]\nring_friction = { mu = 0.1, nu = 1 }\n",
          {"study.toml:10", "nu in [effects.ring_friction]", "accepted: mu"});
  refused("[effects]\nring_friction = 0.1\n", {"study.toml:10", "ring_friction"});
  refused("[effects]\nring_friction = { mu = -0.1 }\n", {"mu", "-0.1 is out of range", ">= 0 and <= 0.6"});
  refused("[effects]\nseating = { delta_m = 1e-4 }\n", {"sigma_s_kPa", "missing"});
  refused("[effects]\nanisotropy = { Omega_0 = 0.6, C_2 = 10, C_3 = 2 }\n", {"C_3", "below 1/Omega_0"});
}

TEST_F(EffectsOfAStudy, NeedWhatTheyNeed) {
  refused("[effects]\nring_friction = { mu = 0.1 }\n",
          {"oedometer test t: diameter_mm", "the effect ring_friction needs it"},
          "data = \"t.csv\"\nheight_mm = 20\nvoid_ratio = 2\n");
  refused("[effects]\ntemperature = { a_per_K = 0.01 }\n",
          {"oedometer test t: column temperature_C", "the effect temperature needs it"});
}

TEST_F(EffectsOfAStudy, TheirParametersMayBeFitted) {
  const Study study = with(
      "[effects]\nseating = { delta_m = 1e-4, sigma_s_kPa = 15 }\n[fit]\noedometer = [\"lambda\", "
      "\"seating.delta_m\", \"seating.sigma_s_kPa\"]\n[fit.bounds]\n\"seating.sigma_s_kPa\" = [5, 50]\n");
  EXPECT_EQ(study.fit.oedometer, std::vector{model::ParameterId::lambda});
  ASSERT_EQ(study.fit.oedometer_effects.size(), 2);
  EXPECT_EQ(study.fit.oedometer_effects[0].parameter.name(), "seating.delta_m");
  EXPECT_FALSE(study.fit.oedometer_effects[0].bounds);
  ASSERT_TRUE(study.fit.oedometer_effects[1].bounds);
  EXPECT_EQ(study.fit.oedometer_effects[1].bounds->lower, 5e3);
  EXPECT_EQ(study.fit.oedometer_effects[1].bounds->upper, 50e3);
}

TEST_F(EffectsOfAStudy, OnlyThoseOfEffectsThatAreOnAndCanMove) {
  const std::string on = "[effects]\ngas = { S_g = 0.01 }\nrate_dependent_viscosity = { b = 0.1 }\n[fit]\n";
  refused(on + "oedometer = [\"lambda\", \"seating.delta_m\"]\n",
          {"study.toml:13", "\"seating.delta_m\" is of an effect that [effects] does not have", "gas.S_g"});
  refused(on + "oedometer = [\"rate_dependent_viscosity.D_ref_per_s\"]\n", {"convention"});
  refused(on + "oedometer = [\"gas.V\"]\n", {"\"gas.V\" is not a parameter"});
  refused(on + "oedometer = [\"gas.S_g\", \"gas.S_g\"]\n", {"occurs twice"});
  refused(on + "oedometer = [\"gas.S_g\"]\n[fit.bounds]\n\"gas.S_g\" = [0.02, 0.1]\n",
          {"[0.02, 0.1] leaves out the start value 0.01", "gas.S_g of [effects]"});
  refused(on + "oedometer = [\"gas.S_g\"]\n[fit.bounds]\n\"gas.S_g\" = [0, 0.9]\n", {"0.9 is out of range"});
  refused(on + "slump = [\"gas.S_g\"]\n", {"gas.S_g"});
}

}  // namespace
}  // namespace isotach::datasets
