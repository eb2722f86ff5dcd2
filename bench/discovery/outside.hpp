// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What is wrong with soil or apparatus in ways that the catalogue of effects lacks: only the benchmark knows
// them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "datasets/study.hpp"

namespace isotach::bench {

/// Symbols: sigma' the specimen's effective axial stress, eps its engineering strain, eps_m the measured one,
/// H0 the height, e0 the first void ratio; compression positive; a the amplitude, of which zero is nothing.
enum class OutsideKind {
  /// Water leaves through a leak: measured stress = sigma' + (2/3) u, du/dt = (a (H0/20 mm)^2 deps/dt - u)/t,
  /// t = 1e4 s; a in Pa s.
  leaking_drainage,
  /// -d ln p_B/d ln(1+e) = (1 + a ln((1+e0)/(1+e)))/lambda.
  lambda_of_void_ratio,
  /// The frame has a dead travel a (m), taken up anew whenever the direction turns; meanwhile the specimen
  /// stands still.
  frame_slack,
  load_cell_zero,       ///< measured stress = sigma' + a, a in Pa
  height_error,         ///< eps = (1 + a) eps_m
  load_cell_curvature,  ///< measured stress = sigma' (1 + a sigma'/100 kPa)
  load_cell_swing       ///< measured stress = sigma' + a sin(2 pi t/day + 1), a in Pa
};

struct OutsideInfo {
  OutsideKind kind;
  std::string_view name;
  double typical;  ///< amplitude from which one of a given visibility is sought
  double most;     ///< largest amplitude
  bool either_sign;
};
[[nodiscard]] std::span<const OutsideInfo> outside_effects();
[[nodiscard]] const OutsideInfo& info_of(OutsideKind kind);

struct Outside {
  OutsideKind kind;
  double amplitude;
};

/// ln(axial stress / 1 Pa) that is read at each row of a blank test: the law in six components under the
/// strain history, integrated by CVODES at a relative tolerance of 1e-10. An error says where it could not
/// go.
[[nodiscard]] tl::expected<std::vector<double>, std::string> log_stress_with(
    const datasets::OedometerTest& test, const model::Parameters<double>& truth, const Outside& outside);

}  // namespace isotach::bench
