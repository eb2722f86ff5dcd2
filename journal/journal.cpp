// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "journal/journal.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <random>
#include <system_error>

#include "datasets/input_error.hpp"
#include "journal/result_text.hpp"

namespace isotach::journal {

namespace {

namespace fs = std::filesystem;

constexpr int kApplicationId = 0x49534f4a;  // "ISOJ", what file(1) and SQLite tell a journal by
constexpr const char* kAccepted = "an evaluation journal of isotach, or no file";

constexpr const char* kSchema = R"(
CREATE TABLE evaluation (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL UNIQUE,
  setup_key TEXT NOT NULL,
  test TEXT NOT NULL,
  parameters TEXT NOT NULL,
  setup TEXT NOT NULL,
  version TEXT NOT NULL,
  status TEXT NOT NULL
    CHECK (status IN ('ok', 'not settled', 'crashed', 'timed out', 'outside the domain')),
  message TEXT NOT NULL,
  seconds REAL NOT NULL,
  time_limit_s REAL NOT NULL,
  created TEXT NOT NULL,
  outlines BLOB,
  history BLOB,
  measures TEXT
) STRICT;
CREATE INDEX evaluation_of_setup ON evaluation (setup_key, id);
)";

constexpr const char* kColumns =
    "key, setup_key, test, parameters, setup, version, status, message, seconds, time_limit_s, created, "
    "outlines, history, measures";

[[noreturn]] void refuse(const fs::path& file, std::string_view found) {
  throw datasets::InputError(datasets::FilePlace{file}, "journal", found, kAccepted);
}

/// An empty journal under a name of its own, then given its name: it appears whole, and not where another
/// process was faster.
void create(const fs::path& file, JournalMode mode) {
  fs::path temporary = file;
  temporary += fmt::format(".new-{:08x}", std::random_device()());
  std::error_code error;
  try {
    Database database(temporary, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, 0.0);
    database.execute(fmt::format("PRAGMA journal_mode = {}; BEGIN; PRAGMA application_id = {}; "
                                 "PRAGMA user_version = {}; {} COMMIT;",
                                 mode == JournalMode::wal ? "WAL" : "DELETE", kApplicationId,
                                 Journal::kSchemaVersion, kSchema)
                         .c_str());
  } catch (const SqliteError& refused) {
    fs::remove(temporary, error);
    refuse(file, fmt::format("it cannot be made: {}", refused.what()));
  }
  fs::create_hard_link(temporary, file, error);
  // not every file system has hard links; between these two calls another process may be lost
  if (error && !fs::exists(file)) fs::rename(temporary, file, error);
  fs::remove(temporary, error);
}

Database open(const fs::path& file, const JournalOptions& options) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) create(file, options.mode);
  try {
    Database database(file, SQLITE_OPEN_READWRITE, options.busy_timeout);
    if (database.integer("PRAGMA application_id") != kApplicationId) {
      refuse(file, "it is empty or another program's");
    }
    const long version = database.integer("PRAGMA user_version");
    if (version != Journal::kSchemaVersion) {
      refuse(file,
             fmt::format("its schema is version {}, this program's is {}", version, Journal::kSchemaVersion));
    }
    const std::string fault = database.text("PRAGMA quick_check(1)");
    if (fault != "ok") refuse(file, fmt::format("it is damaged: {}", fault));
    if (database.write_protected()) refuse(file, "it is write-protected");
    constexpr const char* kLevels[] = {"OFF", "NORMAL", "FULL"};
    database.execute(
        fmt::format("PRAGMA synchronous = {}", kLevels[static_cast<int>(options.synchronous)]).c_str());
    return database;
  } catch (const SqliteError& refused) {
    refuse(file, fmt::format("it cannot be opened: {}", refused.what()));
  }
}

std::string now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now())));
}

std::optional<mpm::RunStatus> status_named(const std::string& name) {
  for (std::size_t i = 0; i < mpm::kRunStatusCount; ++i) {
    const auto status = static_cast<mpm::RunStatus>(i);
    if (name_of(status) == name) return status;
  }
  return std::nullopt;
}

