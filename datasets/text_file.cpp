// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A whole text file in memory: implementation.
#include "datasets/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "datasets/input_error.hpp"

namespace isotach::datasets {
namespace {

/// Reads at most `limit` + 1 bytes: a special file has no size to ask for, and may have no end.
std::string read_up_to(const std::filesystem::path& file, std::uintmax_t limit) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw InputError({file}, "file", fmt::format("it cannot be opened ({})", std::strerror(errno)),
                     "a readable text file");
  }
  std::string text;
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  while (stream && text.size() <= limit) {
    const std::size_t begin = text.size();
    const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(kBlock, limit + 1 - begin));
    text.resize(begin + wanted);
    stream.read(text.data() + begin, static_cast<std::streamsize>(wanted));
    text.resize(begin + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw InputError({file}, "file", "it cannot be read to its end", "a readable text file");
  return text;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, const ReadOptions& options) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError({file}, "file", "it does not exist", "a text file");
  }
  if (std::filesystem::is_directory(status)) {
    throw InputError({file}, "file", "it is a directory", "a text file");
  }
  const std::uintmax_t limit = std::min<std::uintmax_t>(options.max_bytes, std::string().max_size() - 1);
  // Asked before anything is read, so that a file beyond the limit costs neither time nor memory.
  std::uintmax_t size = 0;
  if (std::filesystem::is_regular_file(status)) size = std::filesystem::file_size(file, error);
  if (error) size = 0;  // what keeps the size from being known is said when the file is opened
  std::string text;
  if (size <= limit) text = read_up_to(file, limit);
  size = std::max<std::uintmax_t>(size, text.size());
  if (size > limit) {
    throw InputError({file}, "file size", fmt::format("{} bytes", size),
                     fmt::format("at most {} bytes unless the size limit is raised", limit));
  }
  return checked_text(std::move(text), file);
}

std::string checked_text(std::string text, const std::filesystem::path& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.empty()) throw InputError({file}, "file", "it is empty", "a text file");
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
    throw InputError({file, static_cast<std::size_t>(line)}, "text", "a NUL byte",
                     "plain text, UTF-8 or ASCII (not UTF-16, not binary)");
  }
  return text;
}

}  // namespace isotach::datasets
