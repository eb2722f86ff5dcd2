// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An oedometer test as the model runs through it: where it starts, what drives it, what is compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datasets/study.hpp"

namespace isotach::experiments {

/// Where the specimen starts.
struct OedometerStart {
  double time;          ///< s
  double axial_strain;  ///< engineering (-)
  double axial_stress;  ///< Pa, compression positive
  double void_ratio;    ///< by the height, whatever the law starts from
  std::size_t row;      ///< of the record: the reading that is the start; kNoRow where the study gives it
};

inline constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);

/// One step of the history, at the end of which a row stands, or none.
struct DriveStep {
  double duration;  ///< s, > 0
  bool stress_controlled;
  double amount;    ///< logarithmic axial strain increment (-), or axial stress at its end (Pa); compression
                    ///< positive
  std::size_t row;  ///< of the record; kNoRow where it only brings the load on
  double direction = 1.0;  ///< +1 loading, -1 unloading: the one last commanded
  bool held = false;       ///< strain, or stress once it is on, is kept as it is
};

/// What a value is.
enum class ValueKind {
  log_stress,  ///< ln(axial effective stress / 1 Pa)
  strain       ///< engineering axial strain, since the start or since a hold began
};

/// A value that model and data are compared in.
struct ComparedValue {
  std::size_t step;  ///< at whose end
  std::size_t row;   ///< of the record
  ValueKind kind;
  double measured;
  double noise;               ///< standard deviation, > 0
  double known_variance;      ///< the part of noise^2 that comes of the reading of strain
  std::size_t strain_origin;  ///< step at whose end the strain is counted from; kNoRow: from the start
  bool opens_chain;           ///< no error of reading is carried over from the value before of its kind
};

/// How the primary consolidation of a load step was bounded.
struct PrimaryConsolidation {
  std::size_t step;           ///< index in the record's steps
  std::optional<double> end;  ///< s after the load; nothing where no reading of the step is compared
  std::string how;            ///< in words
};

struct OedometerProtocol {
  OedometerStart start;
  std::vector<DriveStep> steps;
  std::vector<ComparedValue> values;
  std::vector<PrimaryConsolidation> consolidation;  ///< of a stress-controlled test, a step each
  /// Temperature (deg C) at the start, then at the end of each step, between readings by interpolation; empty
  /// where the file has none.
  std::vector<double> temperatures;
  /// Axial strain rate (1/s, logarithmic, > 0) of the first loading stage, or load step, from its ends;
  /// nothing where the test has no loading.
  std::optional<double> first_loading_rate;
};

/// Strain-controlled: the strain history drives, ln stress is compared; but where a recorded `hold` holds the
/// stress, its mean drives and the strain that creeps is compared. Stress-controlled: the loads drive, strain
/// is compared from the end of primary consolidation on, until which the load is brought on at a constant
/// rate: a drained law has no other way to follow it. Without an initial stress the start is the first row,
/// or the last of the first load step, whose strain then holds whatever bedding and seating came before.
[[nodiscard]] OedometerProtocol make_protocol(const datasets::OedometerTest& test);

}  // namespace isotach::experiments
