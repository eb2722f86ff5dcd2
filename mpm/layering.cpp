// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/layering.hpp"

#include <cmath>

#include "mpm/gravity.hpp"

namespace isotach::mpm {

double Layering::density(double z) const {
  const double e = void_ratio(z);
  return kWaterDensity * (specific_gravity + e) / (1.0 + e);
}

// density = rho_w (1 + (G_s - 1)/(1+e)), and the integral of 1/(1+e) is (H/g) ln of the ends' quotient
double Layering::overburden(double z) const {
  if (gradient == 0.0) return density(z) * kGravity * (height - z);
  const double e = 1.0 + void_ratio(z);
  const double x = gradient * (1.0 - z / height) / e;
  const double mean = x == 0.0 ? 1.0 : std::log1p(x) / x;
  return kWaterDensity * kGravity * (height - z) * (1.0 + (specific_gravity - 1.0) / e * mean);
}

}  // namespace isotach::mpm
