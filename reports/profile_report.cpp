// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/profile_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "images/apparent_contour.hpp"
#include "reports/base64.hpp"
#include "reports/fit_sections.hpp"
#include "reports/number.hpp"
#include "reports/slump_tables.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using images::Reading;
using images::TimedOutcome;

constexpr double kMillilitres = 1e6;  // in a cubic metre
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kTimesShown = 7;      // as many as the palette has colours
constexpr std::size_t kOverlaysShown = 12;  // of pictures that were read
constexpr std::size_t kRefusedShown = 6;
constexpr double kRadiusError = 0.5e-3;  // m, that parallel lines of sight are held to

std::vector<const TimedOutcome*> read_ones(const ProfileRun& profile, bool read) {
  std::vector<const TimedOutcome*> chosen;
  for (const TimedOutcome& picture : profile.pictures) {
    if (picture.outcome.reading.has_value() == read) chosen.push_back(&picture);
  }
  return chosen;
}

std::string name_of(const TimedOutcome& picture) {
  return picture.file.filename().string();
}

double volume_error_percent(const Reading& reading) {
  return reading.volume_error ? 100.0 * *reading.volume_error : std::nan("");
}

Table picture_table(const ProfileRun& profile) {
  using enum Alignment;
  Table table{.caption = "Pictures.",
              .header = {"Picture", "Time (s)", "Height (mm)", "Toe (mm)", "Volume (ml)", "Volume error (%)",
                         "Left-right (mm)", "Lean (°)", "Base tilt (°)"},
              .alignment = {left, right, right, right, right, right, right, right, right}};
  for (const TimedOutcome& picture : profile.pictures) {
    std::vector<std::string> row{name_of(picture), format_number(picture.time)};
    if (const auto& reading = picture.outcome.reading) {
      row.push_back(format_number(kMillimetres * reading->outline.height()));
      row.push_back(format_number(kMillimetres * reading->outline.toe()));
      row.push_back(format_number(kMillilitres * reading->volume));
      row.push_back(format_number(volume_error_percent(*reading), 2));
      row.push_back(format_number(kMillimetres * reading->asymmetry, 2));
      row.push_back(format_number(kDegrees * reading->lean, 2));
      row.push_back(format_number(kDegrees * reading->base_tilt, 2));
    } else {
      row.emplace_back("refused");
      row.resize(table.header.size(), kMissing);
    }
    table.rows.push_back(std::move(row));
  }
  table.notes = {
      "Height: highest point of the mean of left and right; toe: its largest radius; volume: of its body of "
      "revolution. Left-right: half the distance of both sides, root mean square along the outline, which is "
      "the "
      "uncertainty of the mean. Lean: of the body to the right. Base tilt: of the base line in the picture, "
      "down to "
      "the right; it is taken out."};
  return table;
}

Drawing overlay(const TimedOutcome& picture) {
  const images::EncodedPicture& preview = picture.preview;
  return {fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"100%\" "
                      "role=\"img\"><image width=\"{0}\" height=\"{1}\" "
                      "href=\"data:image/jpeg;base64,{2}\"/></svg>",
                      preview.width, preview.height, base64(preview.bytes)),
          picture.outcome.reading
              ? fmt::format("{}, {}.", name_of(picture), time_label(picture.time))
              : fmt::format("{}, refused: {}.", name_of(picture), picture.outcome.reading.error().message)};
}

void add_overlays(Page& page, const ProfileRun& profile) {
  page.section("Pictures with what was found in them");
  page.paragraph(
      "Edge: orange on the left and blue on the right of the axis, which is white. Base line: green; a "
      "magenta line "
      "above it is the far edge of the base, below which the edge is extrapolated. In full size: the folder "
      "overlays.");
  const auto read = read_ones(profile, true);
  for (const std::size_t k : spread_indices(read.size(), kOverlaysShown)) page.drawing(overlay(*read[k]));
  const auto refused = read_ones(profile, false);
  for (const std::size_t k : spread_indices(refused.size(), kRefusedShown))
    page.drawing(overlay(*refused[k]));
}

