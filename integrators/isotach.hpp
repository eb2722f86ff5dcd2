// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The line of steady oedometric compression at one strain rate in the compression plane: an isotach.
#pragma once

#include <cmath>
#include <string>
#include <tl/expected.hpp>

#include "integrators/steady_oedometric.hpp"
#include "model/law.hpp"

namespace isotach::integrators {

/// Void ratio against axial effective stress in steady oedometric compression at a constant axial strain
/// rate: OCR and K0 are constant on it, so that p_B is proportional to the axial stress.
class Isotach {
 public:
  /// `axial_strain_rate` in 1/s, compression, > 0. Fails as steady_oedometric does.
  [[nodiscard]] static tl::expected<Isotach, std::string> create(const model::Parameters<double>& parameters,
                                                                 double axial_strain_rate) {
    const auto steady = steady_oedometric(parameters, axial_strain_rate);
    if (!steady) return tl::unexpected(steady.error());
    const model::Law<double> law(parameters);
    model::Mandel<double, model::kPlane> stress;  // 1 = axial, sigma_a = 1 Pa
    stress << -1.0, -steady->K0, -steady->K0, 0.0;
    model::State<double, model::kPlane> state{stress, 0.0};
    if (parameters.rotates()) state.omega = law.measures(stress).ratio * parameters.C_3();
    const double ocr = std::pow(steady->viscous_rate / parameters.D_r(), -parameters.I_v());
    return Isotach(law, axial_strain_rate, steady->K0, ocr, ocr * law.measures(state).equivalent_pressure);
  }

  [[nodiscard]] double axial_strain_rate() const { return rate_; }  ///< 1/s
  [[nodiscard]] double K0() const { return K0_; }                   ///< lateral to axial effective stress (-)
  [[nodiscard]] double ocr() const { return ocr_; }                 ///< p_B/p_B+ (-)
  /// Void ratio (-) at an axial effective stress (Pa, compression positive, > 0).
  [[nodiscard]] double void_ratio_at(double axial_stress) const {
    return law_.void_ratio_at(p_B_over_axial_stress_ * axial_stress);
  }
  /// The axial effective stress (Pa, compression positive) at a void ratio (-).
  [[nodiscard]] double axial_stress_at(double void_ratio) const {
    return law_.preconsolidation_pressure(void_ratio) / p_B_over_axial_stress_;
  }

 private:
  Isotach(const model::Law<double>& law, double rate, double K0, double ocr, double p_B_over_axial_stress)
      : law_(law), rate_(rate), K0_(K0), ocr_(ocr), p_B_over_axial_stress_(p_B_over_axial_stress) {}

  model::Law<double> law_;
  double rate_;
  double K0_;
  double ocr_;
  double p_B_over_axial_stress_;
};

}  // namespace isotach::integrators
