// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The catalogue of effects: what every entry must have, and what a set of effects refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "effects/anisotropy.hpp"
#include "effects/ring_friction.hpp"
#include "effects/seating.hpp"
#include "effects/values.hpp"

namespace isotach::effects {
namespace {

TEST(EffectsCatalogue, HasTheEffectsOfTheDesignEachOnce) {
  const std::set<std::string_view> oedometer{"ring_friction",
                                             "apparatus_compliance",
                                             "seating",
                                             "gas",
                                             "structure",
                                             "pore_pressure",
                                             "temperature",
                                             "anisotropy",
                                             "rate_dependent_viscosity",
                                             "small_strain_stiffness",
                                             "delayed_creep",
                                             "sensor_drift"};
  const std::set<std::string_view> slump{"wall_adhesion",  "basal_slip",      "lift_delay",
                                         "bleeding",       "thixotropy",      "high_rate_viscosity",
                                         "water_layering", "surface_tension", "yield_stress"};
  std::map<TestKind, std::set<std::string_view>> found;
  for (const Effect* effect : catalogue()) {
    EXPECT_TRUE(found[effect->test].insert(effect->name).second) << effect->name;
  }
  EXPECT_EQ(found[TestKind::oedometer], oedometer);
  EXPECT_EQ(found[TestKind::slump], slump);
}

TEST(EffectsCatalogue, EveryEntryIsCompleteAndItsTypicalValuesAreAdmissible) {
  for (const Effect* effect : catalogue()) {
    SCOPED_TRACE(effect->name);
    for (const std::string_view text : {effect->meaning, effect->equation, effect->source}) {
      EXPECT_FALSE(text.empty());
    }
    EXPECT_GE(effect->height_exponent, -2);
    EXPECT_LE(effect->height_exponent, 2);
    std::set<std::string_view> names;
    for (const EffectParameter& parameter : effect->parameters) {
      EXPECT_TRUE(names.insert(parameter.name).second);
      EXPECT_GT(parameter.to_si, 0.0);
      EXPECT_LT(parameter.lower, parameter.upper);
      EXPECT_GT(parameter.typical, 0.0);
    }
    const EffectParameter& amplitude = effect->parameters[0];
    EXPECT_TRUE(amplitude.searched());
    EXPECT_LE(amplitude.lower, 0.0);
    EXPECT_GT(amplitude.upper, 0.0);
    EXPECT_FALSE(check({with_amplitude(*effect, 0.0)}));
    EXPECT_FALSE(check({with_amplitude(*effect, amplitude.typical_si())}));
  }
}

TEST(EffectsCatalogue, NamesFindTheirEffectsAndParameters) {
  for (const Effect* effect : catalogue()) {
    EXPECT_EQ(find_effect(effect->name), effect);
    for (std::size_t i = 0; i < effect->parameters.size(); ++i) {
      const ParameterRef parameter{effect, i};
      EXPECT_EQ(find_parameter(parameter.name()), parameter);
    }
  }
  EXPECT_EQ(find_effect("ring"), nullptr);
  EXPECT_EQ(find_effect(""), nullptr);
  for (const char* name : {"ring_friction", "ring_friction.", "mu", "ring_friction.mu.mu", ".mu"}) {
    EXPECT_FALSE(find_parameter(name)) << name;
  }
}

std::string content_of(const std::string& file) {
  std::ifstream stream(std::filesystem::path(ISOTACH_SOURCE_DIR) / file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A text within a table of Markdown, where a bar would end its cell.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

/// An effect as a row of the table in docs/effects.md.
std::string row_of(const Effect& effect) {
  std::ostringstream row;
  row << "| `" << effect.name << "` | " << effect.meaning << " | " << cell(effect.equation) << " | ";
  for (std::size_t i = 0; i < effect.parameters.size(); ++i) {
    const EffectParameter& parameter = effect.parameters[i];
    row << (i == 0 ? "" : "; ") << "`" << parameter.name << "` " << parameter.meaning << ", "
        << (parameter.lower_open ? "above " : "") << parameter.lower << " to " << parameter.upper;
    if (parameter.otherwise == Default::typical) row << ", where absent " << parameter.typical;
    if (parameter.otherwise == Default::material_D_r) row << ", where absent D_r of [material]";
  }
  row << " | " << name_of(effect.seam) << " | " << effect.height_exponent << " | " << effect.source << " |";
  return row.str();
}

// A page that says something else than the program misleads.
TEST(EffectsPage, HasTheRowOfEveryEffect) {
  const std::string page = content_of("docs/effects.md");
  for (const Effect* effect : catalogue()) {
    EXPECT_NE(page.find("\n" + row_of(*effect) + "\n"), std::string::npos) << row_of(*effect);
  }
}

TEST(EffectsPage, ShowsTheFileOfItsExampleAsItIs) {
  std::istringstream lines(content_of("effects/sensor_drift.hpp"));
  std::string shown;
  for (std::string line; std::getline(lines, line);) shown += (line.empty() ? "" : "    " + line) + "\n";
  EXPECT_NE(content_of("docs/effects.md").find(shown), std::string::npos);
}

TEST(EffectValues, RefuseWhatIsOutOfRangeOrThereTwice) {
  const auto refused = [](std::vector<Chosen<double>> chosen) {
    const auto values = Values<double>::create(std::move(chosen));
    return values ? std::string() : values.error().message();
  };
  EXPECT_EQ(refused({with_amplitude(ring_friction::kEffect, 0.1)}), "");
  EXPECT_EQ(refused({with_amplitude(ring_friction::kEffect, -0.01)}),
            "ring_friction.mu = -0.01 is not admissible; accepted: >= 0 and <= 0.6");
  EXPECT_NE(refused({with_amplitude(ring_friction::kEffect, 0.61)}), "");
  EXPECT_NE(refused({with_amplitude(ring_friction::kEffect, std::nan(""))}), "");
  EXPECT_NE(
      refused({with_amplitude(ring_friction::kEffect, 0.1), with_amplitude(ring_friction::kEffect, 0.2)}),
      "");
  Chosen<double> seating = with_amplitude(seating::kEffect, 1e-4);
  seating.si[seating::sigma_s] = 1e7;
  EXPECT_EQ(refused({seating}),
            "seating.sigma_s_kPa = 10000 is not admissible; accepted: >= 0.1 and <= 1000 kPa");
}

TEST(EffectValues, StandInTheOrderOfTheCatalogueAndKnowWhichAct) {
  const auto values = Values<double>::create(
      {with_amplitude(seating::kEffect, 0.0), with_amplitude(ring_friction::kEffect, 0.1)});
  ASSERT_TRUE(values);
  EXPECT_EQ(values->chosen().front().effect, &ring_friction::kEffect);
  EXPECT_TRUE(values->has(seating::kEffect));
  EXPECT_FALSE(values->has(anisotropy::kEffect));
  EXPECT_EQ((*values)[*find_parameter("ring_friction.mu")], 0.1);
  const Values<double> acting = values->acting_on(TestKind::oedometer);
  EXPECT_TRUE(acting.has(ring_friction::kEffect));
  EXPECT_FALSE(acting.has(seating::kEffect));
  EXPECT_TRUE(values->acting_on(TestKind::slump).empty());
}

TEST(EffectValues, AnAmplitudeOfZeroWithADerivativeActs) {
  using Jet = ceres::Jet<double, 1>;
  const Values<double> plain = *Values<double>::create({with_amplitude(ring_friction::kEffect, 0.0)});
  const std::vector<ParameterRef> mu{*find_parameter("ring_friction.mu")};
  const std::vector<Jet> moving{Jet(0.0, 0)};
  EXPECT_TRUE(plain.cast<Jet>().acting_on(TestKind::oedometer).empty());
  EXPECT_FALSE(plain.cast<Jet>()
                   .with(std::span(mu), std::span<const Jet>(moving))
                   ->acting_on(TestKind::oedometer)
                   .empty());
}

}  // namespace
}  // namespace isotach::effects
