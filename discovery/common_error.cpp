// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/common_error.hpp"

#include <Eigen/SVD>

#include "calibration/parallel.hpp"
#include "datasets/slump_effects.hpp"

namespace isotach::discovery {

CommonError::CommonError(const Eigen::MatrixXd& directions) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(directions, Eigen::ComputeThinU);
  basis_ = svd.matrixU();
  sizes_ = svd.singularValues();
}

Eigen::MatrixXd CommonError::whitened(Eigen::MatrixXd residuals) const {
  if (sizes_.size() == 0) return residuals;
  const Eigen::VectorXd factors = (1.0 + sizes_.array().square()).rsqrt() - 1.0;
  auto values = residuals.topRows(basis_.rows());
  const Eigen::MatrixXd parts = basis_.transpose() * values;
  values += basis_ * (factors.asDiagonal() * parts);
  return residuals;
}

Eigen::MatrixXd CommonError::as_read(Eigen::MatrixXd whitened) const {
  if (sizes_.size() == 0) return whitened;
  const Eigen::VectorXd factors = (1.0 + sizes_.array().square()).sqrt() - 1.0;
  auto values = whitened.topRows(basis_.rows());
  const Eigen::MatrixXd parts = basis_.transpose() * values;
  values += basis_ * (factors.asDiagonal() * parts);
  return whitened;
}

tl::expected<CommonError, calibration::FitFailure> common_error(const SlumpBasis& basis,
                                                                const SlumpTests& tests) {
  SlumpTests fitted;
  Eigen::Index rows = 0;
  for (const auto& test : tests) {
    if (test->held_out()) continue;
    fitted.push_back(test);
    rows += static_cast<Eigen::Index>(test->measured().size());
  }
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
  std::vector<const std::vector<std::optional<mpm::SlumpResult>>*> variants{&other};
  for (const calibration::NumericalVariant& variant : basis.error.variants) variants.push_back(&variant.runs);
  std::vector<Eigen::VectorXd> columns;
  for (const auto* runs : variants) {
    Eigen::VectorXd column(rows);
    Eigen::Index row = 0;
    bool all = runs->size() == fitted.size();
    for (std::size_t i = 0; all && i < fitted.size(); ++i) {
      all = (*runs)[i].has_value() && basis.error.runs[i].has_value();
      if (!all) break;
      const auto there = fitted[i]->decorrelated(fitted[i]->distances(*(*runs)[i]));
      const auto here = fitted[i]->decorrelated(fitted[i]->distances(*basis.error.runs[i]));
      for (std::size_t k = 0; k < there.size(); ++k) column[row++] = there[k] - here[k];
    }
    if (all) columns.push_back(std::move(column));
  }
  Eigen::MatrixXd directions(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) directions.col(static_cast<Eigen::Index>(k)) = columns[k];
  return columns.empty() ? CommonError() : CommonError(directions);
}

}  // namespace isotach::discovery
