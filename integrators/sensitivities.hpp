// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Reference sensitivities: derivatives of an integrated increment by parameters, loading and start.
#pragma once

#include <array>
#include <tl/expected.hpp>
#include <vector>

#include "integrators/cvode.hpp"
#include "integrators/tangent.hpp"

namespace isotach::integrators {

/// How the inputs of an increment move with one scalar s: the derivative of each by s. By default nothing
/// moves.
struct Direction {
  std::array<double, model::kParameterCount> parameters{};            ///< SI, in the order of ParameterId
  model::Mandel<double> strain_rate = model::Mandel<double>::Zero();  ///< 1/s, where not stress-controlled
  model::Mandel<double> stress_rate = model::Mandel<double>::Zero();  ///< Pa/s, where stress-controlled
  model::State<double> start{model::Mandel<double>::Zero(), 0.0};
};

/// The direction along which s is one parameter (SI).
[[nodiscard]] Direction along(model::ParameterId id);

/// Derivatives of the end of an increment by the scalar of one direction.
struct Derivative {
  model::State<double> state;    ///< Pa, -, - per unit of s; the `start` of a direction in the next increment
  model::Mandel<double> strain;  ///< of the strain increment
};

struct IntegratedWithSensitivities {
  Integrated<double> result;            ///< statistics: without the evaluations that the derivatives took
  std::vector<Derivative> derivatives;  ///< one for each direction
};

/// CVODES over one increment of any control, with forward sensitivities.
///
/// Along with dy/dt = f(y) it solves the variational equations ds/dt = (df/dy) s + df/d(direction), s the
/// derivative of y, for all directions at once (staggered corrector), their error controlled as that of y;
/// `tolerance` then holds for a direction scaled to a relative size of one. The right-hand sides are exact,
/// by automatic differentiation. So this is the derivative of the exact solution, where Jets through
/// integrate_fellin_ostermann and integrate_with_tangent give that of the discrete map.
[[nodiscard]] tl::expected<IntegratedWithSensitivities, Failure> integrate_with_sensitivities(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    const CvodeTolerance& tolerance, const std::vector<Direction>& directions);

/// CVODES over a strain-driven increment with d T_new/d(D dt) (Pa, Mandel components), the tangent of the
/// exact solution. A zero duration and an increment that is not strain-driven: as integrate_with_tangent.
[[nodiscard]] tl::expected<IntegratedWithTangent<>, Failure> integrate_cvode_with_tangent(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    const CvodeTolerance& tolerance);

}  // namespace isotach::integrators
