// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The reference integration of specimens with effects, by SUNDIALS CVODES.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/effects_rate.hpp"
#include "experiments/oedometer_protocol.hpp"
#include "integrators/result.hpp"

namespace isotach::experiments::detail {

/// A system of ordinary differential equations of plain numbers.
struct PlainSystem {
  /// dy/dt at a time (s); false where it has no value.
  std::function<bool(double time, const double* y, double* rate)> rate;
  /// Sees y after each step of the solver.
  std::function<void(double time, const double* y)> stepped;
  std::vector<double> scale;  ///< of each unknown, to which its tolerance is relative; > 0
};

/// Advances y by `duration` (s): BDF, Newton's method, relative tolerance 1e-10. False where it failed; y is
/// then where it stopped.
[[nodiscard]] bool solve_plain_system(const PlainSystem& system, double duration, std::vector<double>& y);

/// Advances a state by CVODES, as EffectsPath::follow asks for it.
struct ByCvode {
  template <model::Fabric K, class Accepted>
  [[nodiscard]] tl::expected<void, integrators::Failure> operator()(EffectsRate<double, K>& rate,
                                                                    EffectsState<double, K>& state,
                                                                    const DriveStep& drive,
                                                                    Accepted&& accepted) const {
    constexpr bool kLeans = K == model::Fabric::omega;
    const double scale = state.soil.stress.norm();
    const auto state_of = [scale](double time, const double* y) {
      EffectsState<double, K> s;
      s.soil.stress << y[0] * scale, y[1] * scale;
      s.soil.void_ratio = y[2];
      s.structure = y[3];
      s.held_strain = y[4];
      if constexpr (kLeans) s.soil.omega << y[5], y[6];
      s.elapsed = time;
      return s;
    };
    PlainSystem system;
    system.rate = [&](double time, const double* y, double* dy) {
      EffectsStateRate<double, K> f;
      if (!rate(state_of(time, y), 0.0, f)) return false;
      dy[0] = f.soil.stress[0] / scale;
      dy[1] = f.soil.stress[1] / scale;
      dy[2] = f.soil.void_ratio;
      dy[3] = f.structure;
      dy[4] = f.held_strain;
      if constexpr (kLeans) {
        dy[5] = f.soil.omega[0];
        dy[6] = f.soil.omega[1];
      }
      return true;
    };
    system.stepped = [&](double time, const double* y) { accepted(state_of(time, y)); };
    std::vector<double> y{state.soil.stress[0] / scale, state.soil.stress[1] / scale, state.soil.void_ratio,
                          state.structure, state.held_strain};
    system.scale = {1.0, 1.0, 1.0, 1.0, 0.01};
    if constexpr (kLeans) {
      y.insert(y.end(), {state.soil.omega[0], state.soil.omega[1]});
      system.scale.insert(system.scale.end(), {1.0, 1.0});
    }
    const bool done = solve_plain_system(system, drive.duration, y);
    state = state_of(drive.duration, y.data());
    if (done) return {};
    return tl::unexpected(integrators::Failure{integrators::FailureKind::solver,
                                               0.0,
                                               model::general(model::with_omega(model::plain(state.soil))),
                                               {}});
  }
};

}  // namespace isotach::experiments::detail
