// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Checked access to the tables of a TOML file: implementation.
#include "datasets/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "datasets/toml_precheck.hpp"

namespace isotach::datasets {
namespace {

FilePlace place_of(const std::filesystem::path& file, const toml::source_region& source) {
  return {file, static_cast<std::size_t>(source.begin.line)};
}

/// The value as a message shows it.
std::string describe(const toml::node& node) {
  if (const auto* text = node.as_string()) return fmt::format("\"{}\"", text->get());
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* boolean = node.as_boolean()) return fmt::format("{}", boolean->get());
  if (node.is_table()) return "a table";
  if (node.is_array()) return "a list";
  return "a date or time";
}

}  // namespace

const toml::node* TomlTable::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return table_->get(key);
}

bool TomlTable::has(std::string_view key) {
  return find(key) != nullptr;
}

bool TomlTable::is_text(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_string();
}

bool TomlTable::is_table(std::string_view key) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_table();
}

FilePlace TomlTable::place() const {
  return place_of(*file_, table_->source());
}

std::string TomlTable::child_path(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

std::string TomlTable::subject(std::string_view key) const {
  if (path_.empty()) return fmt::format("key {}", key);
  return fmt::format("key {} in {}{}{}", key, in_array_ ? "[[" : "[", path_, in_array_ ? "]]" : "]");
}

InputError TomlTable::error(std::string_view key, std::string_view found, std::string_view accepted) const {
  const toml::node* node = table_->get(key);
  return {node == nullptr ? place() : place_of(*file_, node->source()), subject(key), found, accepted};
}

const toml::node& TomlTable::require(std::string_view key, std::string_view accepted) {
  if (const toml::node* node = find(key)) return *node;
  throw error(key, "it is missing", accepted);
}

double TomlTable::number_of(const toml::node& node, std::string_view key, const Range& accepted) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  const auto refuse = [&](std::string_view why) {
    return InputError(place_of(*file_, node.source()), subject(key),
                      fmt::format("{} {}", describe(node), why), accepted.words());
  };
  if (!value) throw refuse("is not a number");
  if (!accepted.contains(*value)) throw refuse("is out of range");
  return *value;
}

double TomlTable::number(std::string_view key, const Range& accepted) {
  return number_of(require(key, accepted.words()), key, accepted);
}

std::optional<double> TomlTable::number_if(std::string_view key, const Range& accepted) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return number_of(*node, key, accepted);
}

std::optional<bool> TomlTable::boolean_if(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean()) throw error(key, describe(*node), "true or false");
  return node->value<bool>();
}

std::optional<int> TomlTable::integer_if(std::string_view key, const Range& accepted) {
  const auto value = number_if(key, accepted);
  if (!value) return std::nullopt;
  if (*value != std::round(*value)) {
    throw error(key, fmt::format("{} is not a whole number", *value),
                fmt::format("a whole number {}", accepted.words()));
  }
  return static_cast<int>(*value);
}

std::optional<std::string> TomlTable::text_if(std::string_view key) {
  if (!has(key)) return std::nullopt;
  return text(key);
}

std::optional<std::string> TomlTable::text_or_number_if(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_string()) return value->get();
  if (const auto* value = node->as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node->as_floating_point(); value != nullptr && std::isfinite(value->get())) {
    return fmt::format("{}", value->get());
  }
  throw error(key, describe(*node), "text in quotes or a number");
}

std::string TomlTable::text(std::string_view key) {
  constexpr std::string_view kAccepted = "text in quotes, not empty";
  const toml::node& node = require(key, kAccepted);
  const auto* value = node.as_string();
  if (value == nullptr || value->get().empty()) throw error(key, describe(node), kAccepted);
  return value->get();
}

std::optional<std::size_t> TomlTable::choice_if(std::string_view key,
                                                std::span<const std::string_view> accepted) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* value = node->as_string()) {
    const auto found = std::find(accepted.begin(), accepted.end(), value->get());
    if (found != accepted.end()) return static_cast<std::size_t>(found - accepted.begin());
  }
  throw error(key, describe(*node), fmt::format("\"{}\"", fmt::join(accepted, "\" or \"")));
}

std::optional<std::vector<double>> TomlTable::numbers_if(std::string_view key, const Range& accepted,
                                                         std::string_view shape) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* list = node->as_array();
  if (list == nullptr) throw error(key, describe(*node), shape);
  std::vector<double> values;
  for (const toml::node& element : *list) values.push_back(number_of(element, key, accepted));
  return values;
}

std::optional<std::vector<std::string>> TomlTable::texts_if(std::string_view key, std::string_view shape) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* list = node->as_array();
  if (list == nullptr) throw error(key, describe(*node), shape);
  std::vector<std::string> values;
  for (const toml::node& element : *list) {
    const auto* value = element.as_string();
    if (value == nullptr) throw error(key, describe(element), shape);
    values.push_back(value->get());
  }
  return values;
}

std::optional<TomlTable> TomlTable::table_if(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) throw error(key, describe(*node), "a table");
  return TomlTable(*node->as_table(), *file_, child_path(key));
}

TomlTable TomlTable::table(std::string_view key) {
  if (auto found = table_if(key)) return *std::move(found);
  throw InputError(place(), fmt::format("table [{}]", child_path(key)), "it is missing", "a table");
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const std::string path = child_path(key);
  const toml::array* list = node->as_array();
  if (list == nullptr) throw error(key, describe(*node), fmt::format("[[{}]], once for each", path));
  std::vector<TomlTable> found;
  for (const toml::node& element : *list) {
    if (!element.is_table()) throw error(key, describe(element), fmt::format("[[{}]], once for each", path));
    found.push_back(TomlTable(*element.as_table(), *file_, path, true));
  }
  return found;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : *table_) names.emplace_back(key.str());
  return names;
}

void TomlTable::reject_unknown_keys() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(asked_.begin(), asked_.end(), key.str()) != asked_.end()) continue;
    throw InputError(place_of(*file_, key.source()), subject(key.str()), "it is unknown",
                     fmt::format("{}", fmt::join(asked_, ", ")));
  }
}

TomlDocument TomlDocument::read(const std::filesystem::path& file, const ReadOptions& options) {
  return parse(read_text_file(file, options), file);
}

TomlDocument TomlDocument::parse(std::string text, const std::filesystem::path& file) {
  const std::string checked = checked_text(std::move(text), file);
  if (const auto defect = find_toml_defect(checked)) {
    throw InputError({file, defect->line}, "TOML syntax", defect->what, "valid TOML");
  }
  try {
    auto content = std::make_unique<const Content>(Content{file, toml::parse(checked)});
    if (content->root.empty()) throw InputError({file}, "file", "it is empty: no key at all", "a TOML file");
    return TomlDocument(std::move(content));
  } catch (const toml::parse_error& error) {
    throw InputError(place_of(file, error.source()), "TOML syntax", error.description(), "valid TOML");
  }
}

}  // namespace isotach::datasets
