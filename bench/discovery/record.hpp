// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What one benchmark study came to, and the journal of those that are done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isotach::bench {

/// Numbers that do not exist are NaN, null in the journal.
struct Record {
  std::size_t number = 0;  ///< in the plan
  std::uint64_t seed = 0;
  std::string kind;
  std::vector<std::string> hidden;
  std::string programme;
  double noise = 0.0;
  double wanted = 0.0;      ///< visibility asked for
  double visibility = 0.0;  ///< had
  double beside = 0.0;      ///< sigma left beside the best other effect
  /// "done"; "out of reach": no admissible amplitude shows as plainly as asked; "failed": see `why`.
  std::string state;
  std::string why;
  std::string verdict;
  std::vector<std::string> named;
  std::vector<std::string> first;  ///< effects of the trial of lowest BIC
  std::vector<std::vector<std::string>> equivalent;
  std::vector<std::string> refused;  ///< conditions of a name that did not hold
  double p_value = 0.0;
  double gap_before = 0.0;
  double gap_after = 0.0;  ///< with what is named
  double held_out_before = 0.0;
  double held_out_after = 0.0;
  std::vector<double> true_amplitudes;  ///< SI
  double amplitude = 0.0;               ///< of the hidden effect, where it alone is named
  double lower = 0.0;                   ///< of its 90 % interval
  double upper = 0.0;
  std::optional<bool> place;  ///< whether the stage where the hidden shows most is ranked first
  double seconds = 0.0;       ///< of discovery
};

[[nodiscard]] nlohmann::ordered_json json_of(const Record& record);
[[nodiscard]] Record record_of(const nlohmann::ordered_json& json);

/// A file of JSON lines that grows by a line for each study; threads may share it.
class Journal {
 public:
  /// Reads what is there. A last line without its end, of a run that was killed, is cut off. Throws
  /// std::runtime_error, with the line, for any other line that is no record, and where the file cannot be
  /// written.
  explicit Journal(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<Record>& records() const { return records_; }
  /// Those of a seed, by number.
  [[nodiscard]] std::vector<Record> of(std::uint64_t seed) const;
  [[nodiscard]] bool has(std::size_t number, std::uint64_t seed) const;
  /// Writes the record through to the file.
  void add(const Record& record);

 private:
  std::vector<Record> records_;
  std::ofstream stream_;
  mutable std::mutex mutex_;
};

}  // namespace isotach::bench
