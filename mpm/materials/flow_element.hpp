// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A deviatoric stress that is elastic up to a yield stress and flows beyond it.
#pragma once

#include <limits>

namespace isotach::mpm {

/// The stress is elastic (Jaumann rate, turned exactly by the step's rotation) below the yield stress tau_y;
/// beyond it, with tau = |T*|/sqrt 2 and g the plastic shear rate,
///
///   tau = tau_y + k g^n,  dtau/dt = G (gamma_rate - g),
///
/// stepped implicitly. The yield surface is von Mises'.
struct FlowElement {
  double shear_modulus;                                           ///< G (Pa), > 0
  double yield_stress = std::numeric_limits<double>::infinity();  ///< tau_y (Pa), >= 0
  double consistency = 0.0;                                       ///< k (Pa s^n), >= 0
  double flow_index = 1.0;                                        ///< n (-), > 0

  /// What a step starts from and ends with, or its rate: deviator in the plane, shear as it is.
  struct Components {
    double rr, zz, tt, rz;
  };

  /// The stress (Pa) after a step of dt (s) at strain rate D (1/s), of which the deviator counts, and spin
  /// W_rz (1/s).
  [[nodiscard]] Components after(const Components& stress, const Components& strain_rate, double spin,
                                 double dt) const;

  /// Plastic shear rate (1/s) of a step of dt (s) whose elastic trial stress tau (Pa) is beyond the yield
  /// stress.
  [[nodiscard]] double flow_rate(double trial, double dt) const;
};

}  // namespace isotach::mpm
