// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of result.json: what it must hold, units, nulls.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "reports/result_json.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

using nlohmann::ordered_json;

/// Paths of all numbers that are not finite; JSON would turn them into null without anybody having decided
/// so.
void find_not_finite(const ordered_json& json, const std::string& path, std::vector<std::string>& found) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) found.push_back(path);
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) find_not_finite(value, path + "/" + key, found);
}

void expect_head(const ordered_json& json, const std::string& command) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  ASSERT_GE(keys.size(), 5U);
  EXPECT_EQ(json["command"], command);
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["seconds"], 4.5);
  EXPECT_TRUE(json["warnings"].is_array());
  EXPECT_EQ(keys.front(), "command");
  std::vector<std::string> found;
  find_not_finite(json, "", found);
  EXPECT_TRUE(found.empty()) << found.front();
  EXPECT_EQ(json.dump().find("/somewhere/private"), std::string::npos);
}

TEST(ResultJson, ListsEveryParameterInTheUnitOfItsKey) {
  const ordered_json json =
      result_json(run_of("fit-oedometer"), small_study(), small_calibration().oedometer);
  expect_head(json, "fit-oedometer");
  EXPECT_EQ(json["status"], "ok");
  const ordered_json& parameters = json["parameters"];
  ASSERT_EQ(parameters.size(), model::kParameterCount);
  // the study gives 15.3 degrees, and the fit does not move it
  EXPECT_NEAR(parameters["phi_c"]["value"].get<double>(), 15.3, 1e-12);
  EXPECT_EQ(parameters["phi_c"]["unit"], "deg");
  EXPECT_EQ(parameters["phi_c"]["verdict"], "fixed");
  EXPECT_TRUE(parameters["phi_c"]["std_error"].is_null());
  EXPECT_TRUE(parameters["phi_c"]["ci95"][0].is_null());
  EXPECT_EQ(parameters["D_r"]["verdict"], "gauge");
  // with some hundred degrees of freedom: the interval of lambda is +-1.96 to 2 standard errors around it
  const ordered_json& lambda = parameters["lambda"];
  EXPECT_EQ(lambda["verdict"], "identified");
  const double half_width = 0.5 * (lambda["ci95"][1].get<double>() - lambda["ci95"][0].get<double>());
  EXPECT_NEAR(half_width, 1.98 * lambda["std_error"].get<double>(), 0.02 * half_width);
}

TEST(ResultJson, SaysHowTheOedometerAnswerWasReached) {
  const ordered_json json = result_json(run_of("fit-oedometer"), assessed_study(), assessed_fit());
  EXPECT_EQ(json["gauge"]["kind"], "crs-rate");
  EXPECT_GT(json["gauge"]["reference_rate_per_s"].get<double>(), 0.0);
  EXPECT_EQ(json["null_directions"], ordered_json::array());
  ASSERT_EQ(json["routes"].size(), 2U);
  for (const ordered_json& route : json["routes"]) {
    // both in the unit of the key, near the compression index that went in
    EXPECT_NEAR(route["parameters"]["lambda"].get<double>(),
                json["parameters"]["lambda"]["value"].get<double>(), 1e-4);
    EXPECT_FALSE(route["termination"].get<std::string>().empty());
  }
  EXPECT_TRUE(json["disagreement_in_std_errors"].is_number());
  EXPECT_EQ(json["correlation"]["names"], (ordered_json{"ln e100", "ln lambda", "ln kappa"}));
  ASSERT_EQ(json["correlation"]["matrix"].size(), 3U);
  EXPECT_DOUBLE_EQ(json["correlation"]["matrix"][2][2].get<double>(), 1.0);
  ASSERT_EQ(json["tests"].size(), 2U);
  EXPECT_EQ(json["tests"][0]["name"], "crs-2");
  EXPECT_EQ(json["tests"][0]["held_out"], false);
  EXPECT_EQ(json["tests"][0]["values"], 190);  // rows of crs-2.csv
  EXPECT_EQ(json["tests"][0]["data"], "crs-2.csv");
  EXPECT_EQ(json["tests"][1]["held_out"], true);
}

