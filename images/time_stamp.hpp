// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// When a picture was taken, by its file's name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isotach::images {

/// How file names say the time.
struct TimeRule {
  /// A regular expression (ECMAScript) that the name without its suffix must hold; its first group is the
  /// time in seconds, or with a frame rate the number of the frame. By default a number before an s that ends
  /// a word
  /// ("slump-5.2s", "t=15.2 s"), or with a frame rate the last whole number ("frame_0042").
  std::optional<std::string> pattern{};
  std::optional<double> frames_per_second{};
  double start = 0.0;  ///< when the mould began to rise: seconds, or the frame
};

/// Seconds since the mould began to rise, of each picture. InputError: a pattern that is no regular
/// expression or has no group, a name that does not hold it, what it holds not a number, a time that is not
/// positive, two pictures at one time.
[[nodiscard]] std::vector<double> time_stamps(const std::vector<std::filesystem::path>& files,
                                              const TimeRule& rule);

}  // namespace isotach::images
