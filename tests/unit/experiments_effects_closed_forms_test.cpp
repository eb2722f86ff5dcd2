// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Each effect on oedometer tests against its equation by hand, or against a fine integration of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "effects/anisotropy.hpp"
#include "effects/pore_pressure.hpp"
#include "effects/seating.hpp"
#include "effects/structure.hpp"
#include "effects/temperature.hpp"
#include "effects_tests.hpp"
#include "integrators/integrate.hpp"
#include "model/law.hpp"

namespace isotach::experiments {
namespace {

const effects::Effect& effect(const char* name) {
  return *effects::find_effect(name);
}

effects::Values<double> on(std::vector<effects::Chosen<double>> chosen) {
  return *effects::Values<double>::create(std::move(chosen));
}

std::vector<PathPoint> path_of(const datasets::OedometerTest& test, const effects::Values<double>& values,
                               const model::Parameters<double>& parameters = effects_mud()) {
  const auto path = OedometerExperiment(test, values).path(parameters, {}, Route::cvode);
  if (!path) throw std::runtime_error(path.error().message);
  return *path;
}

/// The test with the strain alone driven: the rows before the first that holds stress.
datasets::OedometerTest strain_driven() {
  datasets::OedometerTest test = crs_test();
  auto& rows = test.record.rows;
  rows.erase(std::find_if(rows.begin(), rows.end(),
                          [](const auto& row) { return row.stage == datasets::Stage::hold; }),
             rows.end());
  return test;
}

// A specimen in a ring: the friction adds s 2 mu sigma_h H/D to what the law's own stress is.
TEST(RingFriction, AddsToTheStressWithTheSignOfTheDirection) {
  const double mu = 0.12;
  const auto test = strain_driven();
  const auto without = path_of(test, {});
  const auto with = path_of(test, on({effects::with_amplitude(effect("ring_friction"), mu)}));
  const OedometerExperiment experiment(test);
  for (std::size_t i = 1; i < with.size(); ++i) {
    const double s = experiment.protocol().steps[i - 1].direction;
    const double height = 0.025 * (1.0 - with[i].axial_strain);
    EXPECT_NEAR(with[i].axial_stress,
                without[i].axial_stress * (1.0 + s * 2.0 * mu * without[i].K0 * height / 0.06),
                1e-6 * with[i].axial_stress);
  }
}

// At constant stress read, sigma' (1 + 2 mu K0 H/D) is what the load is, whatever K0 has become.
TEST(RingFriction, IsTakenOffTheLoadWhereStressIsControlled) {
  const double mu = 0.12;
  const auto with = path_of(load_test(), on({effects::with_amplitude(effect("ring_friction"), mu)}));
  const OedometerExperiment experiment(load_test());
  for (std::size_t i = 1; i < with.size(); ++i) {
    if (experiment.protocol().steps[i - 1].held) {
      EXPECT_NEAR(with[i].axial_stress, experiment.protocol().steps[i - 1].amount,
                  1e-4 * with[i].axial_stress);
    }
  }
}

// In stress control what gives in series adds to the strain and changes nothing else.
TEST(InSeries, AddsItsOwnStrainUnderAGivenLoad) {
  const double start = 8e3;
  const double porosity = 2.2 / 3.2;
  const double C = 3e-10;
  const double delta = 2e-4;
  const double sigma_s = 15e3;
  const double S_g = 0.03;
  effects::Chosen<double> seating = effects::with_amplitude(effect("seating"), delta);
  seating.si[effects::seating::sigma_s] = sigma_s;
  const auto without = path_of(load_test(), {});
  const auto compliant =
      path_of(load_test(), on({effects::with_amplitude(effect("apparatus_compliance"), C)}));
  const auto seated = path_of(load_test(), on({seating}));
  const auto gassy = path_of(load_test(), on({effects::with_amplitude(effect("gas"), S_g)}));
  double largest = start;
  for (std::size_t i = 1; i < without.size(); ++i) {
    const double stress = without[i].axial_stress;
    largest = std::max(largest, stress);
    const auto excess = [&](const std::vector<PathPoint>& path) {
      return path[i].axial_strain - without[i].axial_strain;
    };
    EXPECT_NEAR(excess(compliant), C * (stress - start) / 0.025, 1e-8);
    EXPECT_NEAR(excess(seated), delta / 0.025 * (std::exp(-start / sigma_s) - std::exp(-largest / sigma_s)),
                1e-8);
    EXPECT_NEAR(excess(gassy), porosity * S_g * (stress / (101.3e3 + stress) - start / (101.3e3 + start)),
                1e-8);
  }
}

// In strain control the specimen gets what the instrument leaves: driven by that alone, the law by itself
// answers with the same stress.
TEST(InSeries, LeavesTheSpecimenTheRestOfTheStrain) {
  const double C = 3e-10;
  const auto test = strain_driven();
  const auto with = path_of(test, on({effects::with_amplitude(effect("apparatus_compliance"), C)}));
  for (std::size_t i = 1; i < with.size(); ++i) {
    const double specimen = 1.0 - (1.0 + with[i].void_ratio) / (1.0 + with[0].void_ratio);
    EXPECT_NEAR(specimen + C * (with[i].axial_stress - with[0].axial_stress) / 0.025, with[i].axial_strain,
                1e-8);
    EXPECT_NEAR(with[i].axial_strain, test.record.rows[i - 1].axial_strain, 1e-8);
  }
}

// (2/3) u_b of a parabolic isochrone, over what the law says without; nothing where the height stands still.
TEST(PorePressure, AddsTwoThirdsOfThatAtTheBaseWhileTheHeightFalls) {
  const double inverse_k = 4e8;
  const double c_k = 0.4;
  effects::Chosen<double> chosen = effects::with_amplitude(effect("pore_pressure"), inverse_k);
  chosen.si[effects::pore_pressure::c_k] = c_k;
  const auto test = strain_driven();
  const auto without = path_of(test, {});
  const auto with = path_of(test, on({chosen}));
  const OedometerExperiment experiment(test);
  for (std::size_t i = 1; i < with.size(); ++i) {
    const DriveStep& step = experiment.protocol().steps[i - 1];
    const double height = 0.025 * (1.0 - with[i].axial_strain);
    const double e = 3.2 * (1.0 - with[i].axial_strain) - 1.0;
    const double k = std::pow(10.0, (e - 2.2) / (c_k * 2.2)) / inverse_k;
    const double u_b = step.amount / step.duration * 9810.0 * height * height / (2.0 * k);
    EXPECT_NEAR(with[i].axial_stress - without[i].axial_stress, 2.0 / 3.0 * u_b, 1e-3);
  }
}

// Water carries a part of a new load at first, so that the strain comes late: most of it within the load's
// time, the rest only as creep that began later.
TEST(PorePressure, DelaysTheStrainOfALoad) {
  const auto without = path_of(load_test(), {});
  const auto with = path_of(load_test(), on({effects::with_amplitude(effect("pore_pressure"), 3e8)}));
  const OedometerExperiment experiment(load_test());
  const auto& steps = experiment.protocol().steps;
  double at_first = 0.0;
  int loads = 0;
  for (std::size_t i = 1; i < with.size() && steps[i - 1].direction > 0.0; ++i) {
    const double lag = without[i].axial_strain - with[i].axial_strain;
    EXPECT_GT(lag, 0.0);
    const bool on_now = steps[i].held && !steps[i - 1].held;
    if (on_now) at_first = lag;
    if (steps[i - 1].held && !steps[i].held) {
      EXPECT_LT(lag, 0.6 * at_first);
      ++loads;
    }
  }
  EXPECT_EQ(loads, 3);
}

TEST(SensorDrift, AddsToTheReadingInProportionToTime) {
  const double drift = 2e3 / 86400.0;
  const auto test = strain_driven();
  const auto without = path_of(test, {});
  const auto with = path_of(test, on({effects::with_amplitude(effect("sensor_drift"), drift)}));
  for (std::size_t i = 1; i < with.size(); ++i) {
    EXPECT_NEAR(with[i].axial_stress - without[i].axial_stress, drift * with[i].time, 1e-3);
  }
}

// p_B (1 + r) for good is a line of 1 + e100' = (1 + e100)(1 + r)^lambda.
TEST(Structure, ThatDoesNotDecayIsAnotherE100) {
  effects::Chosen<double> structure = effects::with_amplitude(effect("structure"), 0.4);
  structure.si[effects::structure::k] = 0.0;
  const auto mud = effects_mud(0.04, 2.36 * std::pow(1.4, 0.15) - 1.0);
  for (const auto& test : {crs_test(), load_test()}) {
    const auto with = path_of(test, on({structure}));
    const auto other = path_of(test, {}, mud);
    for (std::size_t i = 0; i < with.size(); ++i) {
      EXPECT_NEAR(with[i].axial_stress, other[i].axial_stress, 1e-6 * other[i].axial_stress);
      EXPECT_NEAR(with[i].axial_strain, other[i].axial_strain, 1e-8);
      EXPECT_NEAR(with[i].ocr, other[i].ocr, 1e-6 * other[i].ocr);
    }
  }
}

TEST(Temperature, ThatStaysIsAnotherE100) {
  const double a = 0.012;
  auto test = crs_test();
  for (auto& row : test.record.rows) row.temperature = 32.0;
  const auto mud = effects_mud(0.04, 2.36 * std::exp(-0.15 * a * 12.0) - 1.0);
  const auto with = path_of(test, on({effects::with_amplitude(effect("temperature"), a)}));
  const auto other = path_of(test, {}, mud);
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_NEAR(with[i].axial_stress, other[i].axial_stress, 1e-6 * other[i].axial_stress);
    EXPECT_NEAR(with[i].axial_strain, other[i].axial_strain, 1e-8);
  }
}

/// The law's parameters as an effect has them at one moment, written down anew.
struct Moment {
  double chi, held_strain, since_reversal, temperature, strain_rate;
};
using Altered = std::function<void(model::ParameterValues<double>&, const Moment&)>;

/// A fine Runge-Kutta integration of eq. (1a) in six components, whose law is made anew at every stage with
/// the parameters that the effect then has; `k` is the rate at which chi decays. Axial stresses at the end
/// of each step.
std::vector<double> by_hand(const datasets::OedometerTest& test, const Altered& altered, double k = 0.0) {
  const OedometerExperiment experiment(test);
  const auto& steps = experiment.protocol().steps;
  const auto base = effects_mud();
  using Vector = Eigen::Matrix<double, 5, 1>;  // axial, radial stress, e, chi, strain of the hold
  Vector y;
  y << -8e3, -0.75 * 8e3, 2.2, 1.0, 0.0;
  double time = 0.0;
  double at_reversal = 2.2;
  double direction = 1.0;
  bool held = false;
  std::vector<double> stresses;
  for (const DriveStep& step : steps) {
    if (step.direction != direction) at_reversal = y[2];
    if (!(step.held && held)) y[4] = 0.0;
    direction = step.direction;
    held = step.held;
    const double rate = step.amount / step.duration;
    const auto f = [&](double t, const Vector& at) -> Vector {
      const Moment moment{at[3], at[4], std::abs(at[2] - at_reversal) / 3.2, room(t), std::abs(rate)};
      auto values = base.values();
      altered(values, moment);
      const model::Law<double> law(*model::Parameters<double>::create(values));
      model::State<double> state{model::Mandel<double>::Zero(), at[2]};
      state.stress.head<3>() << at[0], at[1], at[1];
      model::Mandel<double> D = model::Mandel<double>::Zero();
      D[0] = -rate;
      const auto rates = law.rate(state, D);
      const double viscous = law.viscous_rate(law.measures(state).equivalent_pressure, at[2]);
      Vector result;
      result << rates.stress[0], rates.stress[1], rates.void_ratio, -k * viscous * at[3],
          step.held ? viscous : 0.0;
      return result;
    };
    constexpr int kStages = 400;
    const double h = step.duration / kStages;
    for (int i = 0; i < kStages; ++i) {
      const double t = time + i * h;
      const Vector k1 = f(t, y);
      const Vector k2 = f(t + 0.5 * h, y + 0.5 * h * k1);
      const Vector k3 = f(t + 0.5 * h, y + 0.5 * h * k2);
      const Vector k4 = f(t + h, y + h * k3);
      y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    time += step.duration;
    stresses.push_back(-y[0]);
  }
  return stresses;
}

void expect_as_by_hand(const effects::Chosen<double>& chosen, const Altered& altered, double k = 0.0) {
  const auto test = strain_driven();
  const auto with = path_of(test, on({chosen}));
  const auto expected = by_hand(test, altered, k);
  ASSERT_EQ(with.size(), expected.size() + 1);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(with[i + 1].axial_stress, expected[i], 2e-6 * expected[i]) << "step " << i;
  }
}

using model::ParameterId;

TEST(LawTerms, StructureIsAsAFineIntegrationHasIt) {
  effects::Chosen<double> chosen = effects::with_amplitude(effect("structure"), 0.5);
  chosen.si[effects::structure::k] = 15.0;
  expect_as_by_hand(
      chosen,
      [](auto& values, const Moment& moment) {
        values[ParameterId::e100] =
            (1.0 + values[ParameterId::e100]) * std::pow(1.0 + 0.5 * moment.chi, 0.15) - 1.0;
      },
      15.0);
}

// The temperature that a test is given is linear between its rows; by_hand takes the room's own.
TEST(LawTerms, TemperatureIsAsAFineIntegrationHasIt) {
  const auto test = strain_driven();
  const auto with = path_of(test, on({effects::with_amplitude(effect("temperature"), 0.02)}));
  const auto expected = by_hand(test, [](auto& values, const Moment& moment) {
    values[ParameterId::e100] =
        (1.0 + values[ParameterId::e100]) * std::exp(-0.15 * 0.02 * (moment.temperature - 20.0)) - 1.0;
  });
  const auto without = path_of(test, {});
  double largest = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    largest = std::max(largest, std::abs(std::log(with[i + 1].axial_stress / without[i + 1].axial_stress)));
    // rows are up to 20000 s apart, a third of a radian of the room's course: within 3 K (1/3)^2/8
    EXPECT_NEAR(std::log(with[i + 1].axial_stress / expected[i]), 0.0, 0.02 * 0.05) << "step " << i;
  }
  EXPECT_GT(largest, 0.03);
}

