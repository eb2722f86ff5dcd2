// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// isotach profile: outlines of a slump from photographs or the frames of a video.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/interrupt.hpp"
#include "app/profile_view.hpp"
#include "datasets/input_error.hpp"
#include "images/series.hpp"
#include "images/time_stamp.hpp"
#include "reports/file_stems.hpp"
#include "reports/profile_report.hpp"
#include "reports/terminal_progress.hpp"

namespace isotach::app {

namespace {

using datasets::FilePlace;
using datasets::InputError;

/// Options of this command alone, as typed.
struct PictureOptions {
  std::vector<std::filesystem::path> pictures{};
  ViewOptions view{};
  std::optional<double> base_row{};
  std::optional<double> axis_column{};
  std::string region{};
  std::vector<std::string> ignored{};
  images::TimeRule time{};
  std::optional<double> start_s{};
  std::optional<double> start_frame{};
  std::optional<double> mould_volume_ml{};
  std::optional<double> fill_height_mm{};
  double volume_limit_percent = 5.0;
  double spacing_mm = 1.0;
};

images::PixelArea area_of(const char* option, const std::string& text) {
  const std::vector<double> numbers = numbers_of(option, text, 4);
  const auto whole = [&](double number) {
    if (std::abs(number) < 1e6 && number == std::floor(number)) return static_cast<int>(number);
    throw InputError(FilePlace{"command line"}, option, fmt::format("{}", number), "whole pixels");
  };
  return {whole(numbers[0]), whole(numbers[1]), whole(numbers[2]), whole(numbers[3])};
}

images::Looked looked_of(const PictureOptions& options) {
  images::Looked looked;
  if (!options.region.empty()) looked.region = area_of("--region", options.region);
  for (const std::string& text : options.ignored) looked.ignored.push_back(area_of("--ignore", text));
  return looked;
}

/// A row or a column is one of the picture's `count`.
void require_inside(const char* option, const std::optional<double>& place, int count) {
  if (!place || (*place >= 0.0 && *place <= count - 1.0)) return;
  throw InputError(FilePlace{"command line"}, option, fmt::format("{}", *place),
                   fmt::format("0 to {}, within the picture", count - 1));
}

images::TimeRule time_rule_of(const PictureOptions& options) {
  images::TimeRule rule = options.time;
  const bool frames = rule.frames_per_second.has_value();
  if (frames && options.start_s) {
    throw InputError(FilePlace{"command line"}, "--start-s", "given with --frames-per-second",
                     "--start-frame");
  }
  if (!frames && options.start_frame) {
    throw InputError(FilePlace{"command line"}, "--start-frame", "given without --frames-per-second",
                     "--start-s");
  }
  rule.start = frames ? options.start_frame.value_or(0.0) : options.start_s.value_or(0.0);
  return rule;
}

/// Of the mud that was filled in (m3).
std::optional<double> mould_volume_of(const PictureOptions& options) {
  if (options.mould_volume_ml && options.fill_height_mm) {
    throw InputError(FilePlace{"command line"}, "--fill-height-mm", "given with --mould-volume-ml",
                     "one of them");
  }
  if (options.mould_volume_ml) return 1e-6 * *options.mould_volume_ml;
  if (!options.fill_height_mm) return {};
  if (!options.view.mould_diameter_mm) {
    throw InputError(FilePlace{"command line"}, "--mould-diameter-mm", "not given",
                     "--fill-height-mm needs it");
  }
  const double radius = 0.5e-3 * *options.view.mould_diameter_mm;
  return std::numbers::pi * radius * radius * 1e-3 * *options.fill_height_mm;
}

std::string time_words(const images::TimeRule& rule) {
  if (rule.frames_per_second) {
    return fmt::format("number of the frame less {:g}, {:g} frames a second", rule.start,
                       *rule.frames_per_second);
  }
  return fmt::format("seconds in the file's name less {:g}", rule.start);
}

std::string base_words(const PictureOptions& options, const images::View& view) {
  if (options.base_row) return fmt::format("row {:g}, as given", *options.base_row);
  if (view.base_known()) return "by the view";
  return "where the background ends beside the mud, or the mud's lower edge, in each picture";
}

/// All pictures refused leaves nothing to publish: the reasons, as an error of input.
void require_an_outline(const reports::ProfileRun& run) {
  const std::vector<std::string> refused = reports::refusals(run);
  if (refused.size() < run.pictures.size()) return;
  const auto& first = run.pictures.front();
  throw InputError(
      FilePlace{first.file},
      fmt::format("refused: {}{}", first.outcome.reading.error().message,
                  refused.size() > 1 ? fmt::format(" (and {} more)", refused.size() - 1) : std::string()));
}

int profile(const CommonOptions& common, const PictureOptions& options) {
  const Run run("profile", options.pictures.front());
  const std::uintmax_t max_bytes = common.read_options().max_bytes;
  const images::TimeRule rule = time_rule_of(options);
  const std::vector<double> times = images::time_stamps(options.pictures, rule);
  images::SeriesOptions series;
  series.profile.looked = looked_of(options);
  const images::Picture first = images::read_picture(options.pictures.front(), max_bytes);
  (void)images::looked_area(first, series.profile.looked);
  require_inside("--base-row", options.base_row, first.codes.rows);
  require_inside("--axis-column", options.axis_column, first.codes.cols);
  const auto [view, view_words] = view_of(options.view, first.codes.size(), series.profile.looked, max_bytes);
  series.profile.base_row = options.base_row;
  series.profile.axis_column = options.axis_column;
  series.profile.mould_volume = mould_volume_of(options);
  series.profile.volume_limit = 0.01 * options.volume_limit_percent;
  series.profile.spacing = 1e-3 * options.spacing_mm;
  series.threads = common.threads;
  series.max_bytes = max_bytes;
  series.stop = &interrupted();

  reports::OutputDirectory output(common.out);
  reports::Progress progress("profile", common.quiet);
  series.progress = [&](double share) { progress.update(share, "pictures"); };
  // names follow the order of the command line, whichever picture is done first
  std::vector<std::pair<std::filesystem::path, std::string>> overlay_names;
  reports::FileStems stems;
  for (const auto& file : options.pictures) {
    overlay_names.emplace_back(file, fmt::format("overlays/{}.png", stems.of(file.stem().string())));
  }
  series.overlay = [&](const std::filesystem::path& file, const images::EncodedPicture& png) {
    const auto named = std::find_if(overlay_names.begin(), overlay_names.end(),
                                    [&](const auto& entry) { return entry.first == file; });
    output.write_text(named->second,
                      std::string_view(reinterpret_cast<const char*>(png.bytes.data()), png.bytes.size()));
  };

  auto pictures = images::read_series(options.pictures, times, view, first.codes.size(), series);
  if (!pictures) return end_failed(output, {}, "interrupted", true);
  progress.finish();
  reports::ProfileRun result{
      std::move(*pictures), {}, {}, series.profile.mould_volume, series.profile.volume_limit};
  require_an_outline(result);
  result.settings = {
      {"Scale", view_words}, {"Base line", base_words(options, view)}, {"Times", time_words(rule)}};
  if (options.view.camera_distance_mm) {
    result.camera_distance = 1e-3 * *options.view.camera_distance_mm;
    result.settings.emplace_back("Camera",
                                 fmt::format("{:g} mm from the axis; what perspective adds is taken off",
                                             *options.view.camera_distance_mm));
  }
  for (const std::string& line : reports::refusals(result)) fmt::print(stderr, "isotach: {}\n", line);
  output.write_text("report.html", reports::profile_report(run.info(), result).html());
  reports::write_curves(output, result);
  output.write_json("result.json", reports::result_json(run.info(), result));
  return end_done(output, common.quiet);
}

}  // namespace

Runner profile_command(CLI::App& line, CommonOptions& common) {
  const auto options = std::make_shared<PictureOptions>();
  line.add_option("IMAGE", options->pictures,
                  "pictures of one slump by a camera that stands still (PNG, JPEG, TIFF)")
      ->required();
  add_view_options(line, options->view);
  const auto finding = [](CLI::Option* option) { return option->group("What is looked at"); };
  finding(line.add_option("--base-row", options->base_row, "row of the base line, in pixels from the top"));
  finding(line.add_option("--axis-column", options->axis_column,
                          "column where the axis stands on the base line"));
  finding(
      line.add_option("--region", options->region, "column,row,width,height: nothing outside is looked at"));
  finding(line.add_option("--ignore", options->ignored,
                          "column,row,width,height taken for background; may be repeated"))
      ->expected(1)
      ->take_all();
  const auto timing = [](CLI::Option* option) { return option->group("Times"); };
  timing(line.add_option(
      "--time-pattern", options->time.pattern,
      "regular expression whose first group is the time (or frame) in the file's name; by default a "
      "number before an s, or the last number with --frames-per-second"));
  timing(line.add_option("--frames-per-second", options->time.frames_per_second,
                         "file names hold numbers of frames"))
      ->check(number_between(1e-6, 1e6));
  timing(
      line.add_option("--start-s", options->start_s, "when the mould began to rise, in the names' seconds"))
      ->check(number_between(-1e9, 1e9));
  timing(line.add_option("--start-frame", options->start_frame, "the frame in which the mould began to rise"))
      ->check(number_between(-1e9, 1e9));
  const auto volume = [](CLI::Option* option) { return option->group("Volume check"); };
  volume(line.add_option("--mould-volume-ml", options->mould_volume_ml, "of the mud that was filled in"))
      ->check(number_between(1e-3, 1e9));
  volume(line.add_option("--fill-height-mm", options->fill_height_mm,
                         "of the mud in the mould of --mould-diameter-mm"))
      ->check(number_between(1e-3, 1e5));
  volume(line.add_option("--volume-limit-percent", options->volume_limit_percent,
                         "error of the volume beyond which a picture is refused"))
      ->check(number_between(0.01, 1000.0))
      ->capture_default_str();
  line.add_option("--spacing-mm", options->spacing_mm, "of the points of an outline, about")
      ->check(number_between(0.1, 10.0))
      ->capture_default_str();
  line.add_option("--max-file-mb", common.max_file_megabytes, "largest input file accepted, in MB")
      ->check(number_between(1e-6, 1e6))
      ->capture_default_str();
  return [&common, options] { return profile(common, *options); };
}

}  // namespace isotach::app
