// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Numbers as colours.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reports/axis_scale.hpp"
#include "reports/figure.hpp"

namespace isotach::reports {

/// The colour map viridis, perceptually uniform and told apart by colour-blind eyes: dark blue at 0, yellow
/// at 1; what is beyond is as at the end. Within 5/255 of the original.
///
/// Source: N. J. Smith, S. van der Walt and E. Firing, github.com/BIDS/colormap, colormaps.py (CC0); every
/// 15th of its 256 colours, linear between.
[[nodiscard]] Rgb viridis(double position);

/// "#rrggbb"
[[nodiscard]] std::string hex(const Rgb& colour);

/// The colours of a quantity: equal steps of viridis between two limits.
class ColourScale {
 public:
  static constexpr int kLevels = 64;

  /// Limits are axis.min and axis.max, both given.
  explicit ColourScale(Axis axis);

  [[nodiscard]] const Axis& axis() const { return axis_; }
  [[nodiscard]] const AxisScale& scale() const { return scale_; }
  /// Place in the palette, from 1; values beyond a limit have its level; 0 where there is no number.
  [[nodiscard]] std::uint8_t level(double value) const;
  [[nodiscard]] static std::span<const Rgb> palette();

 private:
  Axis axis_;
  AxisScale scale_;
};

/// Limits for a logarithmic scale of positive values: whole decades around all but the least 2 % and the
/// greatest 0.1 % of the values, at least two and at most six, those below the greatest. `label` is the
/// axis's; values that are not positive numbers are left out.
[[nodiscard]] Axis logarithmic_limits(std::string label, std::vector<float> values);

/// Limits for a linear scale: round numbers around all but the least 1 % and the greatest 5 % of the values:
/// OCR, say, is many times what it is elsewhere where the mud has lost contact.
[[nodiscard]] Axis linear_limits(std::string label, std::vector<float> values);

}  // namespace isotach::reports
