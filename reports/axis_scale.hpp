// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The range an axis shows, the place of a value on it, and its ticks.
#pragma once

#include <string>
#include <vector>

#include "reports/figure.hpp"

namespace isotach::reports {

/// One tick of an axis.
struct Tick {
  double value;
  std::string label;  ///< gnuplot's enhanced text; empty for a minor tick
};

/// Whether the axis can show the value, inside or outside of its range: it is finite, positive if the axis is
/// logarithmic, and not so extreme that ranges would overflow.
[[nodiscard]] bool can_show(const Axis& axis, double value);

/// An axis with its range settled.
class AxisScale {
 public:
  /// The range given by the axis, or else that of the values it can show, a little widened; a bound of
  /// exactly zero stays there. `values` may hold anything.
  AxisScale(const Axis& axis, const std::vector<double>& values);

  [[nodiscard]] double min() const { return min_; }
  [[nodiscard]] double max() const { return max_; }
  /// Where the value lies: 0 at min, 1 at max.
  [[nodiscard]] double position(double value) const;
  /// Ticks inside the range, about as many labels as said or fewer; those without label are minor.
  [[nodiscard]] std::vector<Tick> ticks(int labels) const;

 private:
  [[nodiscard]] double transformed(double value) const;
  [[nodiscard]] std::vector<Tick> linear_ticks(int labels) const;
  [[nodiscard]] std::vector<Tick> logarithmic_ticks(int labels) const;

  bool logarithmic_;
  double min_;
  double max_;
};

}  // namespace isotach::reports