TEST(ResultJson, HoldsTheAssessmentOfAnOedometerFit) {
  const ordered_json json = result_json(run_of("fit-oedometer"), assessed_study(), assessed_fit());
  expect_head(json, "fit-oedometer");
  EXPECT_EQ(json["starts"], ordered_json::array());
  ASSERT_EQ(json["noise"].size(), 1U);
  // as mud-a states it
  EXPECT_EQ(json["noise"][0]["stated_level"], 0.005);
  EXPECT_NEAR(json["noise"][0]["stated_floor_kPa"].get<double>(), 0.02, 1e-15);
  ASSERT_EQ(json["checks"].size(), 2U);
  EXPECT_EQ(json["checks"][0]["stages"][0]["stage"], "load");
  EXPECT_TRUE(json["checks"][0]["stages"][0]["missed"].is_boolean());
  EXPECT_TRUE(json["checks"][0]["runs"]["p_value"].is_number());
  EXPECT_TRUE(json["checks"][1]["ljung_box_whitened"].is_null());
  ASSERT_EQ(json["profiles"].size(), 3U);
  const ordered_json& profile = json["profiles"][1];
  EXPECT_EQ(profile["parameter"], "lambda");
  EXPECT_EQ(profile["lower_end"], "crossed");
  const double lambda = json["parameters"]["lambda"]["value"].get<double>();
  EXPECT_LT(profile["lower"].get<double>(), lambda);
  EXPECT_GT(profile["upper"].get<double>(), lambda);
  EXPECT_EQ(json["multi_start"]["starts"], 2);  // besides the first
  EXPECT_GE(json["multi_start"]["clusters"].size(), 1U);
  EXPECT_EQ(json["global_searches"].size(), 2U);
  EXPECT_EQ(json["without_test"], ordered_json::array());
  EXPECT_EQ(json["integrators"].size(), 2U);
  EXPECT_TRUE(json["integrators"][0]["failure"].is_null());
  EXPECT_EQ(json["bootstrap"]["samples"], 4);
  EXPECT_TRUE(json["start_values"]["lambda"]["value"].is_number());
  EXPECT_EQ(json["start_values"]["tests"][0]["test"], "crs-2");
}

TEST(ResultJson, WhatAFitHasNotIsNull) {
  calibration::OedometerFit fit = assessed_fit();
  fit.assessment.reset();
  fit.start.reset();
  const ordered_json json = result_json(run_of("fit-oedometer"), assessed_study(), fit);
  for (const char* key : {"profiles", "multi_start", "global_searches", "without_test", "shifted_inputs",
                          "integrators", "bootstrap", "start_values"}) {
    EXPECT_TRUE(json.at(key).is_null()) << key;
  }
}

TEST(ResultJson, LocalQuantitiesStandAmongTheStarts) {
  calibration::OedometerFit fit = assessed_fit();
  fit.result.local_estimates = {{"crs-2: K0", 0.8, 0.1, 0.6, std::numeric_limits<double>::quiet_NaN(),
                                 calibration::Verdict::weak, "the data hold it only loosely"}};
  const ordered_json json = result_json(run_of("fit-oedometer"), assessed_study(), fit);
  ASSERT_EQ(json["starts"].size(), 1U);
  EXPECT_EQ(json["starts"][0]["name"], "crs-2: K0");
  EXPECT_EQ(json["starts"][0]["verdict"], "weak");
  EXPECT_EQ(json["starts"][0]["ci95"], (ordered_json{0.6, nullptr}));
}

TEST(ResultJson, EffectsStandAmongTheParametersInTheUnitOfTheirName) {
  calibration::OedometerFit fit = assessed_fit();
  const effects::ParameterRef sigma_s = *effects::find_parameter("seating.sigma_s_kPa");
  fit.effects = *effects::Values<double>::create({effects::with_amplitude(*sigma_s.effect, 2e-4)});
  fit.result.local_estimates = {{"seating.sigma_s_kPa", 15e3, 1e3, 13e3, 17e3,
                                 calibration::Verdict::identified, "the data hold it", sigma_s}};
  const ordered_json json = result_json(run_of("fit-oedometer"), assessed_study(), fit);
  EXPECT_EQ(json["starts"], ordered_json::array());
  const ordered_json& parameter = json["parameters"].at("seating.sigma_s_kPa");
  EXPECT_EQ(parameter["value"], 15.0);
  EXPECT_EQ(parameter["std_error"], 1.0);
  EXPECT_EQ(parameter["ci95"], (ordered_json{13.0, 17.0}));
  EXPECT_EQ(parameter["unit"], "kPa");
  EXPECT_EQ(parameter["verdict"], "identified");
  EXPECT_TRUE(json["parameters"].contains("lambda"));
  EXPECT_EQ(json["effects"], (ordered_json{{"seating", {{"delta_m", 2e-4}, {"sigma_s_kPa", 10.0}}}}));
}

TEST(ResultJson, NamesRowsThatWereLeftOut) {
  calibration::OedometerFit fit = small_calibration().oedometer;
  datasets::OedometerTest test = fit.experiments[0]->test();
  test.record.notes = {{264, "dropped: time 78300 s is not after 78421 s"}};
  fit.experiments[0] = std::make_shared<experiments::OedometerExperiment>(test);
  const ordered_json json = result_json(run_of("fit-oedometer"), small_study(), fit);
  EXPECT_EQ(json["tests"][0]["rows_dropped"],
            (ordered_json::array({{{"line", 264}, {"what", "dropped: time 78300 s is not after 78421 s"}}})));
}

