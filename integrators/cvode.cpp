// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "integrators/cvode.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "integrators/cvode_solver.hpp"

namespace isotach::integrators {

namespace {

template <model::Fabric K>
tl::expected<std::vector<Integrated<double>>, Failure> solve(const model::Law<double>& law,
                                                             const model::State<double>& start,
                                                             const Increment<double>& increment, int rows,
                                                             const CvodeTolerance& tolerance) {
  IncrementSystem<K> system(law, increment, start.stress.norm());
  CvodeSolver<K> solver(system, model::in_form<K>(start), increment.duration, tolerance);
  std::vector<Integrated<double>> result;
  result.reserve(static_cast<std::size_t>(rows));
  for (int row = 1; row <= rows; ++row) {
    const double time = row < rows ? increment.duration * row / rows : increment.duration;
    const int flag = solver.advance(time);
    if (flag < 0) return tl::unexpected(solver.failure(flag));
    result.push_back(solver.reached());
  }
  return result;
}

}  // namespace

tl::expected<std::vector<Integrated<double>>, Failure> integrate_cvode_rows(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    int rows, const CvodeTolerance& tolerance) {
  if (rows < 1) {
    throw std::invalid_argument("rows is " + std::to_string(rows) + "; accepted: >= 1");
  }
  if (!(increment.duration > 0.0)) {
    const Integrated<double> unchanged{start, model::Mandel<double>::Zero(), 0.0, {}};
    return std::vector<Integrated<double>>(static_cast<std::size_t>(rows), unchanged);
  }
  if (!law.in_domain(start)) return tl::unexpected(Failure{FailureKind::outside_domain, 0.0, start});
  if (law.stays_upright(start)) return solve<model::Fabric::none>(law, start, increment, rows, tolerance);
  return solve<model::Fabric::omega>(law, start, increment, rows, tolerance);
}

tl::expected<Integrated<double>, Failure> integrate_cvode(const model::Law<double>& law,
                                                          const model::State<double>& start,
                                                          const Increment<double>& increment,
                                                          const CvodeTolerance& tolerance) {
  return integrate_cvode_rows(law, start, increment, 1, tolerance).map([](const auto& rows) {
    return rows.back();
  });
}

}  // namespace isotach::integrators
