// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The one interface to all integrators.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "integrators/cvode.hpp"
#include "integrators/fellin_ostermann.hpp"
#include "integrators/rosenbrock.hpp"

namespace isotach::integrators {

enum class Method {
  fellin_ostermann,  ///< adaptive extrapolated Euler: explicit, for short increments
  cvode,             ///< SUNDIALS CVODES: variable-order BDF, the reference
  rosenbrock         ///< linearly implicit, one-step: for long, stiff increments
};

/// Every method, in the order of the enumeration.
inline constexpr std::array kMethods{Method::fellin_ostermann, Method::cvode, Method::rosenbrock};

/// The method's name on the command line and in results.
[[nodiscard]] std::string_view name(Method method);

/// The method of that name, if there is one.
[[nodiscard]] std::optional<Method> find_method(std::string_view name);

/// The choice of method, and the tolerances of each; those of the others are not read.
struct Options {
  Method method = Method::fellin_ostermann;
  Tolerance fellin_ostermann;
  CvodeTolerance cvode;
  Tolerance rosenbrock;
};

/// Advances `state` over `increment`. An increment of zero duration returns the state unchanged.
[[nodiscard]] tl::expected<Integrated<double>, Failure> integrate(const model::Law<double>& law,
                                                                  const model::State<double>& state,
                                                                  const Increment<double>& increment,
                                                                  const Options& options = {});

}  // namespace isotach::integrators
