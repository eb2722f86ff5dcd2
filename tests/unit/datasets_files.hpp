// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Helpers of the datasets tests: files in a folder of their own, and the message of the error that reading
// one gives.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "datasets/input_error.hpp"

namespace isotach::datasets {

/// A folder that lives as long as the test that made it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "isotach-datasets-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(std::string_view name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Expects an InputError whose message holds every one of `parts`.
inline void expect_input_error(const std::function<void()>& read,
                               std::initializer_list<std::string_view> parts) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    for (const std::string_view part : parts) {
      EXPECT_NE(message.find(part), std::string_view::npos) << "\"" << part << "\" is not in: " << message;
    }
    return;
  }
  ADD_FAILURE() << "no error was thrown";
}

/// Replaces the one place where `from` stands in `text`.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "\"" << from << "\" is not in the text";
    return text;
  }
  return text.replace(at, from.size(), to);
}

inline std::filesystem::path bundled(std::string_view name) {
  return std::filesystem::path(ISOTACH_SOURCE_DIR) / "datasets" / name;
}

}  // namespace isotach::datasets
