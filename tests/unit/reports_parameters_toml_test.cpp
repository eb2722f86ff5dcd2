// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of parameters.toml: a study reads back exactly what was fitted.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/effects_section.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"
#include "reports/parameters_toml.hpp"
#include "reports_results.hpp"

namespace isotach::reports {
namespace {

class ParametersToml : public ResultFolder {
 protected:
  [[nodiscard]] model::Parameters<double> read_back(const std::string& text) const {
    std::ofstream(root_ / "parameters.toml") << text;
    const auto document = datasets::TomlDocument::read(root_ / "parameters.toml", {});
    auto root = document.root();
    auto material = datasets::read_material(root.table("material"));
    root.reject_unknown_keys();
    return material;
  }

  static void expect_equal(const model::Parameters<double>& a, const model::Parameters<double>& b) {
    for (const model::ParameterInfo& info : model::kParameterTable)
      EXPECT_EQ(a[info.id], b[info.id]) << info.name;
    EXPECT_EQ(a.lode(), b.lode());
  }
};

TEST_F(ParametersToml, ReadsBackToTheSameDoubles) {
  const calibration::Calibration& calibration = small_calibration();
  expect_equal(read_back(parameters_toml(run_of("fit-oedometer"), calibration.oedometer)),
               *calibration.oedometer.result.parameters);
  expect_equal(read_back(parameters_toml(run_of("fit-slump"), calibration.slump)),
               *calibration.slump.result.parameters);
  expect_equal(read_back(parameters_toml(run_of("calibrate"), calibration)),
               *calibration.slump.result.parameters);
}

TEST_F(ParametersToml, KeepsADependenceThatIsNotTheDefault) {
  calibration::OedometerFit fit = small_calibration().oedometer;
  model::ParameterValues<double> values = fit.result.parameters->values();
  values.lode = model::LodeDependence::none;
  fit.result.parameters = model::Parameters<double>::create(values).value();
  EXPECT_EQ(read_back(parameters_toml(run_of("fit-oedometer"), fit)).lode(), model::LodeDependence::none);
}

TEST_F(ParametersToml, WritesNoMoreDigitsThanItTakes) {
  const std::string text = parameters_toml(run_of("fit-oedometer"), small_calibration().oedometer);
  // as the study has it, though it went through radians
  EXPECT_NE(text.find("phi_c_deg = 15.3  #"), std::string::npos) << text;
}

TEST_F(ParametersToml, RoundTripsAnglesThatWereFitted) {
  calibration::OedometerFit fit = small_calibration().oedometer;
  for (int i = 1; i <= 1000; ++i) {
    // any angle that a key in degrees can give
    const double phi_c =
        model::info(model::ParameterId::phi_c).to_si * (10.0 + 30.0 * std::fmod(0.6180339887 * i, 1.0));
    model::ParameterValues<double> values = fit.result.parameters->values();
    values[model::ParameterId::phi_c] = phi_c;
    fit.result.parameters = model::Parameters<double>::create(values).value();
    fit.result.estimates[static_cast<std::size_t>(model::ParameterId::phi_c)].value = phi_c;
    ASSERT_EQ(read_back(parameters_toml(run_of("fit-oedometer"), fit)).phi_c(), phi_c);
  }
}

TEST_F(ParametersToml, RoundTripsEveryEffectAtAnyValues) {
  calibration::OedometerFit fit = small_calibration().oedometer;
  for (int i = 1; i <= 50; ++i) {
    std::vector<effects::Chosen<double>> chosen;
    for (const effects::Effect* effect : effects::catalogue()) {
      chosen.push_back({effect, {}});
      for (std::size_t k = 0; k < effect->parameters.size(); ++k) {
        const double share = std::fmod(0.6180339887 * (i + static_cast<int>(k)), 1.0);
        chosen.back().si[k] = effect->parameters[k].to_si * (effect->parameters[k].typical * (0.5 + share));
      }
    }
    fit.effects = *effects::Values<double>::create(chosen);
    const std::string text = parameters_toml(run_of("fit-oedometer"), fit);
    std::ofstream(root_ / "parameters.toml") << text;
    const auto document = datasets::TomlDocument::read(root_ / "parameters.toml", {});
    auto root = document.root();
    const auto material = datasets::read_material(root.table("material"));
    const auto read = datasets::read_effects(root, material);
    root.reject_unknown_keys();
    for (std::size_t e = 0; e < chosen.size(); ++e) {
      const auto* values = read.find(*chosen[e].effect);
      ASSERT_NE(values, nullptr) << text;
      EXPECT_EQ(*values, chosen[e].si) << chosen[e].effect->name;
    }
  }
}

TEST_F(ParametersToml, SaysWhereEachCameFrom) {
  const std::string text = parameters_toml(run_of("calibrate"), small_calibration());
  const auto line_of = [&](const std::string& key) {
    const std::size_t at = text.find("\n" + key + " = ");
    return text.substr(at + 1, text.find('\n', at + 1) - at - 1);
  };
  EXPECT_NE(line_of("phi_c_deg").find("not fitted"), std::string::npos);
  EXPECT_NE(line_of("lambda").find("fitted to the oedometer tests, +- "), std::string::npos);
  EXPECT_NE(line_of("D_r_per_s").find("set by the gauge"), std::string::npos);
  EXPECT_NE(line_of("I_v").find("fitted to the slump tests"), std::string::npos);
}

}  // namespace
}  // namespace isotach::reports
