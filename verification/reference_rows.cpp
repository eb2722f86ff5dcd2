// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "verification/reference_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "verification/named_paths.hpp"

namespace isotach::verification {

namespace {

constexpr double kRate = 1e-6;          // 1/s
constexpr double kStrainOfHolds = 0.1;  // the strain that counts for paths without any

/// A number read off the end of a path.
struct Quantity {
  const char* name;
  double expected;
  double half_digit;
  std::function<double(const Law&, const PathEnd&)> read;
};

struct Case {
  Path path;
  std::vector<Quantity> quantities;
};

double p_kPa(const Law&, const PathEnd& end) {
  return model::trace<double, 6>(end.state.stress) / -3e3;
}
double q_kPa(const Law&, const PathEnd& end) {
  return (end.state.stress[1] - end.state.stress[0]) / 1e3;
}
double axial_kPa(const Law&, const PathEnd& end) {
  return -end.state.stress[0] / 1e3;
}
double void_ratio(const Law&, const PathEnd& end) {
  return end.state.void_ratio;
}

Increment<double> isotropic_compression(double rate, double strain) {
  return principal_strain(rate / 3, rate / 3, rate / 3, strain / rate);
}
Increment<double> oedometric(double rate, double strain) {
  return principal_strain(rate, 0.0, 0.0, strain / rate);
}
Increment<double> undrained(double rate, double strain) {
  return principal_strain(rate, -rate / 2, -rate / 2, strain / std::abs(rate));
}
Increment<double> shear(double rate, double gamma) {
  Vector6 strain_rate = Vector6::Zero();
  strain_rate[3] = std::numbers::sqrt2 * rate;
  return integrators::strain_increment<double>(strain_rate, 0.5 * gamma / rate);
}

std::vector<Case> table_cases() {
  const State isotropic{principal_stress_kPa(100.0, 100.0, 100.0), 1.5};
  const State inclined{principal_stress_kPa(100.0, 65.0, 65.0), 1.5};
  const State sheared{principal_stress_kPa(100.0, 80.0, 80.0), 1.5};
  const auto path = [](const char* name, const State& start, Increment<double> increment) {
    return Path{name, set_a(), start, {increment}};
  };
  return {
      {path("isotropic compression, volumetric strain 0.005", isotropic, isotropic_compression(kRate, 0.005)),
       {{"p (kPa)", 101.1943521, 5e-8, p_kPa}}},
      {path("isotropic compression, steady", isotropic, isotropic_compression(kRate, 0.1)),
       {{"p/p_B", 0.9621139, 5e-8,
         [](const Law& law, const PathEnd& end) {
           return 1e3 * p_kPa(law, end) / law.preconsolidation_pressure(end.state.void_ratio);
         }}}},
      {path("isotropic relaxation, 1e6 s", isotropic, principal_strain(0.0, 0.0, 0.0, 1e6)),
       {{"p (kPa)", 68.87465481, 5e-9, p_kPa}}},
      {path("isotropic creep, 1e6 s", isotropic, stress_hold(1e6)), {{"e", 1.427927958, 5e-10, void_ratio}}},
      {path("oedometric CRS at 1e-6 /s", inclined, oedometric(kRate, 0.2)),
       {{"sigma_a (kPa)", 806.17380535, 5e-9, axial_kPa},
        {"K0", 0.72005924, 5e-9,
         [](const Law&, const PathEnd& end) { return end.state.stress[1] / end.state.stress[0]; }},
        {"e", 1.04682688, 5e-9, void_ratio}}},
      {path("oedometric CRS at 1e-5 /s", inclined, oedometric(10 * kRate, 0.2)),
       {{"sigma_a (kPa)", 904.54188285, 5e-9, axial_kPa}}},
      {path("undrained compression at 1e-6 /s", isotropic, undrained(kRate, 0.3)),
       {{"p (kPa)", 50.51454122, 5e-9, p_kPa}, {"q (kPa)", 49.69261978, 5e-9, q_kPa}}},
      {path("undrained compression at 1e-5 /s", isotropic, undrained(10 * kRate, 0.3)),
       {{"p (kPa)", 56.67816676, 5e-9, p_kPa}, {"q (kPa)", 55.75603852, 5e-9, q_kPa}}},
      {path("undrained extension at 1e-6 /s", isotropic, undrained(-kRate, 0.3)),
       {{"p (kPa)", 50.54583972, 5e-9, p_kPa}, {"q (kPa)", -37.42704193, 5e-9, q_kPa}}},
      {path("shear without spin, gamma 0.5", sheared, shear(0.5 * kRate, 0.5)),
       {{"sigma_11 (kPa)", 49.15989, 5e-6, axial_kPa},
        {"sigma_22 (kPa)", 49.15938, 5e-6,
         [](const Law&, const PathEnd& end) { return -end.state.stress[1] / 1e3; }},
        {"sigma_33 (kPa)", 49.15938, 5e-6,
         [](const Law&, const PathEnd& end) { return -end.state.stress[2] / 1e3; }},
        {"tau (kPa)", 23.29878, 5e-6,
         [](const Law&, const PathEnd& end) { return end.state.stress[3] / (std::numbers::sqrt2 * 1e3); }}}},
  };
}

}  // namespace

std::string Contender::label() const {
  return fmt::format("{} {:.0e}", integrators::name(method), tolerance);
}

ReferenceTable reference_table() {
  using enum integrators::Method;
  ReferenceTable table{{{cvode, 1e-10},
                        {rosenbrock, 1e-8},
                        {fellin_ostermann, 1e-4},
                        {fellin_ostermann, 1e-6},
                        {fellin_ostermann, 1e-8}},
                       {}};
  for (const Case& entry : table_cases()) {
    const std::size_t first = table.rows.size();
    for (const Quantity& quantity : entry.quantities) {
      table.rows.push_back({entry.path.name + ": " + quantity.name, quantity.expected, quantity.half_digit,
                            driven_strain(entry.path)});
    }
    const Law law(entry.path.parameters);
    for (const Contender& contender : table.contenders) {
      const auto end = follow(entry.path, options_of(contender.method, contender.tolerance));
      for (std::size_t k = 0; k < entry.quantities.size(); ++k) {
        table.rows[first + k].got.push_back(end ? entry.quantities[k].read(law, *end)
                                                : std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
  return table;
}

std::vector<Check> checks_of(const ReferenceTable& table) {
  std::vector<Check> checks;
  for (const ReferenceRow& row : table.rows) {
    for (std::size_t k = 0; k < table.contenders.size(); ++k) {
      const Contender& contender = table.contenders[k];
      const bool explicit_scheme = contender.method == integrators::Method::fellin_ostermann;
      const double strain = row.strain > 0.0 ? row.strain : kStrainOfHolds;
      const double relative = explicit_scheme ? 10.0 * contender.tolerance * strain / 0.1 : 1e-6;
      checks.push_back({"reference numbers", row.name, contender.label(), row.expected, row.got[k],
                        relative * std::abs(row.expected) + row.half_digit,
                        "independent implementation, implicit Radau, rtol 1e-11"});
    }
  }
  return checks;
}

}  // namespace isotach::verification
