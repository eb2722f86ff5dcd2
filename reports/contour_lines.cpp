// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/contour_lines.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace isotach::reports {

namespace {

struct Place {
  double x, y;
};

/// Where the level is met between two corners.
std::optional<Place> crossing(const Place& a, double value_a, const Place& b, double value_b, double level) {
  if ((value_a < level) == (value_b < level)) return std::nullopt;
  const double share = (level - value_a) / (value_b - value_a);
  return Place{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

}  // namespace

Series contour_line(std::span<const double> x, std::span<const double> y, const Eigen::MatrixXd& values,
                    double level) {
  Series line;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const auto r = static_cast<Eigen::Index>(i);
      const auto c = static_cast<Eigen::Index>(j);
      const Place corners[] = {{x[i], y[j]}, {x[i + 1], y[j]}, {x[i + 1], y[j + 1]}, {x[i], y[j + 1]}};
      const double at[] = {values(r, c), values(r + 1, c), values(r + 1, c + 1), values(r, c + 1)};
      if (!std::isfinite(at[0] + at[1] + at[2] + at[3])) continue;
      std::vector<Place> met;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        if (const auto place = crossing(corners[k], at[k], corners[next], at[next], level)) {
          met.push_back(*place);
        }
      }
      // two crossings, or four in a saddle: there pairs in the order met do not cut each other
      for (std::size_t k = 0; k + 1 < met.size(); k += 2) {
        line.x.insert(line.x.end(), {met[k].x, met[k + 1].x, kNone});
        line.y.insert(line.y.end(), {met[k].y, met[k + 1].y, kNone});
      }
    }
  }
  return line;
}

}  // namespace isotach::reports
