// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_common_error.hpp"

#include "calibration/corrected_slumps.hpp"
#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"

namespace isotach::discovery {

namespace {

/// The tests by the scheme of transfer that the study does not use.
tl::expected<std::vector<std::optional<mpm::SlumpResult>>, calibration::FitFailure> by_other_scheme(
    const SlumpBasis& basis, const SlumpTests& fitted) {
  std::vector<std::optional<mpm::SlumpResult>> other(fitted.size());
  std::vector<mpm::RunStatus> statuses(fitted.size(), mpm::RunStatus::ok);
  calibration::parallel_for(fitted.size(), basis.threads, [&](std::size_t i) {
    mpm::SlumpSetup setup = datasets::with_effects(fitted[i]->test().setup, basis.study.effects);
    mpm::Scheme& scheme = setup.numerics.scheme;
    scheme = scheme == mpm::Scheme::plain ? mpm::Scheme::conserving : mpm::Scheme::plain;
    auto run = basis.simulate(fitted[i]->name(), basis.start, setup);
    if (run) {
      other[i] = std::move(*run);
    } else {
      statuses[i] = run.error().status;
    }
  });
  for (const mpm::RunStatus status : statuses) {
    if (status == mpm::RunStatus::interrupted) {
      return tl::unexpected(calibration::FitFailure{"interrupted", true});
    }
  }
  return other;
}

}  // namespace

tl::expected<calibration::CommonError, calibration::FitFailure> common_error(const SlumpBasis& basis,
                                                                             const SlumpTests& tests) {
  const SlumpTests fitted = calibration::fitted_of(tests);
  calibration::SimulationError error = basis.error;
  if (!calibration::has_reference(basis.study)) {
    auto runs = by_other_scheme(basis, fitted);
    if (!runs) return tl::unexpected(runs.error());
    error.variants.push_back({.name = "the other scheme", .runs = std::move(*runs)});
  }
  return calibration::CommonError(calibration::directions_of(error, fitted));
}

}  // namespace isotach::discovery
