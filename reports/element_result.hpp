// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An element test that was run, and its course in the quantities that engineers read.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/element_file.hpp"
#include "integrators/element_test.hpp"

namespace isotach::reports {

/// What was run, and how far it came.
struct ElementRun {
  integrators::Method method;
  double tolerance;  ///< relative, of that method
  std::vector<integrators::ElementRow> rows;
  std::optional<integrators::ElementFailure> failure{};  ///< why it ended early; its own rows are in `rows`
};

/// Tensor components in the order of all element test files.
inline constexpr std::array<std::string_view, 6> kComponentNames{"11", "22", "33", "12", "13", "23"};

/// The rows as columns: kPa, compression positive, shear as tensor components.
struct ElementCurve {
  using Column = std::vector<double>;

  ElementCurve(const datasets::ElementFile& test, const std::vector<integrators::ElementRow>& rows);

  Column time;                     ///< s
  std::vector<std::size_t> stage;  ///< index
  std::array<Column, 6> strain;    ///< logarithmic
  std::array<Column, 6> stress;    ///< kPa
  std::array<Column, 6> omega;     ///< sign of sigma*/p
  Column void_ratio;
  Column ocr;
  Column volumetric_strain;
  Column p;    ///< kPa
  Column q;    ///< kPa; with its sign, sigma_axis less the lateral stress, where there is an axis, else
               ///< sqrt(3/2)|T*|
  Column p_B;  ///< kPa

  /// The axis about which stress is axisymmetric all along (0, 1 or 2), as in triaxial and oedometer tests.
  std::optional<std::size_t> axis;
  /// The component that strains most.
  std::size_t driven = 0;
  /// Only one normal component strains at all.
  bool oedometric = false;

  [[nodiscard]] std::size_t size() const { return time.size(); }
};

/// Whether anything in the column is further than `tolerance` from its first value.
[[nodiscard]] bool changes(const std::vector<double>& column, double tolerance);

/// q of a row for a reader: zero where it is no more than integration leaves of it.
[[nodiscard]] double shown_q(const ElementCurve& curve, std::size_t row);

/// What a stage holds and moves, in words: "ε11: 1e-06 1/s; σ22, σ33: 0 kPa/s".
[[nodiscard]] std::string control_text(const integrators::Stage& stage);

/// Whether every rate of the stage is zero: creep where a stress is held, else relaxation.
[[nodiscard]] bool is_hold(const integrators::Stage& stage);

}  // namespace isotach::reports
