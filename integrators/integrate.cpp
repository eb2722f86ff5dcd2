// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Names of the integrators, and the choice between them.
#include "integrators/integrate.hpp"

namespace isotach::integrators {

std::string_view name(Method method) {
  return method == Method::fellin_ostermann ? "fellin-ostermann" : "cvode";
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
  }
  return tl::unexpected(Failure{FailureKind::solver, 0.0, state});
}

}  // namespace isotach::integrators
