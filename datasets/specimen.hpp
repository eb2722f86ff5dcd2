// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What a laboratory's file says of the specimen itself, and which of its tests is meant.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isotach::datasets {

/// A specimen as its file describes it. SI; nothing where the file is silent.
struct SpecimenData {
  std::optional<double> height;            ///< m
  std::optional<double> diameter;          ///< m
  std::optional<double> void_ratio;        ///< (-), at the start
  std::optional<double> water_content;     ///< mass of water over mass of grains (-), at the start
  std::optional<double> bulk_density;      ///< kg/m3, at the start
  std::optional<double> specific_gravity;  ///< of the grains (-)
  std::vector<std::string> assumptions{};  ///< what the laboratory or the reader took for granted
};

/// Columns or headings and the value of each that the test meant has; numbers are compared as numbers.
using Selection = std::vector<std::pair<std::string, std::string>>;

/// Whether a cell holds the value asked for.
[[nodiscard]] bool same_value(std::string_view cell, std::string_view wanted);

/// The selection as a study would write it, for messages: `{ bro_id = "BHR1", begin_depth_m = "2.5" }`.
[[nodiscard]] std::string words_of(const Selection& selection);

/// The index of the one of `tests` (what tells each apart, at least one) that `wanted` fits, or nothing and
/// why not, listing the tests there are.
struct SelectedTest {
  std::optional<std::size_t> index;
  std::string problem;  ///< empty where there is an index
};
[[nodiscard]] SelectedTest select_test(const std::vector<Selection>& tests, const Selection& wanted);

}  // namespace isotach::datasets
