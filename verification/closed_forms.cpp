// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/closed_forms.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "verification/named_paths.hpp"

namespace isotach::verification {

namespace {

constexpr double kRate = 1e-6;   // 1/s
constexpr double kFloor = 2e-9;  // relative; round-off and the reference's own tolerance
const char* const kGroup = "closed forms";

double p_of(const State& state) {
  return -model::trace<double, 6>(state.stress) / 3.0;
}

State isotropic(double p_kPa, double e) {
  return {principal_stress_kPa(p_kPa, p_kPa, p_kPa), e};
}

Increment<double> isotropic_compression(double rate, double strain) {
  return principal_strain(rate / 3, rate / 3, rate / 3, strain / std::abs(rate));
}

/// Checks of one contender.
class Forms {
 public:
  Forms(const Contender& contender, std::vector<Check>& checks)
      : label_(contender.label()),
        options_(options_of(contender.method, contender.tolerance)),
        // ten times the tolerance per 0.1 of strain for the explicit scheme, as for the reference numbers
        relative_(contender.method == integrators::Method::fellin_ostermann ? 10.0 * contender.tolerance
                                                                            : 1e-6),
        checks_(checks) {}

  void steady_compression() {
    for (const double C_1 : {0.0, 0.1}) {
      const auto parameters = set_a(C_1);
      const Law law(parameters);
      const State end = run(parameters, isotropic(100.0, 1.5), {isotropic_compression(kRate, 0.15)});
      const double r0 = std::numbers::sqrt3 * parameters.D_r();
      const double expected = std::pow(kRate * (1.0 - C_1 - 0.2) / r0, 0.05);
      add(fmt::format("steady compression, C_1 = {}: p/p_B", C_1), expected,
          p_of(end) / law.preconsolidation_pressure(end.void_ratio), 0.15);
    }
  }

  void tangent() {
    // at OCR 50 creep is 1e-34 of its rate at OCR 1
    const auto parameters = set_a(0.1);
    const Law law(parameters);
    const State start = isotropic(100.0, law.void_ratio_at(50.0 * 100e3));
    for (const double sign : {1.0, -1.0}) {
      const double strain = 1e-3;
      const State end = run(parameters, start, {isotropic_compression(sign * kRate, strain)});
      add(fmt::format("bulk stiffness {}: kappa d ln p/d eps_v", sign > 0 ? "loading" : "unloading"),
          1.0 - sign * 0.1, 0.02 * std::log(p_of(end) / p_of(start)) / (sign * strain), 0.1);
    }
  }

  void rate_jump() {
    // between steady branches at equal void ratio
    for (const bool oedometric : {false, true}) {
      const auto compress = [&](double rate) {
        return oedometric ? principal_strain(rate, 0.0, 0.0, 0.4 / rate) : isotropic_compression(rate, 0.2);
      };
      const State slow = run(set_a(), isotropic(100.0, 1.5), {compress(kRate)});
      const State fast = run(set_a(), isotropic(100.0, 1.5), {compress(10.0 * kRate)});
      add(fmt::format("rate jump of ten, {}: stress ratio", oedometric ? "oedometric" : "isotropic"),
          std::pow(10.0, 0.05), fast.stress[0] / slow.stress[0], 0.4);
    }
  }

  void creep_and_relaxation() {
    const auto parameters = set_a();
    const Law law(parameters);
    for (const double ocr : {1.0, 1.3}) {
      const State start = isotropic(100.0, law.void_ratio_at(ocr * 100e3));
      const double rv0 = std::numbers::sqrt3 * parameters.D_r() * std::pow(ocr, -20.0);
      const double t0 = 0.05 * 0.1 / rv0;
      const State crept = run(parameters, start, {stress_hold(1e7)});
      add(fmt::format("creep from OCR {}, 1e7 s: e", ocr),
          (1.0 + start.void_ratio) * std::exp(-0.05 * 0.1 * std::log1p(1e7 / t0)) - 1.0, crept.void_ratio,
          0.1);
      const State relaxed = run(parameters, start, {principal_strain(0.0, 0.0, 0.0, 1e7)});
      add(fmt::format("relaxation from OCR {}, 1e7 s: p/p_0", ocr),
          std::pow(1.0 + rv0 * 1e7 / (0.05 * 0.02), -0.05), p_of(relaxed) / p_of(start), 0.1);
    }
  }

