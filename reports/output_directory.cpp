// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Staging and publishing of results; text, JSON and CSV files.
#include "reports/output_directory.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

namespace isotach::reports {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string_view reason) {
  throw OutputError(fmt::format("cannot write to {}: {}", path.string(), reason));
}

/// Whether something can be seen there; what cannot even be looked at is found out on writing.
bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// Creates the folder and its missing parents and returns those it created, outermost first. Removes them
/// again where it fails halfway.
std::vector<fs::path> create_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  for (fs::path path = folder; !is_there(path) && path.has_relative_path(); path = path.parent_path()) {
    missing.insert(missing.begin(), path);
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
      std::error_code ignored;
      fs::remove(*path, ignored);
    }
    fail(folder, error.message());
  }
  return missing;
}

fs::path absolute_destination(const fs::path& destination) {
  if (destination.empty()) throw OutputError("cannot write results: the path of the folder is empty");
  std::error_code error;
  fs::path path = fs::weakly_canonical(fs::absolute(destination), error);
  if (error) fail(destination, error.message());
  if (!path.has_filename()) path = path.parent_path();  // "out/" is "out"
  if (is_there(path) ? !is_folder(path) : fs::is_symlink(path, error)) {
    fail(destination, "it exists and is not a folder");
  }
  return path;
}

fs::path make_private_folder(const fs::path& parent, const fs::path& destination) {
  std::string name = (parent / ".isotach-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) fail(destination, std::generic_category().message(errno));
  return name;
}

void append_cell(std::string& out, double value) {
  if (!std::isfinite(value)) return;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  out.append(text, end.ptr);
}

void append_cell(std::string& out, const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

std::size_t length(const CsvColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

}  // namespace

OutputDirectory::OutputDirectory(const fs::path& destination)
    : destination_(absolute_destination(destination)) {
  // A destination that exists is staged inside, since its parent may be read-only or another file system; one
  // that does not is staged beside, and appears in a single rename.
  const bool inside = is_there(destination_);
  if (!inside) created_parents_ = create_folders(destination_.parent_path());
  try {
    staging_ = make_private_folder(inside ? destination_ : destination_.parent_path(), destination_);
    content_ = staging_ / "content";
    std::error_code error;
    fs::create_directory(content_, error);
    if (error) fail(destination_, error.message());
  } catch (...) {
    std::error_code ignored;
    if (!staging_.empty()) fs::remove_all(staging_, ignored);
    for (auto path = created_parents_.rbegin(); path != created_parents_.rend(); ++path) {
      fs::remove(*path, ignored);
    }
    throw;
  }
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (committed_) return;
  for (auto path = created_parents_.rbegin(); path != created_parents_.rend(); ++path) {
    fs::remove(*path, ignored);  // refuses a folder that somebody else put something into
  }
}

fs::path OutputDirectory::staging_path(const fs::path& name) {
  if (committed_) throw std::logic_error("results are already published");
  const fs::path normal = name.lexically_normal();
  if (normal.empty() || normal.is_absolute() || !normal.has_filename() || normal == "." ||
      *normal.begin() == "..") {
    throw std::invalid_argument(fmt::format("not the name of a file inside a folder: '{}'", name.string()));
  }
  const fs::path path = content_ / normal;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) fail(destination_ / normal, error.message());
  return path;
}

void OutputDirectory::write_text(const fs::path& name, std::string_view content) {
  const fs::path path = staging_path(name);
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) fail(destination_ / name, std::generic_category().message(errno != 0 ? errno : EIO));
}

void OutputDirectory::write_json(const fs::path& name, const nlohmann::ordered_json& value) {
  write_text(name, value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
}

void OutputDirectory::write_csv(const fs::path& name, std::span<const CsvColumn> columns) {
  const std::size_t rows = columns.empty() ? 0 : length(columns.front());
  std::string text;
  for (const CsvColumn& column : columns) {
    if (length(column) != rows) {
      throw std::invalid_argument(fmt::format("{}: column '{}' has {} rows and '{}' has {}", name.string(),
                                              columns.front().header, rows, column.header, length(column)));
    }
    if (&column != &columns.front()) text += ',';
    append_cell(text, column.header);
  }
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (const CsvColumn& column : columns) {
      if (&column != &columns.front()) text += ',';
      std::visit([&](const auto& values) { append_cell(text, values[row]); }, column.values);
    }
    text += '\n';
  }
  write_text(name, text);
}

void OutputDirectory::commit() {
  if (committed_) throw std::logic_error("results are already published");
  std::error_code error;
  if (!is_there(destination_)) fs::rename(content_, destination_, error);
  // Where another process created the destination in the meantime, there is nothing left but to join it.
  if (is_there(content_)) merge_into_destination();
  committed_ = true;
  fs::remove_all(staging_, error);
}

void OutputDirectory::merge_into_destination() {
  std::error_code error;
  fs::create_directory(destination_, error);
  if (error) fail(destination_, error.message());
  std::vector<fs::path> folders;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(content_)) {
    (entry.is_directory() ? folders : files).push_back(entry.path().lexically_relative(content_));
  }
  for (const fs::path& folder : folders) {
    const fs::path target = destination_ / folder;
    if (is_there(target) && !is_folder(target)) fail(target, "a file is in the way of a folder");
  }
  for (const fs::path& file : files) {
    if (is_folder(destination_ / file)) fail(destination_ / file, "a folder is in the way of a file");
  }
  for (const fs::path& folder : folders) {
    fs::create_directories(destination_ / folder, error);
    if (error) fail(destination_ / folder, error.message());
  }
  for (const fs::path& file : files) {
    fs::rename(content_ / file, destination_ / file, error);
    if (error) fail(destination_ / file, error.message());
  }
}

}  // namespace isotach::reports
