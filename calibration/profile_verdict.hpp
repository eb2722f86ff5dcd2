// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a profile adds to the verdict on a parameter.
#pragma once

#include <fmt/format.h>

#include <string>

#include "calibration/fit_result.hpp"
#include "calibration/profile.hpp"

namespace isotach::calibration {

/// A profile that does not close tells more than a standard error.
template <class Estimate>
void heed_profile(const Profile& profile, Estimate& estimate) {
  const bool closed = profile.lower_end == ProfileEnd::crossed && profile.upper_end == ProfileEnd::crossed;
  if (closed || estimate.verdict == Verdict::undetermined) return;
  const auto side = [](ProfileEnd end, const char* which) {
    return end == ProfileEnd::crossed ? std::string() : fmt::format("{} {}", which, name_of(end));
  };
  const std::string lower = side(profile.lower_end, "below,");
  const std::string upper = side(profile.upper_end, "above,");
  if (profile.lower_end != ProfileEnd::crossed && profile.upper_end != ProfileEnd::crossed) {
    estimate.verdict = Verdict::undetermined;
  } else if (estimate.verdict == Verdict::identified) {
    estimate.verdict = Verdict::weak;
  }
  estimate.words =
      "its profile does not close: " + lower + (lower.empty() || upper.empty() ? "" : "; ") + upper;
}

}  // namespace isotach::calibration
