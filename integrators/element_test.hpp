// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Element test: one material point led through stages, each at constant strain or stress rates.
#pragma once

#include <cstddef>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "integrators/integrate.hpp"

namespace isotach::integrators {

/// One stage; results are wanted after each of `rows` equal time intervals.
struct Stage {
  std::string name;
  Increment<double> increment;  ///< over the whole stage
  int rows = 1;                 ///< >= 1
};

/// One line of the result.
struct ElementRow {
  double time;                   ///< s since the start
  std::size_t stage;             ///< index; the start belongs to stage 0
  model::Mandel<double> strain;  ///< logarithmic, since the start
  model::State<double> state;
  double overconsolidation_ratio;
};

/// Where an element test failed.
struct ElementFailure {
  std::size_t stage;
  double time;  ///< s since the start
  Failure failure;
  std::vector<ElementRow> rows;  ///< up to the failure; none where the start itself is outside the domain
};

/// Runs the stages one after the other; the first row is the start. Throws std::invalid_argument, naming the
/// stage, where `rows` or the duration is out of range.
[[nodiscard]] tl::expected<std::vector<ElementRow>, ElementFailure> run_element_test(
    const model::Law<double>& law, const model::State<double>& start, const std::vector<Stage>& stages,
    const Options& options = {});

}  // namespace isotach::integrators
