// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The project's table of reference numbers for set A, row by row, by every integrator and tolerance.
#pragma once

#include <string>
#include <vector>

#include "verification/check.hpp"
#include "verification/path.hpp"

namespace isotach::verification {

/// One integrator at one tolerance.
struct Contender {
  integrators::Method method;
  double tolerance;  ///< relative

  [[nodiscard]] std::string label() const;
};

/// Every number of the table by the end of a path: what each contender got.
struct ReferenceRow {
  std::string name;
  double expected;
  double half_digit;          ///< half a unit of the last digit printed
  double strain;              ///< of the path, time integral of |D|
  std::vector<double> got{};  ///< one a contender; NaN where it failed
};

/// The table's rows with the numbers of all contenders.
struct ReferenceTable {
  std::vector<Contender> contenders;
  std::vector<ReferenceRow> rows;
};

/// CVODE at 1e-10, Fellin-Ostermann at 1e-4, 1e-6, 1e-8, Rosenbrock at 1e-8.
[[nodiscard]] ReferenceTable reference_table();

/// The table as checks: CVODE and Rosenbrock within 1e-6 (or half a printed digit), Fellin-Ostermann within
/// 10 TOL strain/0.1 and half a digit. Holds have no strain of their own; theirs counts as 0.1.
[[nodiscard]] std::vector<Check> checks_of(const ReferenceTable& table);

}  // namespace isotach::verification
