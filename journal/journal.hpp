// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The journal of slump simulations: one SQLite file that is cache, restart file and training set.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "journal/evaluation.hpp"
#include "journal/sqlite.hpp"

namespace isotach::journal {

/// A journal that cannot be read or written any more; the message names the file and the reason.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How SQLite makes a transaction whole (its journal_mode). A file keeps the mode that it was made with.
enum class JournalMode {
  rollback,  ///< DELETE: one file at rest; wherever POSIX locks work
  wal        ///< readers do not wait for a writer; all processes on one machine, not on a network file system
};

/// What has reached the disk when put() returns (SQLite's synchronous). No setting loses anything when a
/// process is killed.
enum class Synchronous {
  off,     ///< a power failure may damage the file
  normal,  ///< a power failure may lose the last rows, with rollback on some file systems more
  full     ///< nothing is lost
};

struct JournalOptions {
  JournalMode mode = JournalMode::rollback;  ///< of a new file
  Synchronous synchronous = Synchronous::full;
  double busy_timeout = 60.0;  ///< s to wait for another process that holds the file's lock, >= 0
};

/// An open journal. All members may be called from any thread; any number of processes of one machine may
/// have the file open. A row is there whole or not at all, whenever a process is killed.
class Journal {
 public:
  static constexpr int kSchemaVersion = 1;

  /// Opens the file, or makes it where there is none (its folder must exist). datasets::InputError with the
  /// file's name where it is no journal, one of another schema, damaged, or write-protected; the file then
  /// stays as it is.
  explicit Journal(std::filesystem::path file, const JournalOptions& options = {});

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// The evaluation with that key.
  [[nodiscard]] std::optional<Evaluation> get(const std::string& key) const;

  /// Adds a row. Where the key is there already, the row stays what it is, unless it was timed out: then the
  /// new one takes its place. std::invalid_argument where the evaluation was interrupted, which says nothing.
  void put(const Evaluation& evaluation);

  /// Rows by status of the tests with these Inputs::setup_key.
  [[nodiscard]] mpm::RunCounts counts(const std::vector<std::string>& setup_keys) const;
  /// The same of all rows.
  [[nodiscard]] mpm::RunCounts counts() const;

  /// Calls visit for each row with this setup_key in the order in which they were added, as a training set
  /// wants them. It must not call the journal.
  void for_each(const std::string& setup_key, const std::function<void(const Evaluation&)>& visit) const;

 private:
  template <class Work>
  auto guarded(const char* what, Work&& work) const;

  std::filesystem::path file_;
  mutable std::mutex mutex_;
  mutable Database database_;
};

}  // namespace isotach::journal
