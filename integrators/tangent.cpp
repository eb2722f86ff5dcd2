// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "integrators/tangent.hpp"

#include <ceres/jet.h>

#include <stdexcept>

namespace isotach::integrators {

namespace {

// Six derivatives are wanted; eight fill vector registers whole, and cost less than six.
using Jet = ceres::Jet<double, 8>;

Eigen::Matrix<double, 6, 6> derivatives(const model::Mandel<Jet>& stress) {
  Eigen::Matrix<double, 6, 6> result;
  for (int i = 0; i < 6; ++i) result.row(i) = stress[i].v.head<6>().transpose();
  return result;
}

}  // namespace

template <model::Fabric K>
tl::expected<IntegratedWithTangent<K>, Failure> integrate_with_tangent(
    const model::Law<double>& law, const model::State<double, model::kGeneral, K>& start,
    const Increment<double>& increment, const Tolerance& tolerance, double first_substep) {
  if (!increment.strain_driven()) {
    throw std::invalid_argument("the tangent is that of a strain-driven increment");
  }
  const bool moves = increment.duration > 0.0;
  Increment<Jet> jet_increment = increment.cast<Jet>();
  // strain rate = strain increment/duration; for a vanishing increment the stress rate by the strain rate
  const double seed = moves ? 1.0 / increment.duration : 1.0;
  for (int i = 0; i < 6; ++i) jet_increment.strain_rate[i].v[i] = seed;
  const auto jet_start = model::cast<Jet>(start);

  IntegratedWithTangent<K> out{{start, model::Mandel<double>::Zero(), first_substep, {}}, {}};
  if (!moves) {
    if (!law.in_domain(start)) {
      return tl::unexpected(Failure{FailureKind::outside_domain, 0.0, model::with_omega(start)});
    }
    out.tangent = derivatives(law.rate(jet_start, jet_increment.strain_rate).stress);
    return out;
  }
  const auto end = integrate_fellin_ostermann(law, jet_start, jet_increment, tolerance, first_substep);
  if (!end) return tl::unexpected(end.error());
  out.result = {model::plain(end->state), model::plain<Jet, 6>(end->strain), end->next_substep,
                end->statistics};
  out.tangent = derivatives(end->state.stress);
  return out;
}

template tl::expected<IntegratedWithTangent<model::Fabric::omega>, Failure> integrate_with_tangent(
    const model::Law<double>&, const model::State<double, model::kGeneral, model::Fabric::omega>&,
    const Increment<double>&, const Tolerance&, double);
template tl::expected<IntegratedWithTangent<model::Fabric::none>, Failure> integrate_with_tangent(
    const model::Law<double>&, const model::State<double, model::kGeneral, model::Fabric::none>&,
    const Increment<double>&, const Tolerance&, double);

}  // namespace isotach::integrators
