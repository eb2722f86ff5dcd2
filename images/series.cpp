// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "images/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "datasets/input_error.hpp"

namespace isotach::images {
namespace {

constexpr int kPreviewColumns = 720;  // as wide as a report's page

TimedOutcome read_one(const std::filesystem::path& file, double time, const View& view, cv::Size size,
                      const SeriesOptions& options, std::mutex& one_at_a_time) {
  const Picture picture = read_picture(file, options.max_bytes);
  if (picture.codes.size() != size) {
    throw datasets::InputError(datasets::FilePlace{file}, "size of the picture",
                               fmt::format("{} by {} pixels", picture.codes.cols, picture.codes.rows),
                               fmt::format("{} by {}, as the first picture", size.width, size.height));
  }
  PictureOutcome outcome = read_profile(picture, view, options.profile);
  if (outcome.reading) outcome.reading->outline.time = time;
  if (options.overlay) {
    const EncodedPicture overlay = overlay_png(picture, outcome.marks);
    const std::lock_guard lock(one_at_a_time);
    options.overlay(file, overlay);
  }
  EncodedPicture preview = overlay_jpeg(picture, outcome.marks, kPreviewColumns);
  return {file, time, std::move(outcome), std::move(preview)};
}

}  // namespace

std::optional<std::vector<TimedOutcome>> read_series(const std::vector<std::filesystem::path>& files,
                                                     const std::vector<double>& times, const View& view,
                                                     cv::Size size, const SeriesOptions& options) {
  std::vector<std::size_t> order(files.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });

  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  std::vector<std::optional<TimedOutcome>> outcomes(files.size());
  std::exception_ptr error;
  std::size_t done = 0;
  std::mutex mutex;
  const auto task = [&](const cv::Range& range) {
    for (int k = range.start; k < range.end && !stopped(); ++k) {
      const std::size_t i = order[static_cast<std::size_t>(k)];
      try {
        outcomes[static_cast<std::size_t>(k)] = read_one(files[i], times[i], view, size, options, mutex);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        return;
      }
      const std::lock_guard lock(mutex);
      ++done;
      if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(files.size()));
    }
  };
  const int count = static_cast<int>(files.size());
  cv::setNumThreads(options.threads);
  cv::parallel_for_(cv::Range(0, count), task, count);
  if (error) std::rethrow_exception(error);
  if (stopped()) return {};
  std::vector<TimedOutcome> result;
  for (auto& outcome : outcomes) result.push_back(std::move(*outcome));
  return result;
}

}  // namespace isotach::images
