// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An SQLite database and its statements as objects that close themselves and report errors as exceptions.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace isotach::journal {

/// What SQLite refused; what() is its own words.
class SqliteError : public std::runtime_error {
 public:
  SqliteError(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// SQLITE_BUSY, SQLITE_CORRUPT, ...
  [[nodiscard]] int code() const { return code_; }

 private:
  int code_;
};

class Statement;

/// One connection.
class Database {
 public:
  /// `flags` are those of sqlite3_open_v2. A lock of another process is waited for up to `busy_timeout` (s).
  Database(const std::filesystem::path& file, int flags, double busy_timeout);

  void execute(const char* sql);
  /// The first column of the first row.
  [[nodiscard]] std::string text(const char* sql);
  [[nodiscard]] long integer(const char* sql);
  [[nodiscard]] bool write_protected() const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* connection) const { sqlite3_close(connection); }
  };
  std::unique_ptr<sqlite3, Close> connection_;
};

/// One prepared statement. Parameters are bound in the order of their marks; columns count from 0.
class Statement {
 public:
  Statement(Database& database, const char* sql);

  Statement& bind(std::string_view text);
  Statement& bind(double number);
  Statement& bind_blob(std::string_view bytes);
  Statement& bind_null();

  /// Goes on to the next row; false where there is none.
  [[nodiscard]] bool step();

  [[nodiscard]] std::string text(int column) const;
  /// Likewise of a blob.
  [[nodiscard]] std::string bytes(int column) const;
  [[nodiscard]] double number(int column) const;
  [[nodiscard]] long integer(int column) const;
  [[nodiscard]] bool is_null(int column) const;

 private:
  void check(int code) const;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  sqlite3* connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int bound_ = 0;
};

}  // namespace isotach::journal
