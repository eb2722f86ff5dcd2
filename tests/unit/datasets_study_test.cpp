// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// read_study: values in SI, what is assumed, and every kind of mistake named with its
// line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "datasets/study.hpp"
#include "tests/unit/datasets_files.hpp"

namespace isotach::datasets {
namespace {

using model::ParameterId;

constexpr std::string_view kStudy = R"([material]
e100 = 1.358
lambda = 0.154
kappa = 0.0129
I_v = 0.02
D_r_per_s = 6.8e-7
phi_c_deg = 30.0
C_1 = 0.03

[fit]
oedometer = ["lambda", "kappa"]
gauge = "fixed"
reference_rate_per_s = 7e-7
[fit.bounds]
lambda = [0.01, 0.5]
phi_c = [9.0, 45]

[[oedometer]]
name = "crs"
data = "crs.csv"
height_mm = 20.0
diameter_mm = 50.0
void_ratio = 2.46
initial_K0 = 0.8
initial_axial_stress_kPa = 4.0
noise = { stress_relative = 0.005, stress_floor_kPa = 0.02, strain = 2e-5 }
hold_out = true

[[slump]]
name = "slump"
data = "slump.csv"
noise = { outline_mm = 1.2, lifting_mm = 3, shared_mm = 0.5 }
[slump.mould]
diameter_mm = 78.0
fill_height_mm = 140.0
lift_speed_m_per_s = 0.06
wall = "rough"
[slump.mud]
void_ratio = 3.9
specific_gravity = 2.7
ocr = 2.0
[slump.base]
kind = "rough"

[numerics]
cell_size_mm = 6.0
points_per_cell = 9
)";

class StudyFile : public testing::Test {
 protected:
  StudyFile() {
    folder_.write("crs.csv", "time_s,axial_strain,axial_stress_kPa\n0,0,4\n1,0.01,5\n2,0.02,6\n");
    folder_.write("slump.csv", "time_s,r_mm,z_mm\n1,90,2\n1,40,30\n1,0,60\n2.5,95,2\n2.5,40,30\n2.5,0,59\n");
  }