TEST(ResultJson, GivesDistancesOfSlumpsInMillimetres) {
  const calibration::SlumpFit& fit = small_calibration().slump;
  const ordered_json json = result_json(run_of("fit-slump"), small_study(), fit);
  expect_head(json, "fit-slump");
  ASSERT_EQ(json["tests"].size(), 2U);
  const ordered_json& test = json["tests"][1];
  EXPECT_EQ(test["name"], "slump-4");
  EXPECT_EQ(test["held_out"], true);
  EXPECT_NEAR(test["rms_mm"].get<double>(), 1e3 * test["rms"].get<double>(), 1e-9);
  // a rim at 0.01 m/s is 40 mm up after 4 s: inside the 70 mm of mud, so no time counts
  EXPECT_TRUE(test["rms_mould_gone_mm"].is_null());
  EXPECT_GE(json["simulations"].get<int>(), 1);
  EXPECT_EQ(json["disagreement_in_std_errors"], nullptr);
}

TEST(ResultJson, CalibrationTakesEachParameterFromTheFitThatMovedIt) {
  const calibration::Calibration& calibration = small_calibration();
  const ordered_json json = result_json(run_of("calibrate"), small_study(), calibration);
  expect_head(json, "calibrate");
  EXPECT_FALSE(json.contains("discover"));
  EXPECT_EQ(json["parameters"]["I_v"], json["fit_slump"]["parameters"]["I_v"]);
  EXPECT_EQ(json["parameters"]["C_1"], json["fit_slump"]["parameters"]["C_1"]);
  EXPECT_NE(json["parameters"]["I_v"]["verdict"], "fixed");
  EXPECT_EQ(json["parameters"]["lambda"], json["fit_oedometer"]["parameters"]["lambda"]);
  EXPECT_EQ(json["parameters"]["lambda"]["verdict"], "identified");
  EXPECT_FALSE(json["fit_oedometer"].contains("command"));
  ASSERT_EQ(json["rounds"].size(), 1U);
  EXPECT_NEAR(json["rounds"][0]["after_slump"]["phi_c_deg"].get<double>(), 15.3, 1e-12);
  EXPECT_TRUE(json["settled"].is_boolean());
}

TEST(ResultJson, DescribesOneSlump) {
  const ordered_json json = result_json(run_of("slump"), short_slump_test(), short_slump());
  expect_head(json, "slump");
  ASSERT_EQ(json["outlines"].size(), 2U);
  EXPECT_EQ(json["outlines"][0]["time_s"], 0.25);
  // the mud falls and spreads, from 140 mm and a radius of 39 mm
  EXPECT_LT(json["outlines"][1]["height_mm"].get<double>(), json["outlines"][0]["height_mm"].get<double>());
  EXPECT_LT(json["outlines"][0]["height_mm"].get<double>(), 145.0);
  EXPECT_GT(json["outlines"][1]["toe_mm"].get<double>(), 39.0);
  EXPECT_LT(json["outlines"][1]["toe_mm"].get<double>(), 120.0);
  // density (2.65 + 3.891)/4.891 t/m3; p_B0 = 100 kPa (4.891/2.358)^(-1/0.154) = 0.876 kPa, p' = p_B0/1.5
  EXPECT_NEAR(json["initial"]["density_kg_per_m3"].get<double>(), 1337.35, 0.01);
  EXPECT_NEAR(json["initial"]["preconsolidation_pressure_kPa"].get<double>(), 0.876, 0.001);
  EXPECT_NEAR(json["initial"]["mean_effective_pressure_kPa"].get<double>(), 0.584, 0.001);
  EXPECT_EQ(json["numerics"]["cell_size_mm"], 13.0);  // 39 mm in three
  EXPECT_EQ(json["numerics"]["water_bulk_modulus_kPa"], 300.0);
  for (const char* key : {"volume_error", "outline_volume_error", "energy_error", "particle_steps"}) {
    EXPECT_GT(json[key].get<double>(), 0.0) << key;
  }
}

TEST(ResultJson, FailuresSayWhenAndWhere) {
  using Kind = mpm::SlumpFailure::Kind;
  const ordered_json placed = failure_json(
      run_of("slump"), mpm::SlumpFailure{Kind::left_grid, 1.5, 0.2, 0.01, "a point left the grid"});
  expect_head(placed, "slump");
  EXPECT_EQ(placed["status"], "failed");
  EXPECT_EQ(placed["failure"], "a point left the grid");
  EXPECT_EQ(placed["time_s"], 1.5);
  EXPECT_EQ(placed["r_mm"], 200.0);
  EXPECT_EQ(placed["z_mm"], 10.0);
  const ordered_json nowhere =
      failure_json(run_of("slump"), mpm::SlumpFailure{Kind::interrupted, 1.5, 0.0, 0.0, "interrupted"});
  EXPECT_EQ(nowhere["status"], "interrupted");
  EXPECT_TRUE(nowhere["r_mm"].is_null());
  const ordered_json fit =
      failure_json(run_of("fit-slump"), calibration::FitFailure{"no simulation succeeded"});
  EXPECT_EQ(fit["status"], "failed");
  EXPECT_EQ(fit["failure"], "no simulation succeeded");
}

}  // namespace
}  // namespace isotach::reports
