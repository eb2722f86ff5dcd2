// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/named_paths.hpp"

#include <numbers>

#include "model/published_sets.hpp"

namespace isotach::verification {

namespace {

constexpr double kRate = 1e-6;  // 1/s
constexpr double kDay = 86400.0;

Increment<double> axial(double rate, double duration) {
  return principal_strain(rate, 0.0, 0.0, duration);
}

/// Drained triaxial: axial strain rate, lateral stresses held.
Increment<double> drained(double rate, double duration) {
  Increment<double> increment = axial(rate, duration);
  increment.stress_controlled = {false, true, true, true, true, true};
  return increment;
}

Increment<double> undrained(double rate, double duration) {
  return principal_strain(rate, -0.5 * rate, -0.5 * rate, duration);
}

/// Simple shear with dv1/dx2 = gamma_rate: D12 and W12 are half of it.
Increment<double> simple_shear(double gamma_rate, double duration) {
  Vector6 strain_rate = Vector6::Zero();
  strain_rate[3] = std::numbers::sqrt2 * 0.5 * gamma_rate;
  auto increment = integrators::strain_increment<double>(strain_rate, duration);
  increment.spin[0] = 0.5 * gamma_rate;
  return increment;
}

}  // namespace

model::Parameters<double> set_a(double C_1, double I_v, double C_2, double C_3) {
  auto values = model::set_a_values();
  values[model::ParameterId::C_1] = C_1;
  values[model::ParameterId::I_v] = I_v;
  values[model::ParameterId::C_2] = C_2;
  values[model::ParameterId::C_3] = C_3;
  return model::Parameters<double>::create(values).value();
}

model::Parameters<double> seed_mud() {
  return model::Parameters<double>::create(model::seed_mud_values()).value();
}

std::vector<NamedPath> named_paths() {
  const State isotropic{principal_stress_kPa(100.0, 100.0, 100.0), 1.5};
  const State oedometric{principal_stress_kPa(100.0, 65.0, 65.0), 1.5};
  const Law seed(seed_mud());
  const State mud{principal_stress_kPa(0.584, 0.584, 0.584), seed.void_ratio_at(876.0)};
  return {
      {{"CRS oedometer",
        set_a(0.1),
        oedometric,
        {axial(kRate, 0.08 / kRate), axial(10 * kRate, 0.04 / (10 * kRate)), axial(-kRate, 0.01 / kRate),
         axial(kRate, 0.05 / kRate)}},
       "constant rate, tenfold rate, unloading, reloading; C_1 = 0.1",
       false,
       false},
      {{"undrained triaxial",
        set_a(0.1),
        isotropic,
        {undrained(kRate, 0.15 / kRate), undrained(-kRate, 0.2 / kRate)}},
       "compression, then extension at constant volume; C_1 = 0.1",
       false,
       false},
      {{"drained triaxial", set_a(), isotropic, {drained(kRate, 0.3 / kRate)}},
       "axial strain rate, lateral stresses held",
       false,
       false},
      {{"simple shear",
        set_a(0.0, 0.05, 40.0, 0.5),
        {principal_stress_kPa(100.0, 80.0, 80.0), 1.5},
        {simple_shear(kRate, 0.6 / kRate)}},
       "constant volume, Jaumann rate, rotating ellipse (C_2 = 40, C_3 = 0.5)",
       false,
       false},
      {{"slump-sized shear", seed_mud(), mud, {undrained(0.1, 1.0), undrained(-0.1, 0.5)}},
       "the seed's mud at 0.1 /s, undrained, with a reversal",
       false,
       false},
      {{"creep for 30 years", set_a(), oedometric, {stress_hold(30.0 * 365.25 * kDay)}},
       "all stresses held",
       true,
       true},
      {{"relaxation for a year", set_a(), oedometric, {axial(0.0, 365.25 * kDay)}},
       "all strains held",
       true,
       true},
      {{"CRS oedometer at I_v = 0.01", set_a(0.0, 0.01), oedometric, {axial(kRate, 0.2 / kRate)}},
       "OCR to the power 100",
       true,
       false},
      {{"overstressed creep at I_v = 0.01",
        set_a(0.0, 0.01),
        {principal_stress_kPa(110.0, 110.0, 110.0), 1.5},
        {stress_hold(1e6)}},
       "from OCR = 0.91, where |D_vis| is 14 000 D_r, for 1e6 s",
       true,
       true},
  };
}

}  // namespace isotach::verification
