// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A whole text file in memory, refused where it is too large, empty, binary or no file at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
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

/// `text` without a UTF-8 byte order mark, as read_text_file returns it; `file` is only named in messages.
/// InputError: empty, or holding a NUL byte.
[[nodiscard]] std::string checked_text(std::string text, const std::filesystem::path& file);

/// How a reader gets the text of the files that its own file names. It throws InputError.
using ReadText = std::function<std::string(const std::filesystem::path&)>;

}  // namespace isotach::datasets
