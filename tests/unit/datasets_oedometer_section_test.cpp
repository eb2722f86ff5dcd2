// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// [[oedometer]] and [fit] of a study: how a fit starts, what it may move, and how the data are read.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "tests/unit/datasets_small_study.hpp"

namespace isotach::datasets {
namespace {

using model::ParameterId;

class OedometerSection : public SmallStudy {
 protected:
  OedometerSection() {
    folder_.write("crs.csv", "time_s,axial_strain,axial_stress_kPa\n1,0,4\n2,0.01,5\n3,0.02,6\n");
    folder_.write("pore.csv",
                  "time_s,axial_strain,axial_stress_kPa,base_pore_pressure_kPa\n1,0,4,3\n2,0.01,5,0.3\n"
                  "3,0.02,6,0.3\n");
    folder_.write("force.csv", "time_s,axial_strain,force_kN\n1,0,4\n2,0.01,5\n3,0.02,6\n");
  }
  static std::string keys(std::string_view more, std::string_view data = "crs.csv") {
    return "data = \"" + std::string(data) + "\"\nheight_mm = 20\ndiameter_mm = 50\nvoid_ratio = 1.2\n" +
           std::string(more) + "\n";
  }
  OedometerTest test_with(std::string_view more, std::string_view data = "crs.csv") const {
    return read_test(keys(more, data)).oedometer_tests[0];
  }
};

TEST_F(OedometerSection, InitialK0IsGivenFollowsARuleOrMoves) {
  const OedometerTest given = test_with("initial_K0 = 0.7");
  EXPECT_EQ(given.K0_rule, InitialK0::given);
  EXPECT_EQ(given.initial_K0, 0.7);
  EXPECT_FALSE(given.free_K0.moves);
  for (const auto& [text, rule] : {std::pair{"jaky", InitialK0::jaky}, {"steady", InitialK0::steady}}) {
    const Study study = read_test(keys("initial_K0 = \"" + std::string(text) + "\""));
    EXPECT_EQ(study.oedometer_tests[0].K0_rule, rule);
    EXPECT_NEAR(study.oedometer_tests[0].initial_K0, 0.5, 1e-15);  // 1 - sin 30 deg
    EXPECT_FALSE(assumes(study, "K0"));
  }
  const OedometerTest prior = test_with("initial_K0 = { value = 0.8, std_error = 0.05 }");
  EXPECT_EQ(prior.K0_rule, InitialK0::given);
  EXPECT_EQ(prior.initial_K0, 0.8);
  EXPECT_TRUE(prior.free_K0.moves);
  EXPECT_EQ(prior.free_K0.std_error.value(), 0.05);
  EXPECT_FALSE(test_with("initial_K0 = { value = 0.8 }").free_K0.std_error.has_value());
  const Study absent = read_test(keys(""));
  EXPECT_EQ(absent.oedometer_tests[0].K0_rule, InitialK0::jaky);
  EXPECT_TRUE(assumes(absent, "initial K0 not given"));

  expect_test_refused(keys("initial_K0 = \"jacky\""), {"key initial_K0", "\"jaky\" or \"steady\""});
  expect_test_refused(keys("initial_K0 = { std_error = 0.1 }"), {"key value in [oedometer.initial_K0]"});
  expect_test_refused(keys("initial_K0 = { value = 3 }"), {"3 is out of range", "> 0 and < 3"});
  expect_test_refused(keys("initial_K0 = { value = 0.8, std = 1 }"), {"key std in [oedometer.initial_K0]"});
}

TEST_F(OedometerSection, InitialOcrIsGivenOrMoves) {
  EXPECT_FALSE(test_with("").initial_ocr.has_value());
  EXPECT_EQ(test_with("initial_ocr = 1.5").initial_ocr.value(), 1.5);
  EXPECT_FALSE(test_with("initial_ocr = 1.5").free_ocr.moves);
  const OedometerTest free = test_with("initial_ocr = { value = 2, std_error = 0.3 }");
  EXPECT_EQ(free.initial_ocr.value(), 2.0);
  EXPECT_TRUE(free.free_ocr.moves);
  EXPECT_EQ(free.free_ocr.std_error.value(), 0.3);
  expect_test_refused(keys("initial_ocr = 0"), {"key initial_ocr", "> 0 and <= 100"});
  expect_test_refused(keys("initial_ocr = { value = 101 }"), {"101 is out of range"});
  expect_test_refused(keys("initial_ocr = { value = 2, std_error = 0 }"), {"key std_error", "> 0"});
}

TEST_F(OedometerSection, EndOfPrimaryBelongsToLoadSteps) {
  using Rule = EndOfPrimary::Rule;
  const std::string stress = "protocol = \"stress\"\n";
  EXPECT_EQ(test_with(stress).end_of_primary.rule, Rule::taylor);
  EXPECT_EQ(test_with(stress).record.control, Control::stress);
  EXPECT_EQ(test_with(stress + "end_of_primary = \"casagrande\"").end_of_primary.rule, Rule::casagrande);
  EXPECT_EQ(test_with(stress + "end_of_primary = \"none\"").end_of_primary.rule, Rule::none);
  const EndOfPrimary given = test_with(stress + "end_of_primary = 3600").end_of_primary;
  EXPECT_EQ(given.rule, Rule::given);
  EXPECT_EQ(given.seconds, 3600.0);
  expect_test_refused(keys(stress + "end_of_primary = 0"), {"key end_of_primary", "> 0"});
  expect_test_refused(keys(stress + "end_of_primary = \"log\""),
                      {"\"taylor\" or \"casagrande\" or \"none\""});
  expect_test_refused(keys("end_of_primary = 3600"), {"key end_of_primary", "strain-controlled"});
}

TEST_F(OedometerSection, StressIsReducedAsStated) {
  const Study linear = read_test(keys("stress = \"total\"", "pore.csv"));
  // 4 - (2/3) 3 = 2; nonlinear: (4 1^2)^(1/3) = 1.587401 (the square of the cube root of 2 is 1.587401)
  EXPECT_DOUBLE_EQ(linear.oedometer_tests[0].record.rows[0].axial_stress, 2e3);
  const OedometerTest nonlinear = test_with("stress = \"total\"\npore_pressure = \"nonlinear\"", "pore.csv");
  EXPECT_NEAR(nonlinear.record.rows[0].axial_stress, 1587.401051968, 1e-6);
  EXPECT_DOUBLE_EQ(test_with("", "pore.csv").record.rows[0].axial_stress, 4e3);

  EXPECT_TRUE(assumes(read_test(keys("stress = \"total\"")),
                      "oedometer test t: no base pore pressure recorded, total stress taken as effective"));
  EXPECT_TRUE(assumes(read_test(keys("", "force.csv")), "effective assumed"));
  EXPECT_FALSE(assumes(read_test(keys("stress = \"effective\"", "force.csv")), "effective assumed"));
  expect_test_refused(keys("pore_pressure = \"linear\""), {"key pore_pressure", "stress = \"total\""});
  expect_test_refused(keys("stress = \"total\"\nprotocol = \"stress\""), {"key stress", "stress-controlled"});
  expect_test_refused(keys("stress = \"gross\""), {"\"effective\" or \"total\""});
}

TEST_F(OedometerSection, KeysOfOtherFormatsAreRefused) {
  expect_test_refused(keys("select = { bro_id = \"B\" }"), {"key select", "one test"});
  expect_test_refused(keys("format = \"gef\""), {"\"csv\" or \"bro\" or \"ags4\""});
  expect_test_refused("data = \"crs.csv\"\nvoid_ratio = 1\n", {"key height_mm", "it is missing"});
  expect_test_refused(keys("protocol = \"stres\""), {"\"strain\" or \"stress\""});
}

TEST_F(OedometerSection, FitSettingsSayWhereAFitStartsAndWhatIsKnown) {
  const FitSettings defaults = read_test(keys("")).fit;
  EXPECT_EQ(defaults.start, FitStart::data);
  EXPECT_EQ(defaults.starts, 12);
  EXPECT_EQ(defaults.bootstrap, 0);
  const FitSettings fit =
      read_test(
          keys(""),
          "[fit]\noedometer = [\"lambda\", \"phi_c\"]\nstart = \"material\"\nstarts = 3\nbootstrap = 200\n"
          "seed = 42\n[fit.prior]\nlambda = { mean = 0.15, std_error = 0.02 }\n"
          "phi_c = { mean = 18.0, std_error = 1.8 }\n")
          .fit;
  EXPECT_EQ(fit.start, FitStart::material);
  EXPECT_EQ(fit.starts, 3);
  EXPECT_EQ(fit.bootstrap, 200);
  EXPECT_EQ(fit.seed, 42U);
  const auto& lambda = fit.priors[static_cast<std::size_t>(ParameterId::lambda)];
  EXPECT_EQ(lambda.value().mean, 0.15);
  EXPECT_EQ(lambda.value().std_error, 0.02);
  const auto& phi_c = fit.priors[static_cast<std::size_t>(ParameterId::phi_c)];
  EXPECT_NEAR(phi_c.value().mean, std::numbers::pi / 10.0, 1e-15);
  EXPECT_NEAR(phi_c.value().std_error, std::numbers::pi / 100.0, 1e-15);
  EXPECT_FALSE(fit.priors[static_cast<std::size_t>(ParameterId::kappa)].has_value());
}

TEST_F(OedometerSection, FitSettingsThatCannotBeAreRefused) {
  const auto refused = [&](std::string_view fit, std::initializer_list<std::string_view> parts) {
    expect_test_refused(keys(""), parts, "[fit]\n" + std::string(fit) + "\n");
  };
  refused("start = \"guess\"", {"\"data\" or \"material\""});
  refused("starts = 0", {"key starts", ">= 1 and <= 1000"});
  refused("starts = 1.5", {"1.5 is not a whole number"});
  refused("bootstrap = 100001", {"key bootstrap", "<= 100000"});
  refused("seed = -1", {"key seed", ">= 0"});
  refused("[fit.prior]\nI_v = { mean = 0.03, std_error = 0.01 }",
          {"study.toml:11: key I_v in [fit.prior]", "does not move", "listed under oedometer"});
  refused("[fit.prior]\nlambda = { mean = 0, std_error = 0.01 }", {"key mean in [fit.prior.lambda]", "> 0"});
  refused("[fit.prior]\nlambda = { mean = 0.1, std_error = 0 }", {"key std_error", "> 0"});
  refused("[fit.prior]\nlambda = { mean = 0.1 }", {"key std_error", "missing"});
  refused("[fit.prior]\nlamda = { mean = 0.1, std_error = 1 }", {"key lamda in [fit.prior]", "unknown"});
  refused("[fit.prior]\nlambda = 0.1", {"key lambda in [fit.prior]", "a table"});
}

}  // namespace
}  // namespace isotach::datasets
