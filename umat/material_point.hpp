// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One material point over one increment of a finite element analysis, in SI and Mandel form.
#pragma once

#include <tl/expected.hpp>

#include "integrators/tangent.hpp"

namespace isotach::umat {

/// What the analysis prescribes.
struct PointIncrement {
  model::Mandel<double> strain;  ///< logarithmic strain increment (-), tension positive
  double duration;               ///< s, >= 0
};

/// What it gets back.
struct PointUpdate {
  model::State<double> state;           ///< at the end
  Eigen::Matrix<double, 6, 6> tangent;  ///< d T_end/d strain (Pa), Mandel components
  integrators::Statistics statistics;
};

/// Advances a point whose stress and Omega have already been turned with the material.
///
/// - duration > 0: the strain at a constant rate, by integrators::integrate_with_tangent; without strain,
/// relaxation.
/// - duration = 0 with strain: the rate-independent limit, in which viscous strain has no time to happen: the
/// law
///   with D_vis = 0, hence with Omega fixed and, at isotropic stress, bulk stiffness (p/kappa)(1 -+ C_1).
/// - neither: the state as it is, with E, the tangent of the law where it is elastic.
[[nodiscard]] tl::expected<PointUpdate, integrators::Failure> advance(
    const model::Law<double>& law, const model::State<double>& start, const PointIncrement& increment,
    const integrators::Tolerance& tolerance);

/// R A R^T of a symmetric tensor's components 11, 22, 33, 12, 13, 23; with R = 1 the same to the last bit.
[[nodiscard]] Eigen::Matrix<double, 6, 1> rotated(const Eigen::Matrix<double, 6, 1>& components,
                                                  const Eigen::Matrix3d& rotation);

/// Voigt matrix (stress 11, 22, 33, 12, 13, 23 by strain with engineering shear) of a Mandel one.
[[nodiscard]] Eigen::Matrix<double, 6, 6> voigt_tangent(const Eigen::Matrix<double, 6, 6>& mandel);

}  // namespace isotach::umat
