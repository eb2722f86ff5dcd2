// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Errors under refinement, with the orders that they show.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "bench/mpm_problems/section.hpp"

namespace isotach::bench {

/// Order in the cell size of an error that fell from `coarse` to `fine` when the number of cells along a
/// length grew by the factor `refinement`; of their magnitudes.
[[nodiscard]] inline double order(double coarse, double fine, double refinement = 2.0) {
  return std::log(std::abs(coarse / fine)) / std::log(refinement);
}

/// A table of errors: a row for each number of cells, with the order since the row before.
class Convergence {
 public:
  /// Names of what is chosen, the first columns of the table, of the errors, and of what has no order.
  Convergence(std::vector<std::string> choices, std::vector<std::string> errors,
              std::vector<std::string> remarks = {});

  /// The next row. Orders start anew where the choices differ from those of the row before.
  void add(const std::vector<std::string>& choices, double cells, const std::vector<double>& errors,
           const std::vector<std::string>& remarks = {});
  [[nodiscard]] const SectionTable& table() const { return table_; }

 private:
  SectionTable table_;
  std::vector<std::string> last_choices_;
  double last_cells_ = 0.0;
  std::vector<double> last_errors_;
};

}  // namespace isotach::bench
