// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The unit in which a span of time is best read.
#pragma once

namespace isotach::reports {

struct TimeUnit {
  const char* name;
  double seconds;
};

/// Seconds, minutes, hours or days, so that the span (s) is a number of two digits or so.
[[nodiscard]] constexpr TimeUnit time_unit_for(double span) {
  constexpr double kMinute = 60.0;
  constexpr double kHour = 3600.0;
  constexpr double kDay = 86400.0;
  if (span > 3.0 * kDay) return {"d", kDay};
  if (span > 3.0 * kHour) return {"h", kHour};
  if (span > 5.0 * kMinute) return {"min", kMinute};
  return {"s", 1.0};
}

}  // namespace isotach::reports
