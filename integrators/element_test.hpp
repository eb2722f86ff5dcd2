// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Element test: one material point led through stages, each at constant strain or stress rates.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "integrators/integrate.hpp"

namespace isotach::integrators {

/// One stage. Its rows stand at equal intervals, or, where `first_row` is given, at times that grow by a
/// constant factor, as a hold is best followed.
struct Stage {
  std::string name;
  Increment<double> increment;  ///< over the whole stage
  int rows = 1;                 ///< >= 1
  /// Values to be reached at the end of the stage at a constant rate, Mandel components, tension positive:
  /// where component i is stress-controlled that of sum_j condition[i][j] T_j (Pa), else that of the
  /// logarithmic strain since the start of the test. The rate is found when the stage begins, that of
  /// `increment` is not read; the duration must be positive.
  std::array<std::optional<double>, 6> target{};
  double first_row = 0.0;  ///< s after the stage begins, 0 < first_row < duration; 0: equal intervals
};

/// One line of the result.
struct ElementRow {
  double time;                   ///< s since the start
  std::size_t stage;             ///< index; the start belongs to stage 0
  model::Mandel<double> strain;  ///< logarithmic, since the start
  model::State<double> state;
  double overconsolidation_ratio;
  Statistics statistics{};  ///< since the start
};

/// Where an element test failed.
struct ElementFailure {
  std::size_t stage;
  double time;  ///< s since the start
  Failure failure;
  std::vector<ElementRow> rows;  ///< up to the failure; none where the start itself is outside the domain
  bool interrupted = false;      ///< the run was told to stop; `failure` then says no more than where it was
};

/// Eyes and a hand on a run that takes long.
struct ElementWatch {
  std::function<void(double)> progress{};   ///< called after each row with its time (s)
  const std::atomic<bool>* stop = nullptr;  ///< the run ends before the next row once this is true
};

/// The increment of a stage that begins with this strain and state: that of the stage, with the rates that
/// lead to its targets.
[[nodiscard]] Increment<double> resolved(const Stage& stage, const model::Mandel<double>& strain,
                                         const model::State<double>& state);

/// Time of a row of the stage (s since the stage began); `row` counts from 1 to stage.rows.
[[nodiscard]] double row_time(const Stage& stage, int row);

/// Runs the stages one after the other; the first row is the start. Fellin-Ostermann and Rosenbrock go on
/// from row to row with the substep they have reached, CVODE does not restart within a stage whose rows are
/// at equal intervals. Throws std::invalid_argument, naming the stage, where rows, first row, duration or a
/// target is out of range.
[[nodiscard]] tl::expected<std::vector<ElementRow>, ElementFailure> run_element_test(
    const model::Law<double>& law, const model::State<double>& start, const std::vector<Stage>& stages,
    const Options& options = {}, const ElementWatch& watch = {});

}  // namespace isotach::integrators
