// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The points of an oedometer test as the model goes through it.
#pragma once

#include <cstddef>

namespace isotach::experiments {

/// A point of a test as the model goes through it. Compression positive.
struct PathPoint {
  double time;          ///< s
  std::size_t row;      ///< of the record; kNoRow at the start, if no reading is the start
  double axial_stress;  ///< Pa, as the instrument reads it
  double axial_strain;  ///< engineering (-), as the instrument reads it
  double void_ratio;    ///< the law's (-)
  double K0;            ///< radial over axial effective stress (-)
  double ocr;           ///< p_B/p_B+ (-)
};

/// Which integrator makes a path.
enum class Route {
  fellin_ostermann,  ///< the one that fits use
  cvode              ///< the reference
};

}  // namespace isotach::experiments
