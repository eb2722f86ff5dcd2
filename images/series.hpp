// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// All pictures of one slump.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "images/overlay.hpp"
#include "images/profile.hpp"

namespace isotach::images {

/// A picture and what came of it.
struct TimedOutcome {
  std::filesystem::path file;
  double time;  ///< s since the mould began to rise
  PictureOutcome outcome;
  EncodedPicture preview;  ///< the overlay, small, as a JPEG file
};

struct SeriesOptions {
  ProfileOptions profile{};
  int threads = 1;
  std::uintmax_t max_bytes = 100'000'000;        ///< of a file
  const std::atomic<bool>* stop = nullptr;       ///< set: end as soon as may be
  std::function<void(double share)> progress{};  ///< one call at a time
  /// Takes the overlay in full size; one call at a time.
  std::function<void(const std::filesystem::path& file, const EncodedPicture& png)> overlay{};
};

/// Reads each picture, several at once; by increasing time. `times` are those of `files`; all pictures have
/// the size for which `view` was made. Empty where it was stopped. InputError: what read_picture and
/// looked_area refuse, a picture of another size.
[[nodiscard]] std::optional<std::vector<TimedOutcome>> read_series(
    const std::vector<std::filesystem::path>& files, const std::vector<double>& times, const View& view,
    cv::Size size, const SeriesOptions& options);

}  // namespace isotach::images
