// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/slump_candidate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace isotach::discovery {

SlumpCandidate slump_candidate(const SlumpBasis& basis, const std::vector<const effects::Effect*>& added) {
  const datasets::Study& study = basis.study;
  SlumpCandidate candidate;
  candidate.added = added;
  candidate.effects = study.effects;
  std::vector<effects::ParameterRef> free = calibration::free_slump_effects(study);
  for (const effects::Effect* effect : added) {
    candidate.effects = *candidate.effects.with(effects::with_amplitude(*effect, 0.0));
    for (std::size_t k = 0; k < effect->parameters.size(); ++k) {
      if (effect->parameters[k].searched()) free.push_back({effect, k});
    }
  }
  candidate.tests = calibration::slump_experiments(study, basis.simulate, basis.error, basis.corrections,
                                                   candidate.effects, free);
  const calibration::Experiments all(candidate.tests.begin(), candidate.tests.end());
  candidate.problem = std::make_shared<calibration::Problem>(
      all,
      calibration::Parametrisation(basis.start, study.fit.slump,
                                   {study.fit.bounds, basis.priors, study.fit.slump_effects},
                                   calibration::GaugeChoice{}, all),
      basis.threads);
  return candidate;
}

std::vector<double> continued(const SlumpCandidate& candidate, const std::vector<double>& base,
                              double amplitude) {
  std::vector<double> x = candidate.problem->parametrisation().start();
  std::copy(base.begin(), base.end(), x.begin());
  const auto& coordinates = candidate.problem->parametrisation().coordinates();
  for (std::size_t k = base.size(); k < x.size(); ++k) {
    if (coordinates[k].effect->index == 0) x[k] = amplitude;
  }
  return x;
}

std::vector<std::pair<Eigen::Index, Eigen::Index>> rows_of(const calibration::Problem& problem) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;
  Eigen::Index first = 0;
  for (const auto& test : problem.fitted()) {
    const auto count = static_cast<Eigen::Index>(test->measured().size());
    rows.emplace_back(first, count);
    first += count;
  }
  return rows;
}

void conclude(SlumpCandidate& candidate, const Eigen::VectorXd& as_read) {
  const calibration::Problem& problem = *candidate.problem;
  const std::vector<double>& x = candidate.at.coordinates;
  candidate.parameters = *problem.parametrisation().at(x);
  const experiments::SlumpExperiment& any = *candidate.tests.front();  // all tests share effects
  candidate.effects = any.effects_at(problem.parametrisation().local_of(any, x)).value();
  const auto& coordinates = problem.parametrisation().coordinates();
  candidate.at_bound = false;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    if (!coordinates[k].effect) continue;
    const effects::ParameterRef parameter = *coordinates[k].effect;
    const bool added =
        std::find(candidate.added.begin(), candidate.added.end(), parameter.effect) != candidate.added.end();
    constexpr double kNear = 0.02;  // typical values: what simulations cannot tell from none
    if (added && parameter.index == 0 &&
        (std::abs(x[k]) < kNear || x[k] > coordinates[k].upper - kNear ||
         x[k] < coordinates[k].lower + kNear)) {
      candidate.at_bound = true;
    }
  }
  candidate.chi_squared = candidate.at.residuals.squaredNorm();
  candidate.gaps.clear();
  double squares = 0.0;
  for (const auto& [first, count] : rows_of(problem)) {
    const double sum = as_read.segment(first, count).squaredNorm();
    candidate.gaps.push_back(std::sqrt(sum / static_cast<double>(count)));
    squares += sum;
  }
  candidate.gap = std::sqrt(squares / static_cast<double>(problem.value_count()));
}

double left_out_density(const SlumpCandidate& candidate, double variance) {
  const Eigen::MatrixXd& J = candidate.at.jacobian;
  const Eigen::VectorXd& r = candidate.at.residuals;
  const Eigen::MatrixXd all = J.transpose() * J;
  const Eigen::VectorXd slope = J.transpose() * r;
  double sum = 0.0;
  for (const auto& [first, count] : rows_of(*candidate.problem)) {
    const Eigen::MatrixXd own = J.middleRows(first, count);
    Eigen::MatrixXd information = all - own.transpose() * own;
    // what the others do not see is not known: a weak hold, far beyond what any parameter may do
    information.diagonal().array() += 1e-6 * all.diagonal().maxCoeff();
    const Eigen::LDLT<Eigen::MatrixXd> others(information);
    const Eigen::VectorXd step = -others.solve(slope - own.transpose() * r.segment(first, count));
    const Eigen::VectorXd missed = r.segment(first, count) + own * step;
    const Eigen::MatrixXd covariance =
        variance * (Eigen::MatrixXd::Identity(count, count) + own * others.solve(own.transpose()));
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::MatrixXd lower = factor.matrixL();
    sum -= 0.5 * missed.dot(factor.solve(missed)) + lower.diagonal().array().log().sum();
  }
  return sum;
}

}  // namespace isotach::discovery
