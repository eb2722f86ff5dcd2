// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Advances one material point over one increment.
#include "umat/material_point.hpp"

namespace isotach::umat {

namespace {

using model::Fabric;

template <Fabric K>
tl::expected<PointUpdate, integrators::Failure> integrated(const model::Law<double>& law,
                                                           const model::State<double>& start,
                                                           const integrators::Increment<double>& increment,
                                                           const integrators::Tolerance& tolerance) {
  auto end = integrators::integrate_with_tangent<K>(law, model::in_form<K>(start), increment, tolerance);
  if (!end) return tl::unexpected(std::move(end.error()));
  return PointUpdate{model::with_omega(end->result.state), end->tangent, end->result.statistics};
}

/// The same law without viscous strain: D_r is so small that over a second none is left, even where
/// OCR^(-1/I_v) is 1e150; and what viscous strain turns stands still.
model::Law<double> without_creep(const model::Law<double>& law) {
  constexpr double kVanishingRate = 1e-250;  // 1/s
  model::ParameterValues<double> values = law.parameters().values();
  values[model::ParameterId::D_r] = kVanishingRate;
  values[model::ParameterId::C_2] = 0.0;
  return model::Law<double>(model::Parameters<double>::create(values).value());
}

}  // namespace

tl::expected<PointUpdate, integrators::Failure> advance(const model::Law<double>& law,
                                                        const model::State<double>& start,
                                                        const PointIncrement& increment,
                                                        const integrators::Tolerance& tolerance) {
  const bool instantaneous = increment.duration == 0.0;
  const bool strained = (increment.strain.array() != 0.0).any();
  integrators::Increment<double> rates;
  if (!instantaneous) {
    rates = integrators::strain_increment<double>(increment.strain / increment.duration, increment.duration);
  } else if (strained) {
    rates = integrators::strain_increment<double>(increment.strain, 1.0);
  }
  const model::Law<double> used = instantaneous && strained ? without_creep(law) : law;
  // Omega costs time: it is left out where it is zero and stays so
  const bool isotropic = !law.parameters().rotates() && (start.omega.array() == 0.0).all();
  return isotropic ? integrated<Fabric::none>(used, start, rates, tolerance)
                   : integrated<Fabric::omega>(used, start, rates, tolerance);
}

Eigen::Matrix<double, 6, 1> rotated(const Eigen::Matrix<double, 6, 1>& c, const Eigen::Matrix3d& rotation) {
  Eigen::Matrix3d a;
  a << c[0], c[3], c[4], c[3], c[1], c[5], c[4], c[5], c[2];
  const Eigen::Matrix3d r = rotation * a * rotation.transpose();
  Eigen::Matrix<double, 6, 1> result;
  result << r(0, 0), r(1, 1), r(2, 2), r(0, 1), r(0, 2), r(1, 2);
  return result;
}

Eigen::Matrix<double, 6, 6> voigt_tangent(const Eigen::Matrix<double, 6, 6>& mandel) {
  Eigen::Matrix<double, 6, 6> result;
  for (int j = 0; j < 6; ++j) {
    const Eigen::Matrix<double, 6, 1> unit = Eigen::Matrix<double, 6, 1>::Unit(j);
    result.col(j) =
        model::voigt_stress_from_mandel<double>(mandel * model::mandel_from_voigt_strain<double>(unit));
  }
  return result;
}

}  // namespace isotach::umat
