// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/stress_plane.hpp"

#include <cmath>
#include <numbers>

namespace isotach::reports {

StressPlane::StressPlane(const model::Parameters<double>& material)
    : lode_dependent_(material.lode() == model::LodeDependence::matsuoka_nakai) {
  const double sin_phi = std::sin(material.phi_c());
  compression_ = 6.0 * sin_phi / (3.0 - sin_phi);
  extension_ = lode_dependent_ ? 6.0 * sin_phi / (3.0 + sin_phi) : compression_;
}

PlaneCurve StressPlane::ellipse(double p_B, const model::Mandel<double>& omega, std::size_t axis,
                                bool with_extension) const {
  constexpr int kPoints = 180;  // on each side
  PlaneCurve curve;
  const auto add = [&](double eta) {
    // F: 1 in triaxial compression, 1 - |q|/(3p) in extension
    const double F = eta < 0.0 && lode_dependent_ ? 1.0 + eta / 3.0 : 1.0;
    const double A = F * F * compression_ * compression_ - 1.5 * omega.squaredNorm();
    if (!(F > 0.0 && A > 0.0)) return;
    model::Mandel<double> ratio = model::Mandel<double>::Zero();  // T*/p
    ratio.head<3>().setConstant(eta / 3.0);
    ratio[static_cast<Eigen::Index>(axis)] = -2.0 * eta / 3.0;
    // p_B+ = p + (3/2) |T* - p Omega|^2/(p A)
    const double p = p_B / (1.0 + 1.5 * (ratio - omega).squaredNorm() / A);
    curve.p.push_back(p);
    curve.q.push_back(eta * p);
  };
  // eta = M tan(angle): even steps along the ellipse
  for (int i = with_extension ? -kPoints + 1 : 0; i < kPoints; ++i) {
    add(compression_ * std::tan(0.5 * std::numbers::pi * i / kPoints));
  }
  return curve;
}

}  // namespace isotach::reports
