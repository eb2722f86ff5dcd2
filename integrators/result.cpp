// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Failures of integration in words.
#include "integrators/result.hpp"

#include <fmt/format.h>

namespace isotach::integrators {

namespace {

const char* describe(FailureKind kind) {
  switch (kind) {
    case FailureKind::outside_domain:
      return "the state is outside the law's domain (p > 0, q < 3p, e > 0, (3/2) Omega:Omega < M^2, free "
             "strain rates solvable)";
    case FailureKind::substep_underflow:
      return "substeps became too small to advance time";
    case FailureKind::too_many_substeps:
      return "the limit of substeps was reached";
    case FailureKind::solver:
      return "the reference solver gave up";
  }
  return "unknown failure";
}

}  // namespace

std::string Failure::message() const {
  const double p = -model::trace<double, 6>(last_state.stress) / 3.0;
  std::string text =
      fmt::format("integration failed {:.6g} s into the increment, at p = {:.6g} kPa, e = {:.6g}: {}", time,
                  p / 1e3, last_state.void_ratio, describe(kind));
  if (statistics.accepted + statistics.rejected > 0) {
    text += fmt::format(" ({} substeps accepted, {} rejected)", statistics.accepted, statistics.rejected);
  }
  if (kind == FailureKind::solver) text += fmt::format(" (flag {})", solver_flag);
  return text;
}

}  // namespace isotach::integrators