TEST(LawTerms, RateDependenceOfTheViscosityIsAsAFineIntegrationHasIt) {
  expect_as_by_hand(effects::with_amplitude(effect("rate_dependent_viscosity"), 0.4),
                    [](auto& values, const Moment& moment) {
                      const double x = moment.strain_rate > 0.0
                                           ? std::tanh(std::log(moment.strain_rate / 1e-6) / 3.0)
                                           : -1.0;
                      values[ParameterId::I_v] *= 1.0 + 0.4 * x;
                    });
}

TEST(LawTerms, StiffnessAfterReversalIsAsAFineIntegrationHasIt) {
  expect_as_by_hand(effects::with_amplitude(effect("small_strain_stiffness"), 2.0),
                    [](auto& values, const Moment& moment) {
                      values[ParameterId::kappa] /= 1.0 + 2.0 * std::exp(-moment.since_reversal / 3e-3);
                    });
}

TEST(LawTerms, DelayedCreepIsAsAFineIntegrationHasIt) {
  expect_as_by_hand(effects::with_amplitude(effect("delayed_creep"), 80.0),
                    [](auto& values, const Moment& moment) {
                      values[ParameterId::D_r] *= std::exp(-80.0 * moment.held_strain);
                    });
}

// The anisotropic law itself, integrated in six components from a state that leans.
TEST(Anisotropy, IsTheLawWithAFabricThatStartsLeaning) {
  const double Omega_0 = 0.35;
  effects::Chosen<double> chosen = effects::with_amplitude(effect("anisotropy"), Omega_0);
  chosen.si[effects::anisotropy::C_2] = 25.0;
  chosen.si[effects::anisotropy::C_3] = 1.2;
  const auto test = strain_driven();
  const auto with = path_of(test, on({chosen}));
  auto values = effects_mud().values();
  values[ParameterId::C_2] = 25.0;
  values[ParameterId::C_3] = 1.2 * Omega_0;
  const model::Law<double> law(*model::Parameters<double>::create(values));
  model::State<double> state{model::Mandel<double>::Zero(), 2.2};
  state.stress.head<3>() << -8e3, -6e3, -6e3;
  // q/p of this tensor is Omega_0 in triaxial compression
  state.omega.head<3>() << -2.0 / 3.0 * Omega_0, Omega_0 / 3.0, Omega_0 / 3.0;
  ASSERT_NEAR(std::sqrt(1.5) * state.omega.norm(), Omega_0, 1e-15);
  integrators::Options options;
  options.method = integrators::Method::cvode;
  const OedometerExperiment experiment(test);
  for (std::size_t i = 0; i < experiment.protocol().steps.size(); ++i) {
    const DriveStep& step = experiment.protocol().steps[i];
    integrators::Increment<double> increment;
    increment.duration = step.duration;
    increment.strain_rate[0] = -step.amount / step.duration;
    const auto result = integrators::integrate(law, state, increment, options);
    ASSERT_TRUE(result);
    state = result->state;
    EXPECT_NEAR(with[i + 1].axial_stress, -state.stress[0], 1e-6 * with[i + 1].axial_stress);
  }
}

