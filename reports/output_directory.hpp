// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The folder a command writes its results to: all of them or none.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace isotach::reports {

/// Results cannot be written; the message names the path and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One column of a CSV file: numbers (written to round-trip; an empty cell where not finite) or text (quoted
/// where it must be).
struct CsvColumn {
  std::string header;
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

/// Results of a command, staged out of sight and published by commit().
///
/// The staging folder is hidden and on the file system of the destination, so that publishing is renaming: a
/// destination that does not exist yet appears whole; into one that does, each file is moved whole, replacing
/// a file of its name and leaving all others alone. Without commit() the destructor removes the staging
/// folder and every parent this object created.
///
/// Names are relative to the destination and may have sub-folders ("particles/frame_001.vtu"), which are
/// created. A name that is empty, absolute or leads out of the destination is a std::invalid_argument; any
/// use after commit() is a std::logic_error. What the file system refuses is an OutputError.
class OutputDirectory {
 public:
  /// Creates the missing parents and the staging folder, so that a destination that is a file or cannot be
  /// written is an OutputError here, before any work is done.
  explicit OutputDirectory(const std::filesystem::path& destination);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// The destination, absolute.
  [[nodiscard]] const std::filesystem::path& destination() const { return destination_; }
  /// Where to write the file of this name by other means before commit(); its folder exists.
  [[nodiscard]] std::filesystem::path staging_path(const std::filesystem::path& name);

  void write_text(const std::filesystem::path& name, std::string_view content);
  /// Indented JSON, keys in the order given; numbers that are not finite become null, bytes that are not
  /// UTF-8 the replacement character. Takes nlohmann::json too, whose keys are sorted.
  void write_json(const std::filesystem::path& name, const nlohmann::ordered_json& value);
  /// RFC 4180 with '\n' line ends and a header row. Columns of different lengths are a std::invalid_argument.
  void write_csv(const std::filesystem::path& name, std::span<const CsvColumn> columns);

  /// Publishes everything staged. Nothing is moved if a name is taken by a folder where a file must go, or
  /// the reverse.
  void commit();

 private:
  void merge_into_destination();

  std::filesystem::path destination_;
  std::filesystem::path staging_;                       // private to its owner, mode 0700
  std::filesystem::path content_;                       // in staging_, with the permissions users expect
  std::vector<std::filesystem::path> created_parents_;  // outermost first
  bool committed_ = false;
};

}  // namespace isotach::reports
