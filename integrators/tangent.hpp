// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The consistent tangent: how the stress at the end of a strain-driven increment follows its strain.
#pragma once

#include <tl/expected.hpp>

#include "integrators/fellin_ostermann.hpp"

namespace isotach::integrators {

/// An integrated increment with d T_new/d(D dt) (Pa), Mandel components of stress by those of strain, at
/// fixed duration and start.
template <model::Fabric K = model::Fabric::omega>
struct IntegratedWithTangent {
  Integrated<double, K> result;
  Eigen::Matrix<double, 6, 6> tangent;
};

/// Fellin-Ostermann over a strain-driven increment with its tangent.
///
/// The tangent is the exact derivative of the discrete map, that is of the substeps taken at their sizes, by
/// automatic differentiation in forward mode; the state is that without a tangent but for the last bit or
/// two, where the compiler fuses multiplications with additions differently. An increment of zero duration
/// returns the state and the limit of vanishing strain along the strain rate, E : (1 - C_1 m (x) D/|D|);
/// where D = 0 in it, E. std::invalid_argument where the increment is stress-controlled.
template <model::Fabric K>
[[nodiscard]] tl::expected<IntegratedWithTangent<K>, Failure> integrate_with_tangent(
    const model::Law<double>& law, const model::State<double, model::kGeneral, K>& start,
    const Increment<double>& increment, const Tolerance& tolerance, double first_substep = 0.0);

extern template tl::expected<IntegratedWithTangent<model::Fabric::omega>, Failure> integrate_with_tangent(
    const model::Law<double>&, const model::State<double, model::kGeneral, model::Fabric::omega>&,
    const Increment<double>&, const Tolerance&, double);
extern template tl::expected<IntegratedWithTangent<model::Fabric::none>, Failure> integrate_with_tangent(
    const model::Law<double>&, const model::State<double, model::kGeneral, model::Fabric::none>&,
    const Increment<double>&, const Tolerance&, double);

}  // namespace isotach::integrators
