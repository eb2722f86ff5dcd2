// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Forward sensitivities posed to CVODES.
#include "integrators/sensitivities.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "integrators/cvode_solver.hpp"
#include "integrators/variational_system.hpp"

namespace isotach::integrators {

namespace {

/// Size of a direction relative to the inputs it moves, 1 where it moves none: CVODES is given directions of
/// size one, so that its tolerances are relative ones for parameters of any unit.
double relative_size(const Direction& direction, const model::Law<double>& law,
                     const model::State<double>& start, const Increment<double>& increment) {
  const auto over = [](double move, double size) { return move / (size > 0.0 ? size : 1.0); };
  double result = 0.0;
  for (std::size_t i = 0; i < model::kParameterCount; ++i) {
    result = std::max(result, over(std::abs(direction.parameters[i]), law.parameters().values().values[i]));
  }
  const double stress = start.stress.norm();
  const double strain = increment.duration * increment.strain_rate.norm();
  result = std::max({result, over(increment.duration * direction.strain_rate.norm(), strain),
                     increment.duration * direction.stress_rate.norm() / stress,
                     direction.start.stress.norm() / stress, std::abs(direction.start.void_ratio),
                     direction.start.omega.norm()});
  return result > 0.0 ? result : 1.0;
}

Direction scaled(Direction direction, double factor) {
  for (double& value : direction.parameters) value *= factor;
  direction.strain_rate *= factor;
  direction.stress_rate *= factor;
  direction.start.stress *= factor;
  direction.start.void_ratio *= factor;
  direction.start.omega *= factor;
  return direction;
}

/// Whether the direction leads away from Omega = 0.
bool moves_omega(const Direction& direction) {
  const double C_2 = direction.parameters[static_cast<std::size_t>(model::ParameterId::C_2)];
  return std::abs(C_2) > 0.0 || !direction.start.omega.isZero(0.0);
}

/// A vector of CVODES for each direction.
class Columns {
 public:
  void add(CvodeVector vector) {
    raw_.push_back(vector.get());
    vectors_.push_back(std::move(vector));
  }
  [[nodiscard]] N_Vector* data() { return raw_.data(); }
  [[nodiscard]] double* operator[](std::size_t k) const { return N_VGetArrayPointer(raw_[k]); }

 private:
  std::vector<CvodeVector> vectors_;
  std::vector<N_Vector> raw_;
};

template <model::Fabric K>
int sensitivity_rates(int, double, N_Vector y, N_Vector, N_Vector* s, N_Vector* ds, void* solver, N_Vector,
                      N_Vector) {
  const auto column = [](N_Vector* vectors) {
    return [vectors](std::size_t k) { return N_VGetArrayPointer(vectors[k]); };
  };
  auto& variational = *static_cast<CvodeSolver<K>*>(solver)->variational;
  return variational.rates(N_VGetArrayPointer(y), column(s), column(ds)) ? 0 : 1;
}

template <model::Fabric K>
tl::expected<IntegratedWithSensitivities, Failure> solve(const model::Law<double>& law,
                                                         const model::State<double>& start,
                                                         const Increment<double>& increment,
                                                         const CvodeTolerance& tolerance,
                                                         const std::vector<Direction>& directions) {
  using System = IncrementSystem<K>;
  System system(law, increment, start.stress.norm());
  CvodeSolver<K> solver(system, model::in_form<K>(start), increment.duration, tolerance);

  std::vector<double> sizes;
  std::vector<Direction> unit_directions;
  Columns columns;
  Columns absolute;
  for (const Direction& direction : directions) {
    sizes.push_back(relative_size(direction, law, start, increment));
    unit_directions.push_back(scaled(direction, 1.0 / sizes.back()));
    columns.add(solver.vector());
    absolute.add(solver.absolute_tolerances(tolerance));
    double* s = columns[sizes.size() - 1];
    system.start(model::in_form<K>(unit_directions.back().start), s);
  }
  VariationalSystem<K> variational(system, law, increment, unit_directions);
  solver.variational = &variational;
  void* memory = solver.memory();
  require_cvode(CVodeSensInit(memory, static_cast<int>(directions.size()), CV_STAGGERED, sensitivity_rates<K>,
                              columns.data()) == CV_SUCCESS,
                "CVodeSensInit");
  require_cvode(CVodeSensSVtolerances(memory, tolerance.relative, absolute.data()) == CV_SUCCESS,
                "CVodeSensSVtolerances");
  require_cvode(CVodeSetSensErrCon(memory, SUNTRUE) == CV_SUCCESS, "CVodeSetSensErrCon");

  int flag = solver.advance(increment.duration);
  double time = 0.0;
  if (flag >= 0) flag = CVodeGetSens(memory, &time, columns.data());
  if (flag < 0) return tl::unexpected(solver.failure(flag));
  IntegratedWithSensitivities out{solver.reached(), {}};
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const auto state = model::with_omega(system.template state<double>(columns[k]));
    out.derivatives.push_back({{state.stress * sizes[k], state.void_ratio * sizes[k], state.omega * sizes[k]},
                               system.strain(columns[k]) * sizes[k]});
  }
  return out;
}

}  // namespace

Direction along(model::ParameterId id) {
  Direction direction;
  direction.parameters[static_cast<std::size_t>(id)] = 1.0;
  return direction;
}

tl::expected<IntegratedWithSensitivities, Failure> integrate_with_sensitivities(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    const CvodeTolerance& tolerance, const std::vector<Direction>& directions) {
  if (directions.empty() || !(increment.duration > 0.0)) {
    return integrate_cvode(law, start, increment, tolerance).map([&directions](const auto& result) {
      IntegratedWithSensitivities out{result, {}};
      for (const auto& direction : directions) {
        out.derivatives.push_back({direction.start, model::Mandel<double>::Zero()});
      }
      return out;
    });
  }
  if (!law.in_domain(start)) return tl::unexpected(Failure{FailureKind::outside_domain, 0.0, start});
  if (law.stays_upright(start) && std::ranges::none_of(directions, moves_omega)) {
    return solve<model::Fabric::none>(law, start, increment, tolerance, directions);
  }
  return solve<model::Fabric::omega>(law, start, increment, tolerance, directions);
}

tl::expected<IntegratedWithTangent<>, Failure> integrate_cvode_with_tangent(
    const model::Law<double>& law, const model::State<double>& start, const Increment<double>& increment,
    const CvodeTolerance& tolerance) {
  if (!increment.strain_driven() || !(increment.duration > 0.0)) {
    return integrate_with_tangent(law, start, increment, Tolerance{});
  }
  std::vector<Direction> directions(6);
  for (int j = 0; j < 6; ++j)
    directions[static_cast<std::size_t>(j)].strain_rate[j] = 1.0 / increment.duration;
  const auto end = integrate_with_sensitivities(law, start, increment, tolerance, directions);
  if (!end) return tl::unexpected(end.error());
  IntegratedWithTangent<> out{end->result, {}};
  for (int j = 0; j < 6; ++j) out.tangent.col(j) = end->derivatives[static_cast<std::size_t>(j)].state.stress;
  return out;
}

}  // namespace isotach::integrators
