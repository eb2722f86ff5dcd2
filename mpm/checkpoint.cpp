// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/checkpoint.hpp"

#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

#include "mpm/archive.hpp"
#include "mpm/code_version.hpp"
#include "mpm/setup_fields.hpp"

namespace isotach::mpm {

namespace {

constexpr std::string_view kMagic = "isotach slump checkpoint 4\n";

/// FNV-1a.
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 1099511628211ULL;
  }
  return hash;
}

template <class T>
void archive_copy(Archive& archive, T value) {
  archive(value);
}

void archive_copy(Archive& archive, const std::optional<double>& value) {
  archive_copy(archive, value.value_or(-1.0));  // none of them can be negative
}

}  // namespace

std::uint64_t run_key(const model::Parameters<double>& parameters, const SlumpSetup& setup, bool history,
                      bool snapshots, std::size_t frames) {
  Archive archive;
  for (const model::ParameterInfo& parameter : model::kParameterTable) {
    double value = parameters.values()[parameter.id];
    archive(value);
  }
  auto lode = parameters.values().lode;
  archive(lode);
  visit_fields(setup, [&](std::string_view, const auto& value) { archive_copy(archive, value); });
  archive_copy(archive, setup.numerics.threads);
  archive(history);
  archive(snapshots);
  archive(frames);
  return hash_of(archive.bytes() + code_version());
}

bool write_checkpoint(const std::filesystem::path& file, std::uint64_t key, std::string_view state) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  std::uint64_t check = hash_of(state);
  {
    std::ofstream out(temporary, std::ios::binary);
    out << kMagic;
    out.write(reinterpret_cast<const char*>(&key), sizeof key);
    out.write(reinterpret_cast<const char*>(&check), sizeof check);
    out.write(state.data(), static_cast<std::streamsize>(state.size()));
    if (!out.flush()) return false;
  }
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  return !error;
}

std::optional<std::string> read_checkpoint(const std::filesystem::path& file, std::uint64_t key) {
  std::ifstream in(file, std::ios::binary);
  std::string all((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  constexpr std::size_t kHead = kMagic.size() + 2 * sizeof(std::uint64_t);
  if (!in || all.size() < kHead || !std::string_view(all).starts_with(kMagic)) return std::nullopt;
  std::uint64_t numbers[2];
  std::memcpy(numbers, all.data() + kMagic.size(), sizeof numbers);
  std::string state = all.substr(kHead);
  if (numbers[0] != key || numbers[1] != hash_of(state)) return std::nullopt;
  return state;
}

}  // namespace isotach::mpm
