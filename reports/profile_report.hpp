// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines read from pictures, as a page, as JSON and as CSV.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "images/series.hpp"
#include "reports/output_directory.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// A run of isotach profile.
struct ProfileRun {
  std::vector<images::TimedOutcome> pictures;                 ///< by increasing time
  std::vector<std::pair<std::string, std::string>> settings;  ///< what was asked for: a name and its words
  std::optional<double> camera_distance{};  ///< m; without it lines of sight were taken to be parallel
  std::optional<double> mould_volume{};     ///< m3
  double volume_limit = 0.05;               ///< a share
};

/// Overlays to be checked by eye, outlines, and a table of time, height, toe, volume, asymmetry and tilt.
[[nodiscard]] Page profile_report(const RunInfo& run, const ProfileRun& profile);

[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const ProfileRun& profile);

/// outlines.csv (as the data format: time_s, r_mm, z_mm); sides.csv (the same points with half_difference_mm
/// along the normal, positive where the right side is further out, and left_r_mm, left_z_mm, right_r_mm,
/// right_z_mm); history.csv (time_s, height_mm, toe_mm, volume_ml, volume_error, asymmetry_mm, lean_deg).
void write_curves(OutputDirectory& output, const ProfileRun& profile);

/// One line for each picture that was refused, with its reason.
[[nodiscard]] std::vector<std::string> refusals(const ProfileRun& profile);

}  // namespace isotach::reports
