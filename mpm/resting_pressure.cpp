// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/resting_pressure.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstddef>
#include <stdexcept>

namespace isotach::mpm {

std::vector<double> resting_pressures(const std::vector<double>& heights, double cell_size,
                                      const std::function<double(double)>& overburden) {
  const auto rows = static_cast<Eigen::Index>(heights.size());
  const auto corners = static_cast<Eigen::Index>(heights.back() / cell_size) + 2;
  Eigen::VectorXd pressures(rows);
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(corners);
  std::vector<Eigen::Triplet<double>> weights;  // of a row at a corner
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double z = heights[static_cast<std::size_t>(row)];
    pressures[row] = overburden(z);
    const auto cell = static_cast<Eigen::Index>(z / cell_size);
    const double y = z / cell_size - static_cast<double>(cell);
    weights.emplace_back(cell, row, 1.0 - y);
    weights.emplace_back(cell + 1, row, y);
    volumes[cell] += 1.0 - y;
    volumes[cell + 1] += y;
  }
  Eigen::SparseMatrix<double> average(corners, rows);
  average.setFromTriplets(weights.begin(), weights.end());
  average = volumes.cwiseInverse().asDiagonal() * average;
  Eigen::VectorXd missing(corners);
  for (Eigen::Index corner = 0; corner < corners; ++corner) {
    missing[corner] = overburden(static_cast<double>(corner) * cell_size);
  }
  missing -= average * pressures;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> least(average * average.transpose());
  if (least.info() != Eigen::Success || least.vectorD().minCoeff() < 1e-12 * least.vectorD().maxCoeff()) {
    throw std::invalid_argument("points at rest: fewer than two rows of points in a cell");
  }
  pressures += average.transpose() * least.solve(missing);
  return {pressures.begin(), pressures.end()};
}

}  // namespace isotach::mpm