  Study read(std::string_view content) const { return read_study(folder_.write("study.toml", content)); }
  /// Reads kStudy with one change.
  Study read_changed(std::string_view from, std::string_view to) const {
    return read(replaced(std::string(kStudy), from, to));
  }
  void expect_refused(std::string_view from, std::string_view to,
                      std::initializer_list<std::string_view> parts) const {
    expect_input_error([&] { static_cast<void>(read_changed(from, to)); }, parts);
  }
  static bool assumes(const Study& study, std::string_view text) {
    return std::any_of(study.assumptions.begin(), study.assumptions.end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  }

  TemporaryFolder folder_;
};

TEST_F(StudyFile, ComesOutInSI) {
  const Study study = read(kStudy);
  EXPECT_DOUBLE_EQ(study.material.e100(), 1.358);
  EXPECT_DOUBLE_EQ(study.material.D_r(), 6.8e-7);
  EXPECT_DOUBLE_EQ(study.material.phi_c(), std::numbers::pi / 6.0);
  EXPECT_EQ(study.material.lode(), model::LodeDependence::matsuoka_nakai);

  EXPECT_EQ(study.fit.oedometer, (std::vector{ParameterId::lambda, ParameterId::kappa}));
  EXPECT_EQ(study.fit.slump, (std::vector{ParameterId::I_v, ParameterId::C_1}));
  EXPECT_EQ(study.fit.gauge, Gauge::fixed);
  EXPECT_DOUBLE_EQ(study.fit.reference_rate.value(), 7e-7);
  const auto& phi_bounds = study.fit.bounds[static_cast<std::size_t>(ParameterId::phi_c)];
  ASSERT_TRUE(phi_bounds.has_value());
  EXPECT_DOUBLE_EQ(phi_bounds->lower, std::numbers::pi / 20.0);
  EXPECT_DOUBLE_EQ(phi_bounds->upper, std::numbers::pi / 4.0);
  EXPECT_FALSE(study.fit.bounds[static_cast<std::size_t>(ParameterId::kappa)].has_value());

  ASSERT_EQ(study.oedometer_tests.size(), 1U);
  const OedometerTest& oedometer = study.oedometer_tests[0];
  EXPECT_EQ(oedometer.name, "crs");
  EXPECT_EQ(oedometer.record.rows.size(), 3U);
  EXPECT_DOUBLE_EQ(oedometer.height, 0.02);
  EXPECT_DOUBLE_EQ(oedometer.diameter.value(), 0.05);
  EXPECT_DOUBLE_EQ(oedometer.void_ratio, 2.46);
  EXPECT_DOUBLE_EQ(oedometer.initial_K0, 0.8);
  EXPECT_DOUBLE_EQ(oedometer.initial_axial_stress.value(), 4000.0);
  EXPECT_DOUBLE_EQ(oedometer.noise.stress_relative, 0.005);
  EXPECT_DOUBLE_EQ(oedometer.noise.stress_floor, 20.0);
  EXPECT_DOUBLE_EQ(oedometer.noise.strain, 2e-5);
  EXPECT_TRUE(oedometer.hold_out);

  ASSERT_EQ(study.slump_tests.size(), 1U);
  const SlumpTest& slump = study.slump_tests[0];
  EXPECT_DOUBLE_EQ(slump.setup.mould.diameter, 0.078);
  EXPECT_DOUBLE_EQ(slump.setup.mould.fill_height, 0.14);
  EXPECT_DOUBLE_EQ(slump.setup.mould.lift_speed, 0.06);
  EXPECT_TRUE(slump.setup.mould.wall.is_rough());
  EXPECT_DOUBLE_EQ(slump.setup.mud.void_ratio.value(), 3.9);
  EXPECT_DOUBLE_EQ(slump.setup.mud.specific_gravity, 2.7);
  EXPECT_DOUBLE_EQ(slump.setup.mud.overconsolidation_ratio, 2.0);
  EXPECT_DOUBLE_EQ(slump.setup.numerics.cell_size, 0.006);
  EXPECT_EQ(slump.setup.numerics.points_per_cell, 9);
  EXPECT_EQ(slump.setup.times, (std::vector{1.0, 2.5}));
  EXPECT_EQ(slump.outlines.size(), 2U);
  EXPECT_DOUBLE_EQ(slump.noise.outline, 0.0012);
  EXPECT_DOUBLE_EQ(slump.noise.lifting, 0.003);
  EXPECT_DOUBLE_EQ(slump.noise.shared, 0.0005);
  EXPECT_FALSE(slump.hold_out);
  EXPECT_TRUE(study.assumptions.empty());
}

TEST_F(StudyFile, WhatIsNotGivenIsAssumedAndSaid) {
  const Study K0 = read_changed("initial_K0 = 0.8\n", "");
  EXPECT_NEAR(K0.oedometer_tests[0].initial_K0, 0.5, 1e-15);  // 1 - sin 30 deg
  EXPECT_TRUE(
      assumes(K0, "oedometer test crs: initial K0 not given, 1 - sin(phi_c) = 0.5000 (Jaky) assumed"));

  const Study mud = read_changed("specific_gravity = 2.7\nocr = 2.0\n", "");
  EXPECT_DOUBLE_EQ(mud.slump_tests[0].setup.mud.specific_gravity, 2.65);
  EXPECT_DOUBLE_EQ(mud.slump_tests[0].setup.mud.overconsolidation_ratio, 1.5);
  EXPECT_TRUE(assumes(mud, "slump test slump: specific gravity not given, 2.65 assumed"));
  EXPECT_TRUE(assumes(mud, "overconsolidation ratio not given, 1.5 assumed"));

  EXPECT_TRUE(assumes(read_changed("wall = \"rough\"\n", ""), "smooth assumed"));
  EXPECT_TRUE(assumes(read_changed("[slump.base]\nkind = \"rough\"\n", ""), "rough assumed"));

  const Study strength = read_changed("void_ratio = 3.9", "undrained_strength_kPa = 0.117");
  EXPECT_DOUBLE_EQ(strength.slump_tests[0].setup.mud.undrained_strength.value(), 117.0);
  EXPECT_TRUE(assumes(strength, "|D| = D_r assumed"));

  const Study noise =
      read_changed("noise = { stress_relative = 0.005, stress_floor_kPa = 0.02, strain = 2e-5 }\n", "");
  EXPECT_DOUBLE_EQ(noise.oedometer_tests[0].noise.stress_relative, 0.01);
  EXPECT_DOUBLE_EQ(noise.oedometer_tests[0].noise.stress_floor, 100.0);
  EXPECT_DOUBLE_EQ(noise.oedometer_tests[0].noise.strain, 1e-4);
  EXPECT_TRUE(assumes(noise, "noise of stress not given, 0.01 of it assumed"));
}

TEST_F(StudyFile, TheVoidRatioFollowsFromWaterContentOrDryMass) {
  const Study water = read_changed("void_ratio = 2.46", "water_content = 0.9\nspecific_gravity = 2.7");
  EXPECT_DOUBLE_EQ(water.oedometer_tests[0].void_ratio, 2.43);
  EXPECT_EQ(water.oedometer_tests[0].void_ratio_source,
            "water content 0.9 times specific gravity 2.7, saturated");

  // pi/4 (5 cm)2 2 cm = 39.2699 cm3; 2.65 g/cm3 of it / 40 g - 1
  const Study mass = read_changed("void_ratio = 2.46", "dry_mass_g = 40\nspecific_gravity = 2.65");
  EXPECT_NEAR(mass.oedometer_tests[0].void_ratio, 2.65 * 39.269908 / 40.0 - 1.0, 1e-7);

  const Study assumed = read_changed("void_ratio = 2.46", "water_content = 1.0");
  EXPECT_DOUBLE_EQ(assumed.oedometer_tests[0].void_ratio, 2.65);
  EXPECT_TRUE(assumes(assumed, "oedometer test crs: specific gravity not given, 2.65 assumed"));

  expect_refused("void_ratio = 2.46", "",
                 {"study.toml:18", "key void_ratio in [[oedometer]]: it is missing"});
  expect_refused("void_ratio = 2.46", "void_ratio = 2.46\nwater_content = 1.0",
                 {"study.toml:24", "key water_content", "stated twice"});
  expect_refused("void_ratio = 2.46", "dry_mass_g = 120", {"study.toml:23", "120 g", "void ratio > 0"});
  expect_refused("diameter_mm = 50.0\nvoid_ratio = 2.46", "dry_mass_g = 40",
                 {"key diameter_mm", "missing", "volume"});
}

TEST_F(StudyFile, AParameterOutOfRangeNamesKeyValueRangeFileAndLine) {
  expect_refused("lambda = 0.154", "lambda = -0.1",
                 {"study.toml:3: key lambda in [material]: -0.1 is out of range; accepted: > 0"});
  expect_refused("phi_c_deg = 30.0", "phi_c_deg = 95",
                 {"study.toml:7: key phi_c_deg in [material]: 95 is out of range; accepted: > 0 and < 90"});
  expect_refused("kappa = 0.0129", "kappa = 0.2",
                 {"study.toml:4: key kappa in [material]: 0.2 is out of range", "< lambda = 0.154"});
  expect_refused("C_1 = 0.03", "C_1 = 0.95", {"study.toml:8: key C_1", "0.95", "1 - kappa/lambda"});
  expect_refused("I_v = 0.02", "I_v = nan", {"study.toml:5: key I_v", "nan is out of range"});
  expect_refused("C_1 = 0.03", "C_1 = 0.03\nC_2 = -0.5", {"study.toml:9: key C_2", "-0.5", ">= 0"});
  expect_refused("C_1 = 0.03", "C_1 = 0.03\nC_3 = 1.0",
                 {"study.toml:9: key C_3", "1 is out of range", "< 1"});
  const auto rotating = read_changed("C_1 = 0.03", "C_1 = 0.03\nC_2 = 40\nC_3 = 0.5").material;
  EXPECT_EQ(rotating.C_2(), 40.0);
  EXPECT_EQ(rotating.C_3(), 0.5);
  EXPECT_EQ(read_changed("C_1 = 0.03", "C_1 = 0.03").material.C_2(), 0.0);
  EXPECT_EQ(read_changed("C_1 = 0.03", "C_1 = 0.03\nC_2 = 0\nC_3 = 0.0\nlode_dependence = \"none\"")
                .material.lode(),
            model::LodeDependence::none);
}

TEST_F(StudyFile, AKeyMissingOrOfTheWrongKindIsNamed) {
  expect_refused("e100 = 1.358\n", "",
                 {"study.toml:1: key e100 in [material]: it is missing; accepted: > 0"});
  expect_refused("e100 = 1.358", "e100 = \"1.358\"", {"study.toml:2: key e100", "\"1.358\" is not a number"});
  expect_refused("[numerics]", "[numerix]",
                 {"study.toml:45: key numerix: it is unknown; accepted: material, fit"});
  expect_refused("hold_out = true", "hold_out = 1",
                 {"study.toml:27: key hold_out", "1; accepted: true or false"});
  expect_refused("[slump.mould]", "[slump.mold]", {"study.toml:29: table [slump.mould]: it is missing"});
  expect_refused("[[slump]]\n", "[slump]\n", {"study.toml:29: key slump", "[[slump]]"});
  expect_refused("data = \"crs.csv\"", "data = 5",
                 {"study.toml:20: key data", "5; accepted: text in quotes"});
}

TEST_F(StudyFile, AnUnknownKeyIsAnErrorAtEveryLevel) {
  expect_refused("e100 = 1.358", "e_100 = 1\ne100 = 1.358",
                 {"study.toml:2: key e_100 in [material]: it is unknown; accepted: e100, lambda, kappa"});
  expect_refused("gauge = \"fixed\"", "guage = \"fixed\"", {"study.toml:12: key guage in [fit]"});
  expect_refused("lambda = [", "lamda = [",
                 {"study.toml:15: key lamda in [fit.bounds]: it is unknown", "phi_c"});
  expect_refused("height_mm = 20.0", "height_mm = 20.0\nheight = 2",
                 {"key height in [[oedometer]]: it is unknown"});
  expect_refused("strain = 2e-5 }", "strain = 2e-5, x = 1 }", {"study.toml:26: key x in [oedometer.noise]"});
  expect_refused("wall = \"rough\"", "wall = \"rough\"\ngrease = true", {"key grease in [slump.mould]"});
  expect_refused("ocr = 2.0", "OCR = 2.0", {"study.toml:41: key OCR in [slump.mud]", "ocr"});
  expect_refused("void_ratio = 3.9", "void_ratio = 3.9\nstrength_rate_per_s = 1",
                 {"key strength_rate_per_s"});
  expect_refused("kind = \"rough\"", "kind = \"rough\"\nthickness_mm = 5",
                 {"key thickness_mm in [slump.base]"});
  expect_refused("points_per_cell = 9", "points = 9",
                 {"key points in [numerics]", "cell_size_mm, points_per_cell"});
}

TEST_F(StudyFile, ChoicesAreNamed) {
  expect_refused("wall = \"rough\"", "wall = \"sticky\"",
                 {"study.toml:37", "\"sticky\"", "\"smooth\" or \"rough\""});
  expect_refused("kind = \"rough\"", "kind = \"springy\"",
                 {"study.toml:43", "\"springy\"; accepted: \"rough\"", "\"elastic\""});
  expect_refused("gauge = \"fixed\"", "gauge = 3",
                 {"study.toml:12", "\"crs-rate\" or \"fixed\" or \"none\""});
}

TEST_F(StudyFile, QuantitiesThatCannotBeAreRefused) {
  expect_refused("height_mm = 20.0", "height_mm = 0",
                 {"study.toml:21: key height_mm", "0 is out of range", "> 0"});
  expect_refused("initial_K0 = 0.8", "initial_K0 = 3.0", {"study.toml:24: key initial_K0", "> 0 and < 3"});
  expect_refused("initial_axial_stress_kPa = 4.0", "initial_axial_stress_kPa = -4", {"study.toml:25"});
  expect_refused("void_ratio = 2.46", "water_content = 90", {"key water_content", "90", "<= 40"});
  expect_refused("fill_height_mm = 140.0", "fill_height_mm = -1", {"study.toml:35: key fill_height_mm"});
  expect_refused("lift_speed_m_per_s = 0.06", "lift_speed_m_per_s = 60", {"study.toml:36", "60", "<= 10"});
  expect_refused("specific_gravity = 2.7", "specific_gravity = 1", {"study.toml:40", "> 1"});
  expect_refused("ocr = 2.0", "ocr = 0", {"study.toml:41", "> 0"});
  expect_refused("void_ratio = 3.9", "void_ratio = 3.9\nundrained_strength_kPa = 1",
                 {"study.toml:40", "together"});
  expect_refused("void_ratio = 3.9\n", "", {"[slump.mud]", "void_ratio or undrained_strength_kPa"});
  expect_refused("cell_size_mm = 6.0", "cell_size_mm = 40",
                 {"study.toml:46", "40 is out of range", "radius, 39"});
  expect_refused("points_per_cell = 9", "points_per_cell = 8", {"study.toml:47", "8 is not a square number"});
  expect_refused("points_per_cell = 9", "courant = 1.5", {"study.toml:47: key courant", "<= 1"});
  expect_refused("outline_mm = 1.2", "outline_mm = 0", {"study.toml:32: key outline_mm in [slump.noise]"});
}

TEST_F(StudyFile, FitSettingsThatCannotBeAreRefused) {
  expect_refused("[\"lambda\", \"kappa\"]", "[\"lambda\", \"cc\"]",
                 {"study.toml:11", "\"cc\" is not", "e100, lambda"});
  expect_refused("[\"lambda\", \"kappa\"]", "[\"kappa\", \"kappa\"]",
                 {"study.toml:11", "\"kappa\" occurs twice"});
  expect_refused("[\"lambda\", \"kappa\"]", "[]", {"study.toml:11", "empty list"});
  expect_refused("[\"lambda\", \"kappa\"]", "\"lambda\"", {"study.toml:11", "\"lambda\"; accepted: names"});
  expect_refused("lambda = [0.01, 0.5]", "lambda = [0.5, 0.01]",
                 {"study.toml:15", "[0.5, 0.01] is no interval"});
  expect_refused("lambda = [0.01, 0.5]", "lambda = [0.01]",
                 {"study.toml:15", "a list of 1", "[lower, upper]"});
  expect_refused("lambda = [0.01, 0.5]", "lambda = [0, 0.5]",
                 {"study.toml:15: key lambda in [fit.bounds]", "> 0"});
  expect_refused("lambda = [0.01, 0.5]", "lambda = [0.2, 0.5]",
                 {"study.toml:15", "[0.2, 0.5] leaves out the start value 0.154"});
  expect_refused("phi_c = [9.0, 45]", "phi_c = [9.0, 90]", {"study.toml:16", "90 is out of range", "< 90"});
  expect_refused("reference_rate_per_s = 7e-7", "reference_rate_per_s = 0", {"study.toml:13", "> 0"});
}

TEST_F(StudyFile, ReferenceNumericsHaveWhatTheyDoNotSayFromTheOthers) {
  const Study study = read_changed("points_per_cell = 9",
                                   "points_per_cell = 9\ntolerance = 0.002\n"
                                   "reference = { cell_size_mm = 2.6, scheme = \"plain\" }");
  const SlumpTest& test = study.slump_tests.at(0);
  ASSERT_TRUE(test.reference.has_value());
  EXPECT_DOUBLE_EQ(test.reference->cell_size, 2.6e-3);
  EXPECT_EQ(test.reference->scheme, mpm::Scheme::plain);
  EXPECT_EQ(test.reference->points_per_cell, 9);
  EXPECT_EQ(test.reference->tolerance, 0.002);
  EXPECT_EQ(test.setup.numerics.cell_size, 6e-3);
  EXPECT_DOUBLE_EQ(test.best_setup().numerics.cell_size, 2.6e-3);
  EXPECT_FALSE(read_changed("points_per_cell = 9", "points_per_cell = 9").slump_tests.at(0).reference);
  expect_refused("points_per_cell = 9", "points_per_cell = 9\nreference = { cells = 3 }",
                 {"key cells", "unknown"});
  expect_refused("points_per_cell = 9", "points_per_cell = 9\nreference = { cell_size_mm = 40 }",
                 {"40 is out of range", "radius, 39"});
}

TEST_F(StudyFile, ASlumpFitMayMoveTheMud) {
  const std::string head = "[\"lambda\", \"kappa\"]\nslump = [\"I_v\", \"OCR0\", \"e0\"]";
  const FitSettings fit = read_changed("[\"lambda\", \"kappa\"]", head).fit;
  ASSERT_EQ(fit.slump_mud.size(), 2U);
  EXPECT_EQ(fit.slump_mud[0].quantity, MudQuantity::overconsolidation_ratio);
  EXPECT_EQ(fit.slump_mud[1].quantity, MudQuantity::void_ratio);
  EXPECT_FALSE(fit.slump_mud[1].bounds.has_value());
  EXPECT_EQ(fit.slump, (std::vector{model::ParameterId::I_v}));
  const std::string known = head + "\nprior = { e0 = { std_error = 0.02 } }";
  const FitSettings with_prior = read_changed("[\"lambda\", \"kappa\"]", known).fit;
  EXPECT_EQ(with_prior.slump_mud[1].std_error.value(), 0.02);
  // an oedometer test has its own
  expect_refused("[\"lambda\", \"kappa\"]", "[\"lambda\", \"e0\"]", {"study.toml:11", "\"e0\" is not"});
  expect_refused("[\"lambda\", \"kappa\"]", head + "\nprior = { e0 = { mean = 3.9, std_error = 0.02 } }",
                 {"key mean"});
  expect_refused("lambda = [0.01, 0.5]", "lambda = [0.01, 0.5]\ne0 = [3.0, 5.0]", {"key e0", "unknown"});
}

TEST_F(StudyFile, ANameTwiceAndAStudyWithoutTestsAreRefused) {
  expect_refused("name = \"slump\"", "name = \"crs\"", {"study.toml:30: key name", "\"crs\" occurs twice"});
  expect_refused("name = \"slump\"", "name = \"a/b\"", {"study.toml:30: key name", "slashes"});
  const std::string study(kStudy);
  expect_input_error([&] { static_cast<void>(read(study.substr(0, study.find("[[oedometer]]")))); },
                     {"study.toml: study: it has no test"});
}

TEST_F(StudyFile, ADefectInADataFileNamesTheDataFile) {
  expect_refused("data = \"crs.csv\"", "data = \"none.csv\"", {"none.csv", "does not exist"});
  folder_.write("text.csv", "time_s,axial_strain,axial_stress_kPa\n0,0,abc\n");
  expect_refused("data = \"crs.csv\"", "data = \"text.csv\"",
                 {"text.csv:2: column axial_stress_kPa: \"abc\""});
  const std::string absolute = "data = \"" + (folder_.path() / "crs.csv").string() + "\"";
  EXPECT_EQ(read_changed("data = \"crs.csv\"", absolute).oedometer_tests[0].record.rows.size(), 3U);
}

TEST_F(StudyFile, TheSizeLimitHoldsForStudyAndData) {
  const auto file = folder_.write("study.toml", kStudy);
  expect_input_error([&] { static_cast<void>(read_study(file, {kStudy.size() - 1})); },
                     {"study.toml: file size"});
  folder_.write("crs.csv", "time_s,axial_strain,axial_stress_kPa\n0,0,4\n1,0.01,5\n2,0.02,6\n" +
                               std::string(5000, '\n'));
  expect_input_error([&] { static_cast<void>(read_study(file, {kStudy.size()})); }, {"crs.csv: file size"});
}

TEST_F(StudyFile, WhatIsNoTomlFileIsRefused) {
  const auto refused = [&](std::string_view content, std::initializer_list<std::string_view> parts) {
    expect_input_error([&] { static_cast<void>(read(content)); }, parts);
  };
  refused("", {"study.toml: file: it is empty"});
  refused("# only a comment\n", {"study.toml: file: it is empty"});
  refused("[material]\ne100 = = 3\n", {"study.toml:2: TOML syntax"});
  refused("[material]\nlambda = 1\nlambda = 2\n", {"study.toml:3: TOML syntax"});
  refused("note = \"\"\"\n[)\n\"\"\"\nlist = [\n[+1],\n[]]\n[)]\n",
          {"study.toml:7: TOML syntax: a table header that begins with no key"});
  refused("[ [ +a ]\n", {"study.toml:1: TOML syntax"});
  refused("a = [1,\n [2}]\n", {"study.toml:2: TOML syntax: a bracket closed by one of another kind"});
  refused("a = 0.1e'\xD2\x8D'\n", {"study.toml:1: TOML syntax: a quote inside of a word"});
  refused("a = [1, 2.'x']\n", {"study.toml:1: TOML syntax: a quote inside of a word"});
  // legal: quotes that close, with more before them, and behind dots, commas and brackets
  refused("a = \"\"\"x \"y\"\"\"\"\nb.\"c\" = [\"d\", 'e', {f = \"g\"}]\n", {"key a"});
  refused("a = 1\n[[\nb]]\n", {"study.toml:2: TOML syntax"});
  refused("[\xC3\xA9]\n", {"study.toml:1: TOML syntax"});
  refused("note = \"\xC3\xA9\" # \xC3\xA9\n\xC3\xA9 = 1\n", {"study.toml:2: TOML syntax", "not in quotes"});
  refused("note = \"\"\"\\\n \xC3\xA9\"\"\"\n", {"study.toml:2: TOML syntax", "right behind a backslash"});
  refused("note = \"\"\"\\\xEF\xBB\xBB\"\"\"\n", {"study.toml:1: TOML syntax", "right behind a backslash"});
  refused("note = \"\\\xEF\xBB\xBB\"\n", {"study.toml:1: TOML syntax", "right behind a backslash"});
  expect_input_error([&] { static_cast<void>(read_study(folder_.path())); }, {"it is a directory"});
}

TEST_F(StudyFile, NumericsComeOutInSI) {
  const mpm::Numerics numerics =
      read_changed("points_per_cell = 9\n",
                   "points_per_cell = 16\nwater_bulk_modulus_kPa = 500\ncourant = 0.3\ntolerance = 1e-4\n"
                   "background_viscosity_Pa_s = 0.4\ninertia_scaling = 7\nscheme = \"plain\"\n")
          .slump_tests[0]
          .setup.numerics;
  EXPECT_EQ(numerics.points_per_cell, 16);
  EXPECT_DOUBLE_EQ(numerics.water_bulk_modulus, 5e5);
  EXPECT_DOUBLE_EQ(numerics.courant, 0.3);
  EXPECT_DOUBLE_EQ(numerics.tolerance, 1e-4);
  EXPECT_DOUBLE_EQ(numerics.background_viscosity, 0.4);
  EXPECT_DOUBLE_EQ(numerics.inertia_scaling, 7.0);
  EXPECT_EQ(numerics.scheme, mpm::Scheme::plain);
}

}  // namespace
}  // namespace isotach::datasets
