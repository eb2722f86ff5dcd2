// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines read from pictures: JSON and CSV.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "reports/curves_csv.hpp"
#include "reports/json_number.hpp"
#include "reports/profile_report.hpp"
#include "reports/result_head.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using images::Reading;
using images::TimedOutcome;
using nlohmann::ordered_json;

constexpr double kMillilitres = 1e6;  // in a cubic metre
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Null where the volume was not checked.
double volume_error(const Reading& reading) {
  return reading.volume_error.value_or(std::nan(""));
}

ordered_json reading_json(const Reading& reading) {
  ordered_json json;
  json["height_mm"] = json_number(kMillimetres * reading.outline.height());
  json["toe_mm"] = json_number(kMillimetres * reading.outline.toe());
  json["volume_ml"] = json_number(kMillilitres * reading.volume);
  json["volume_error"] = json_number(volume_error(reading));
  json["asymmetry_mm"] = json_number(kMillimetres * reading.asymmetry);
  json["lean_deg"] = json_number(kDegrees * reading.lean);
  json["base_tilt_deg"] = json_number(kDegrees * reading.base_tilt);
  json["extrapolated_mm"] = json_number(kMillimetres * reading.hidden);
  json["pixel_mm"] = json_number(kMillimetres * reading.pixel);
  json["blur_mm"] = json_number(kMillimetres * reading.blur);
  json["contrast"] = json_number(reading.contrast);
  json["warnings"] = reading.warnings;
  return json;
}

ordered_json picture_json(const TimedOutcome& picture) {
  ordered_json json;
  json["file"] = picture.file.filename().string();
  json["time_s"] = json_number(picture.time);
  if (const auto& reading = picture.outcome.reading) {
    json["status"] = "read";
    json.update(reading_json(*reading));
  } else {
    json["status"] = "refused";
    json["reason"] = images::name_of(reading.error().kind);
    json["message"] = reading.error().message;
  }
  return json;
}

}  // namespace

ordered_json result_json(const RunInfo& run, const ProfileRun& profile) {
  std::vector<std::string> warnings = refusals(profile);
  ordered_json outlines = ordered_json::array();
  ordered_json pictures = ordered_json::array();
  for (const TimedOutcome& picture : profile.pictures) {
    pictures.push_back(picture_json(picture));
    const auto& reading = picture.outcome.reading;
    if (!reading) continue;
    for (const std::string& warning : reading->warnings) {
      warnings.push_back(fmt::format("{}: {}", picture.file.filename().string(), warning));
    }
    outlines.push_back({{"time_s", json_number(picture.time)},
                        {"height_mm", json_number(kMillimetres * reading->outline.height())},
                        {"toe_mm", json_number(kMillimetres * reading->outline.toe())}});
  }
  ordered_json json = result_head(run, "ok", warnings);
  json["outlines"] = std::move(outlines);
  json["pictures"] = std::move(pictures);
  for (const auto& [name, words] : profile.settings) json["settings"][name] = words;
  json["camera_distance_mm"] = json_number(kMillimetres * profile.camera_distance.value_or(std::nan("")));
  json["mould_volume_ml"] = json_number(kMillilitres * profile.mould_volume.value_or(std::nan("")));
  json["volume_limit"] = json_number(profile.volume_limit);
  return json;
}

void write_curves(OutputDirectory& output, const ProfileRun& profile) {
  using Column = std::vector<double>;
  std::vector<mpm::Outline> outlines;
  Column time, r, z, difference, left_r, left_z, right_r, right_z;
  Column times, height, toe, volume, error, asymmetry, lean;
  for (const TimedOutcome& picture : profile.pictures) {
    const auto& reading = picture.outcome.reading;
    if (!reading) continue;
    outlines.push_back(reading->outline);
    times.push_back(picture.time);
    height.push_back(kMillimetres * reading->outline.height());
    toe.push_back(kMillimetres * reading->outline.toe());
    volume.push_back(kMillilitres * reading->volume);
    error.push_back(volume_error(*reading));
    asymmetry.push_back(kMillimetres * reading->asymmetry);
    lean.push_back(kDegrees * reading->lean);
    for (const images::MeanPoint& point : reading->points) {
      time.push_back(picture.time);
      r.push_back(kMillimetres * point.place.x());
      z.push_back(kMillimetres * point.place.y());
      difference.push_back(kMillimetres * point.half_difference);
      left_r.push_back(kMillimetres * point.left.x());
      left_z.push_back(kMillimetres * point.left.y());
      right_r.push_back(kMillimetres * point.right.x());
      right_z.push_back(kMillimetres * point.right.y());
    }
  }
  write_outlines(output, "outlines.csv", outlines);
  output.write_csv("sides.csv", std::vector<CsvColumn>{{"time_s", time},
                                                       {"r_mm", r},
                                                       {"z_mm", z},
                                                       {"half_difference_mm", difference},
                                                       {"left_r_mm", left_r},
                                                       {"left_z_mm", left_z},
                                                       {"right_r_mm", right_r},
                                                       {"right_z_mm", right_z}});
  output.write_csv("history.csv", std::vector<CsvColumn>{{"time_s", times},
                                                         {"height_mm", height},
                                                         {"toe_mm", toe},
                                                         {"volume_ml", volume},
                                                         {"volume_error", error},
                                                         {"asymmetry_mm", asymmetry},
                                                         {"lean_deg", lean}});
}

}  // namespace isotach::reports
