// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The one interface to all integrators.
#pragma once

#include <string_view>

#include "integrators/cvode.hpp"
#include "integrators/fellin_ostermann.hpp"

namespace isotach::integrators {

enum class Method {
  fellin_ostermann,  ///< adaptive extrapolated Euler
  cvode              ///< SUNDIALS CVODE, the reference
};

[[nodiscard]] std::string_view name(Method method);

struct Options {
  Method method = Method::fellin_ostermann;
  Tolerance fellin_ostermann;
  CvodeTolerance cvode;
};

/// Advances `state` over `increment`. An increment of zero duration returns the state unchanged.
[[nodiscard]] tl::expected<Integrated<double>, Failure> integrate(const model::Law<double>& law,
                                                                  const model::State<double>& state,
                                                                  const Increment<double>& increment,
                                                                  const Options& options = {});

}  // namespace isotach::integrators
