// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The slump tests of a study as the problem of a fit, simulations corrected at one place.
#pragma once

#include <memory>
#include <tl/expected.hpp>
#include <vector>

#include "calibration/problem.hpp"
#include "calibration/reference_numerics.hpp"
#include "calibration/simulation_error.hpp"

namespace isotach::calibration {

using SlumpExperiments = std::vector<std::shared_ptr<const experiments::SlumpExperiment>>;

/// All tests of a study, in their order, with effects of which some parameters are `free`.
[[nodiscard]] SlumpExperiments slump_experiments(const datasets::Study& study,
                                                 const experiments::Simulate& simulate,
                                                 const SimulationError& error, const Corrections& corrections,
                                                 const effects::Values<double>& effects,
                                                 const std::vector<effects::ParameterRef>& free);

/// The effect parameters that the study lets slump fits move.
[[nodiscard]] std::vector<effects::ParameterRef> free_slump_effects(const datasets::Study& study);

/// Those that are not held out.
[[nodiscard]] SlumpExperiments fitted_of(const SlumpExperiments& all);

/// What residuals of slump tests share: what the simulations' numerics do alike to all of them, and what the
/// volume of their outlines is off by.
[[nodiscard]] CommonError common_error_of(const SlumpExperiments& fitted, const SimulationError& error);

/// Where a slump fit stands.
struct SlumpPlace {
  model::Parameters<double> parameters;
  effects::Values<double> effects;  ///< of the study, free ones as fitted
  std::vector<double> mud;          ///< of the study's slump_mud; as the tests state it where empty
};

/// All tests of a study and the problem of moving `wanted`, free effects and the mud.
struct CorrectedSlumps {
  SlumpExperiments tests;  ///< in their order
  Problem problem;
  std::vector<double> start;  ///< coordinates of the place
  Corrections corrections;    ///< at that place

  /// The place of coordinates that the problem admits.
  [[nodiscard]] SlumpPlace place_at(const std::vector<double>& x) const;
};

/// Where the study has reference numerics, every test is simulated both ways at `place`. D_r stays: the
/// oedometer's gauge has been applied. The problem's common error is that of common_error_of().
[[nodiscard]] tl::expected<CorrectedSlumps, FitFailure> corrected_slumps(
    const datasets::Study& study, const SlumpPlace& place, const std::vector<model::ParameterId>& wanted,
    const experiments::Simulate& simulate, const SimulationError& error, int threads);

}  // namespace isotach::calibration
