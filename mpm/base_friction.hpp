// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the base gives way to.
#pragma once

#include <limits>

namespace isotach::mpm {

/// How a base without slip (Side::fixed) yields to shear. As it stands, not at all.
struct BaseFriction {
  /// Largest shear traction (Pa): adhesion + friction times normal pressure; no limit where it is infinite.
  double adhesion = std::numeric_limits<double>::infinity();
  double friction = 0.0;     ///< Coulomb's coefficient (-), >= 0
  double slip_length = 0.0;  ///< Navier's: slip velocity = slip_length dv_r/dz (m), >= 0

  [[nodiscard]] bool limited() const { return adhesion < std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool yields() const { return limited() || slip_length > 0.0; }
};

}  // namespace isotach::mpm
