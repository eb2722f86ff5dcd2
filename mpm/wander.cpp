// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/wander.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::mpm {

double Wander::operator()(double x) const {
  const auto above = std::upper_bound(at.begin(), at.end(), x);
  if (above == at.begin()) return change.front();
  if (above == at.end()) return change.back();
  const auto k = static_cast<std::size_t>(above - at.begin());
  const double share = (x - at[k - 1]) / (at[k] - at[k - 1]);
  return change[k - 1] + share * (change[k] - change[k - 1]);
}

double Wander::in_time(WanderSlot which, double t) const {
  return slot == which ? (*this)(std::log(t)) : 0.0;
}

}  // namespace isotach::mpm