  void transient() {
    const auto parameters = set_a();
    const Law law(parameters);
    const double r = kRate;
    const double A = r * (1.0 / 0.02 - 1.0 / 0.1);
    const double z_inf = std::numbers::sqrt3 * parameters.D_r() / (0.02 * A);
    for (const double strain : {0.001, 0.003}) {
      const State end = run(parameters, isotropic(100.0, 1.5), {isotropic_compression(r, strain)});
      const double z = z_inf + (1.0 - z_inf) * std::exp(-A * (strain / r) / 0.05);
      add(fmt::format("transient of compression, strain {}: p/p_B", strain), std::pow(z, -0.05),
          p_of(end) / law.preconsolidation_pressure(end.void_ratio), 0.1);
    }
  }

  void critical_state() {
    for (const double C_1 : {0.0, 0.1}) {
      const auto parameters = set_a(C_1);
      const Law law(parameters);
      const auto shear = principal_strain(kRate, -kRate / 2, -kRate / 2, 1.2 / kRate);
      const State end = run(parameters, isotropic(100.0, 1.5), {shear});
      const double p_cs = 0.5 * law.preconsolidation_pressure(1.5) *
                          std::pow(shear.strain_rate.norm() * (1.0 - C_1) / parameters.D_r(), 0.05);
      add(fmt::format("undrained critical state, C_1 = {}: p (kPa)", C_1), p_cs / 1e3, p_of(end) / 1e3, 1.2);
      add(fmt::format("undrained critical state, C_1 = {}: q/p", C_1), law.critical_ratio(),
          (end.stress[1] - end.stress[0]) / p_of(end), 1.2);
    }
  }

  void gauge() {
    // D_r -> f D_r with (1 + e100) -> (1 + e100) f^(lambda I_v)
    const double f = 1e3;
    auto values = set_a(0.1).values();
    values[model::ParameterId::D_r] *= f;
    values[model::ParameterId::e100] = 2.5 * std::pow(f, 0.1 * 0.05) - 1.0;
    const auto moved = model::Parameters<double>::create(values).value();
    const State start{principal_stress_kPa(100.0, 65.0, 65.0), 1.5};
    const auto load = principal_strain(kRate, 0.0, 0.0, 0.1 / kRate);
    add("gauge, D_r a thousandfold: sigma_a (kPa) of CRS", -run(set_a(0.1), start, {load}).stress[0] / 1e3,
        -run(moved, start, {load}).stress[0] / 1e3, 0.1);
  }

 private:
  State run(const model::Parameters<double>& parameters, const State& start,
            std::vector<Increment<double>> increments) {
    const auto end = follow({"", parameters, start, std::move(increments)}, options_);
    if (end) return end->state;
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {Vector6::Constant(none), none};
  }

  void add(std::string name, double expected, double got, double strain) {
    checks_.push_back({kGroup, std::move(name), label_, expected, got,
                       (relative_ * strain / 0.1 + kFloor) * std::abs(expected), "closed form"});
  }

  std::string label_;
  Options options_;
  double relative_;
  std::vector<Check>& checks_;
};

void constants(std::vector<Check>& checks) {
  const Law law(set_a());
  const auto add = [&](const char* name, double expected, double got) {
    checks.push_back({kGroup, name, "", expected, got, 5e-11, "independent implementation, ten digits"});
  };
  add("a of phi_c = 25 deg", 3.7346174448, std::sqrt(law.a_squared()));
  add("M in compression of phi_c = 25 deg", 0.9838315888, law.critical_ratio());
  add("e at p_B = 50 kPa", 1.6794336563, law.void_ratio_at(50e3));
  add("e at p_B = 200 kPa", 1.3325824788, law.void_ratio_at(200e3));
  add("e at p_B = 400 kPa", 1.1763764082, law.void_ratio_at(400e3));
}

}  // namespace

std::vector<Check> closed_form_checks(const std::vector<Contender>& contenders) {
  std::vector<Check> checks;
  constants(checks);
  for (const Contender& contender : contenders) {
    Forms forms(contender, checks);
    forms.steady_compression();
    forms.tangent();
    forms.rate_jump();
    forms.creep_and_relaxation();
    forms.transient();
    forms.critical_state();
    forms.gauge();
  }
  return checks;
}

}  // namespace isotach::verification
