// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A whole text file in memory, refused where it is too large, empty, binary or no file at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isotach::datasets {

/// What a reader of user files may be told.
struct ReadOptions {
  std::uintmax_t max_bytes = 100'000'000;  ///< largest file accepted
};

/// The bytes of `file`, without a UTF-8 byte order mark.
/// InputError: missing, a directory, unreadable, larger than `options.max_bytes`, empty, or holding a NUL
/// byte (binary data, or text in UTF-16).
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file, const ReadOptions& options);

}  // namespace isotach::datasets