TEST(Anisotropy, IsRefusedWhereTheMaterialRotatesAlready) {
  auto values = effects_mud().values();
  values[ParameterId::C_2] = 10.0;
  values[ParameterId::C_3] = 0.3;
  const OedometerExperiment experiment(crs_test(), only(effect("anisotropy")));
  const auto result = experiment.predict(*model::Parameters<double>::create(values), {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("both in the material and an effect"), std::string::npos);
}

// Two at once: the ring takes its part of the load under which the frame gives.
TEST(TwoEffects, ActTogether) {
  const auto both = on({effects::with_amplitude(effect("ring_friction"), 0.1),
                        effects::with_amplitude(effect("apparatus_compliance"), 3e-10),
                        effects::with_amplitude(effect("structure"), 0.3),
                        effects::with_amplitude(effect("pore_pressure"), 1e8)});
  for (const auto& test : {crs_test(), load_test()}) {
    const OedometerExperiment experiment(test, both);
    const Values fit = by_fit(experiment, effects_mud());
    const Values reference = by_reference(experiment, effects_mud());
    for (std::size_t i = 0; i < fit.size(); ++i)
      EXPECT_NEAR(fit[i], reference[i], 0.25 * experiment.noise()[i]);
  }
}

}  // namespace
}  // namespace isotach::experiments
