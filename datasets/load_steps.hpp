// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Gathers the readings of an incremental-loading test into the steps of its record.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "datasets/oedometer.hpp"

namespace isotach::datasets {

/// Loads that differ by less than this part of themselves are one load, read twice.
inline constexpr double kSameLoad = 1e-3;

/// Whether two loads (Pa, > 0) are one.
[[nodiscard]] bool same_load(double a, double b);

/// Fills `steps` and `rows` of a stress-controlled record.
///
/// A reading at the moment of loading is none under that load: it shows the strain of the load before, or a
/// placeholder. Such readings are left out, and one note of the record counts them. A step without any other
/// reading is left out and named.
///
/// The stage of a step is the recorded one, where that is load or unload and the movement does not contradict
/// it; else it follows from the load before (not below it: load; the first step: load). Contradictions:
/// an unload step whose load is not below the one before (or is the first) while the strain grows, a load
/// step whose load is below while the strain falls. Each is named in a note.
class LoadStepBuilder {
 public:
  /// `record` is filled by finish() and must outlive the builder.
  explicit LoadStepBuilder(OedometerRecord& record) : record_(&record) {}

  /// A step of the file begins: `line` for messages, `name` as the file has it, `begin` (s) when its load is
  /// put on, not before the last reading.
  void open(std::size_t line, std::string name, double begin, std::optional<Stage> recorded);
  /// A reading of the step that is open; row.axial_stress is its load. Dropped and named where its time is
  /// not after the latest.
  void add(OedometerRow row);
  /// Closes the last step. To be called once, after which the record is complete.
  void finish();

 private:
  struct Open {
    std::size_t line;
    std::string name;
    LoadStep step;
    std::optional<Stage> recorded;
  };

  void close();
  [[nodiscard]] Stage stage_of(const Open& open);

  OedometerRecord* record_;
  std::optional<Open> open_;
  double latest_ = 0.0;         // time of the last reading that was kept
  double latest_strain_ = 0.0;  // likewise; the test begins at strain 0
  std::size_t at_loading_ = 0;
  std::size_t first_at_loading_line_ = 0;
};

}  // namespace isotach::datasets
