// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Names of the integrators, and the choice between them.
#include "integrators/integrate.hpp"

#include <algorithm>

namespace isotach::integrators {

std::string_view name(Method method) {
  switch (method) {
    case Method::fellin_ostermann:
      return "fellin-ostermann";
    case Method::cvode:
      return "cvode";
    case Method::rosenbrock:
      return "rosenbrock";
  }
  return "unknown";
}

std::optional<Method> find_method(std::string_view wanted) {
  const auto* found = std::ranges::find(kMethods, wanted, [](Method method) { return name(method); });
  if (found == kMethods.end()) return std::nullopt;
  return *found;
}

tl::expected<Integrated<double>, Failure> integrate(const model::Law<double>& law,
                                                    const model::State<double>& state,
                                                    const Increment<double>& increment,
                                                    const Options& options) {
  switch (options.method) {
    case Method::fellin_ostermann:
      return integrate_fellin_ostermann(law, state, increment, options.fellin_ostermann);
    case Method::cvode:
      return integrate_cvode(law, state, increment, options.cvode);
    case Method::rosenbrock:
      return integrate_rosenbrock(law, state, increment, options.rosenbrock);
  }
  return tl::unexpected(Failure{FailureKind::solver, 0.0, state});
}

}  // namespace isotach::integrators
