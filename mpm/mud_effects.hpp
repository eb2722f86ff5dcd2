// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What mud of a slump may show beside the law of its skeleton.
#pragma once

namespace isotach::mpm {

/// Strength that rest builds and shear breaks: p_B (1 + s xi), dxi/dt = (1 - xi)/t_a - beta xi gamma_rate,
/// gamma_rate = sqrt(2) |D|; xi = 1 at the start; OCR is of the p_B that they make.
struct Thixotropy {
  double gain = 0.0;           ///< s (-), >= 0; zero is none
  double recovery_time = 1.0;  ///< t_a (s), > 0
  double breakdown = 1.0;      ///< beta (-), >= 0

  [[nodiscard]] bool acts() const { return gain > 0.0; }
};

/// A deviatoric stress beside the law's: elastic up to tau_y, beyond it flowing as Herschel and Bulkley have
/// it (flow_element.hpp), with tau = |T*|/sqrt 2 = tau_y + K gamma_rate^n.
struct FlowResistance {
  double yield_stress = 0.0;  ///< tau_y (Pa), >= 0
  double consistency = 0.0;   ///< K (Pa s^n), >= 0
  double flow_index = 0.5;    ///< n (-), > 0

  [[nodiscard]] bool acts() const { return yield_stress > 0.0 || consistency > 0.0; }
};

/// As it stands, nothing.
struct MudEffects {
  Thixotropy thixotropy;
  FlowResistance resistance;
  double draining_rate = 0.0;        ///< b (1/s), >= 0: du/dt = ... - b u, the mud losing volume as u fades
  double void_ratio_gradient = 0.0;  ///< g (-): e0 + g (z/H - 1/2) over the fill's height H
  double surface_tension = 0.0;      ///< N/m, >= 0, of the free surface

  /// Whether the mud's stress obeys more than the law.
  [[nodiscard]] bool change_stress() const {
    return thixotropy.acts() || resistance.acts() || draining_rate > 0.0;
  }
};

}  // namespace isotach::mpm
