// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Checked access to the tables of a TOML file: every key is asked for with what it accepts, and none is left
// over.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/input_error.hpp"
#include "datasets/range.hpp"
#include "datasets/text_file.hpp"

namespace isotach::datasets {

/// A view of one table that remembers which keys it was asked for.
///
/// Every getter throws an InputError naming file, line, key, value and what is accepted; the `_if` getters
/// return nothing where the key is absent, the others throw. Reading ends with reject_unknown_keys().
class TomlTable {
 public:
  [[nodiscard]] bool has(std::string_view key);
  /// Whether the key holds a string, or a table.
  [[nodiscard]] bool is_text(std::string_view key);
  [[nodiscard]] bool is_table(std::string_view key);

  [[nodiscard]] double number(std::string_view key, const Range& accepted);
  [[nodiscard]] std::optional<double> number_if(std::string_view key, const Range& accepted);
  [[nodiscard]] std::optional<bool> boolean_if(std::string_view key);
  /// A whole number; `accepted` lies within those of int.
  [[nodiscard]] std::optional<int> integer_if(std::string_view key, const Range& accepted);
  /// A string that is not empty.
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] std::optional<std::string> text_if(std::string_view key);
  /// A string, or a number as the shortest text that reads back as it.
  [[nodiscard]] std::optional<std::string> text_or_number_if(std::string_view key);
  /// The index in `accepted` of the key's string.
  [[nodiscard]] std::optional<std::size_t> choice_if(std::string_view key,
                                                     std::span<const std::string_view> accepted);
  /// `shape` says what is accepted where the value is not a list of numbers within `accepted`.
  [[nodiscard]] std::optional<std::vector<double>> numbers_if(std::string_view key, const Range& accepted,
                                                              std::string_view shape);
  [[nodiscard]] std::optional<std::vector<std::string>> texts_if(std::string_view key,
                                                                 std::string_view shape);

  [[nodiscard]] TomlTable table(std::string_view key);
  [[nodiscard]] std::optional<TomlTable> table_if(std::string_view key);
  /// The tables of [[key]], in the file's order; none where it is absent.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key);
  /// All keys, sorted: of a table whose keys are names that the user gives.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Whether the table holds nothing.
  [[nodiscard]] bool empty() const { return table_->empty(); }

  /// InputError at the first key that no getter has asked for, listing those that were.
  void reject_unknown_keys() const;

  /// An error at the key's line (at the table's, where the key is absent): `found` and what is accepted.
  [[nodiscard]] InputError error(std::string_view key, std::string_view found,
                                 std::string_view accepted) const;
  /// Where the table stands.
  [[nodiscard]] FilePlace place() const;
  [[nodiscard]] const std::filesystem::path& file() const { return *file_; }

 private:
  friend class TomlDocument;
  TomlTable(const toml::table& table, const std::filesystem::path& file, std::string path,
            bool in_array = false)
      : table_(&table), file_(&file), path_(std::move(path)), in_array_(in_array) {}

  [[nodiscard]] const toml::node* find(std::string_view key);
  [[nodiscard]] const toml::node& require(std::string_view key, std::string_view accepted);
  [[nodiscard]] double number_of(const toml::node& node, std::string_view key, const Range& accepted) const;
  [[nodiscard]] std::string child_path(std::string_view key) const;
  [[nodiscard]] std::string subject(std::string_view key) const;

  const toml::table* table_;           // of the document
  const std::filesystem::path* file_;  // of the document
  std::string path_;                   // dotted, empty for the root
  bool in_array_;
  std::vector<std::string> asked_;
};

/// A parsed TOML file. It owns what its tables look at, so it must outlive them.
class TomlDocument {
 public:
  /// InputError: whatever read_text_file refuses, a syntax error (with its line), a file without any key.
  [[nodiscard]] static TomlDocument read(const std::filesystem::path& file, const ReadOptions& options);

  /// The same of a text in memory; `file` is only named in messages.
  [[nodiscard]] static TomlDocument parse(std::string text, const std::filesystem::path& file);

  [[nodiscard]] TomlTable root() const { return {content_->root, content_->file, ""}; }

 private:
  struct Content {
    std::filesystem::path file;
    toml::table root;
  };
  explicit TomlDocument(std::unique_ptr<const Content> content) : content_(std::move(content)) {}

  std::unique_ptr<const Content> content_;
};

}  // namespace isotach::datasets