/// The row that the statement stands on, its columns those of kColumns.
Evaluation read_row(const Statement& row) {
  Evaluation evaluation;
  Inputs& inputs = evaluation.inputs;
  int column = 0;
  for (std::string* text : {&inputs.key, &inputs.setup_key, &evaluation.test, &inputs.parameters,
                            &inputs.setup, &inputs.version}) {
    *text = row.text(column++);
  }
  const auto status = status_named(row.text(column++));
  if (!status) throw JournalError("a status that is none");
  evaluation.status = *status;
  evaluation.message = row.text(column++);
  evaluation.seconds = row.number(column++);
  evaluation.time_limit = row.number(column++);
  evaluation.created = row.text(column++);
  if (!row.is_null(column)) {
    evaluation.result = result_of({row.bytes(column), row.bytes(column + 1), row.text(column + 2)});
    if (!evaluation.result) throw JournalError("a result that is not whole");
  }
  return evaluation;
}

void add_counts(Statement& rows, mpm::RunCounts& counts) {
  while (rows.step()) {
    if (const auto status = status_named(rows.text(0))) counts[*status] += rows.integer(1);
  }
}

}  // namespace

Journal::Journal(fs::path file, const JournalOptions& options)
    : file_(std::move(file)), database_(open(file_, options)) {}

/// work() alone with the database, its errors with the file's name.
template <class Work>
auto Journal::guarded(const char* what, Work&& work) const {
  const std::lock_guard lock(mutex_);
  try {
    return work();
  } catch (const SqliteError& error) {
    throw JournalError(fmt::format("{}: cannot {} the journal: {}", file_.string(), what, error.what()));
  } catch (const JournalError& error) {
    throw JournalError(fmt::format("{}: cannot {} the journal: {}", file_.string(), what, error.what()));
  }
}

std::optional<Evaluation> Journal::get(const std::string& key) const {
  return guarded("read", [&]() -> std::optional<Evaluation> {
    Statement row(database_, fmt::format("SELECT {} FROM evaluation WHERE key = ?", kColumns).c_str());
    row.bind(key);
    if (!row.step()) return std::nullopt;
    return read_row(row);
  });
}

void Journal::put(const Evaluation& evaluation) {
  if (evaluation.status == mpm::RunStatus::interrupted) {
    throw std::invalid_argument("an interrupted simulation is not for the journal");
  }
  guarded("write", [&] {
    Statement row(database_, fmt::format("INSERT INTO evaluation ({}) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?) "
                                         "ON CONFLICT (key) DO UPDATE SET status = excluded.status, "
                                         "message = excluded.message, seconds = excluded.seconds, "
                                         "time_limit_s = excluded.time_limit_s, created = excluded.created, "
                                         "outlines = excluded.outlines, history = excluded.history, "
                                         "measures = excluded.measures WHERE evaluation.status = 'timed out'",
                                         kColumns)
                                 .c_str());
    const Inputs& inputs = evaluation.inputs;
    for (const std::string* text : {&inputs.key, &inputs.setup_key, &evaluation.test, &inputs.parameters,
                                    &inputs.setup, &inputs.version}) {
      row.bind(*text);
    }
    row.bind(name_of(evaluation.status)).bind(evaluation.message);
    row.bind(evaluation.seconds).bind(evaluation.time_limit).bind(now());
    if (evaluation.result) {
      const ResultColumns columns = columns_of(*evaluation.result);
      row.bind_blob(columns.outlines).bind_blob(columns.history).bind(columns.measures);
    } else {
      row.bind_null().bind_null().bind_null();
    }
    static_cast<void>(row.step());
  });
}

mpm::RunCounts Journal::counts(const std::vector<std::string>& setup_keys) const {
  return guarded("read", [&] {
    mpm::RunCounts counts;
    for (const std::string& setup_key : setup_keys) {
      Statement rows(database_,
                     "SELECT status, COUNT(*) FROM evaluation WHERE setup_key = ? GROUP BY status");
      rows.bind(setup_key);
      add_counts(rows, counts);
    }
    return counts;
  });
}

mpm::RunCounts Journal::counts() const {
  return guarded("read", [&] {
    mpm::RunCounts counts;
    Statement rows(database_, "SELECT status, COUNT(*) FROM evaluation GROUP BY status");
    add_counts(rows, counts);
    return counts;
  });
}

void Journal::for_each(const std::string& setup_key,
                       const std::function<void(const Evaluation&)>& visit) const {
  guarded("read", [&] {
    Statement rows(
        database_,
        fmt::format("SELECT {} FROM evaluation WHERE setup_key = ? ORDER BY id", kColumns).c_str());
    rows.bind(setup_key);
    while (rows.step()) visit(read_row(rows));
  });
}

}  // namespace isotach::journal