Figure outlines_figure(const std::vector<const TimedOutcome*>& read) {
  Figure figure = meridian_figure();
  figure.caption = "Outlines, the mean of left (dashed) and right (dotted).";
  std::size_t colour = 0;
  for (const std::size_t k : spread_indices(read.size(), kTimesShown)) {
    const Reading& reading = *read[k]->outcome.reading;
    const Rgb shade = palette_colour(colour++);
    Series mean = outline_series(reading.outline, time_label(read[k]->time));
    mean.colour = shade;
    figure.series.push_back(std::move(mean));
    Series left{.style = SeriesStyle::thin_dashed, .colour = shade, .in_legend = false};
    Series right{.style = SeriesStyle::dotted, .colour = shade, .in_legend = false};
    for (const images::MeanPoint& point : reading.points) {
      left.x.push_back(kMillimetres * point.left.x());
      left.y.push_back(kMillimetres * point.left.y());
      right.x.push_back(kMillimetres * point.right.x());
      right.y.push_back(kMillimetres * point.right.y());
    }
    figure.series.push_back(std::move(left));
    figure.series.push_back(std::move(right));
  }
  return figure;
}

/// What a finite distance of the camera does, or would do.
void add_perspective(Page& page, const ProfileRun& profile, const std::vector<const TimedOutcome*>& read) {
  if (profile.camera_distance || read.empty()) return;
  double toe = 0.0;
  for (const TimedOutcome* picture : read) toe = std::max(toe, picture->outcome.reading->outline.toe());
  page.verdict(
      Tone::plain,
      fmt::format("Lines of sight were taken to be parallel: from a camera nearer than {} m the radius is "
                  "read more than {} mm too large, and a flat top above or below the camera too high. Give "
                  "--camera-distance-mm to have this put right.",
                  format_number(images::distance_for(toe, kRadiusError), 2),
                  format_number(kMillimetres * kRadiusError, 1)));
}

void add_summary(Page& page, const ProfileRun& profile) {
  const auto read = read_ones(profile, true);
  const std::size_t total = profile.pictures.size();
  page.verdict(read.size() == total ? Tone::good : Tone::warning,
               fmt::format("{} of {} pictures gave an outline.", read.size(), total));
  for (const std::string& line : refusals(profile)) page.verdict(Tone::bad, line);
  if (profile.mould_volume && !read.empty()) {
    double largest = 0.0;
    for (const TimedOutcome* picture : read) {
      largest = std::max(largest, std::abs(*picture->outcome.reading->volume_error));
    }
    page.verdict(
        Tone::good,
        fmt::format(
            "Volumes of revolution agree with the {} ml filled in to within {} % (refused beyond {} %).",
            format_number(kMillilitres * *profile.mould_volume), format_number(100.0 * largest, 2),
            format_number(100.0 * profile.volume_limit, 2)));
  } else if (!profile.mould_volume) {
    page.verdict(
        Tone::warning,
        "Volumes were not checked: give --mould-volume-ml, or --mould-diameter-mm and --fill-height-mm.");
  }
  add_perspective(page, profile, read);
  for (const auto& [name, words] : profile.settings) page.fact(name, words);
}

}  // namespace

std::vector<std::string> refusals(const ProfileRun& profile) {
  std::vector<std::string> lines;
  for (const TimedOutcome* picture : read_ones(profile, false)) {
    lines.push_back(
        fmt::format("{} was refused: {}", name_of(*picture), picture->outcome.reading.error().message));
  }
  return lines;
}

Page profile_report(const RunInfo& run, const ProfileRun& profile) {
  Page page("Outlines from pictures", subtitle(run));
  add_summary(page, profile);
  std::vector<std::string> warnings = run.warnings;
  for (const TimedOutcome* picture : read_ones(profile, true)) {
    for (const std::string& warning : picture->outcome.reading->warnings) {
      warnings.push_back(fmt::format("{}: {}", name_of(*picture), warning));
    }
  }
  add_warnings(page, warnings);
  page.table(picture_table(profile));
  add_overlays(page, profile);
  page.section("Outlines");
  page.figure(outlines_figure(read_ones(profile, true)));
  return page;
}

}  // namespace isotach::reports
