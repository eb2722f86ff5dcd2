// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/common_error.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <iterator>

#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"

namespace isotach::discovery {

CommonError::CommonError(const Eigen::MatrixXd& directions) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(directions, Eigen::ComputeThinU);
  basis_ = svd.matrixU();
  sizes_ = svd.singularValues();
}

Eigen::MatrixXd CommonError::scaled(Eigen::MatrixXd residuals, double power) const {
  if (sizes_.size() == 0) return residuals;
  const Eigen::VectorXd factors = (1.0 + sizes_.array().square()).pow(power) - 1.0;
  auto values = residuals.topRows(basis_.rows());
  const Eigen::MatrixXd parts = basis_.transpose() * values;
  values += basis_ * (factors.asDiagonal() * parts);
  return residuals;
}

namespace {

/// The tests by the scheme of transfer that the study does not use.
tl::expected<std::vector<std::optional<mpm::SlumpResult>>, calibration::FitFailure> by_other_scheme(
    const SlumpBasis& basis, const SlumpTests& fitted) {
  std::vector<std::optional<mpm::SlumpResult>> other(fitted.size());
  std::vector<mpm::RunStatus> statuses(fitted.size(), mpm::RunStatus::ok);
  calibration::parallel_for(fitted.size(), basis.threads, [&](std::size_t i) {
    mpm::SlumpSetup setup = datasets::with_effects(fitted[i]->test().setup, basis.study.effects);
    mpm::Scheme& scheme = setup.numerics.scheme;
    scheme = scheme == mpm::Scheme::plain ? mpm::Scheme::conserving : mpm::Scheme::plain;
    auto run = basis.simulate(fitted[i]->name(), basis.start, setup);
    if (run) {
      other[i] = std::move(*run);
    } else {
      statuses[i] = run.error().status;
    }
  });
  for (const mpm::RunStatus status : statuses) {
    if (status == mpm::RunStatus::interrupted) {
      return tl::unexpected(calibration::FitFailure{"interrupted", true});
    }
  }
  return other;
}

}  // namespace

tl::expected<CommonError, calibration::FitFailure> common_error(const SlumpBasis& basis,
                                                                const SlumpTests& tests) {
  SlumpTests fitted;
  std::copy_if(tests.begin(), tests.end(), std::back_inserter(fitted),
               [](const auto& test) { return !test->held_out(); });
  std::vector<const std::vector<std::optional<mpm::SlumpResult>>*> variants;
  for (const calibration::NumericalVariant& variant : basis.error.variants) variants.push_back(&variant.runs);
  std::vector<std::optional<mpm::SlumpResult>> other;
  if (!calibration::has_reference(basis.study)) {
    auto runs = by_other_scheme(basis, fitted);
    if (!runs) return tl::unexpected(runs.error());
    other = std::move(*runs);
    variants.push_back(&other);
  }
  const auto all_ran = [](const std::vector<std::optional<mpm::SlumpResult>>& runs) {
    return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.has_value(); });
  };
  std::vector<Eigen::VectorXd> columns;
  for (const auto* runs : variants) {
    if (!all_ran(basis.error.runs) || !all_ran(*runs)) continue;
    columns.push_back(calibration::stacked_change(fitted, basis.error.runs, *runs));
  }
  if (columns.empty()) return CommonError();
  Eigen::MatrixXd directions(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) directions.col(static_cast<Eigen::Index>(k)) = columns[k];
  return CommonError(directions);
}

}  // namespace isotach::discovery
