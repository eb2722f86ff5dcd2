// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/slump_visibility.hpp"

#include <algorithm>
#include <cmath>

namespace isotach::bench {

using model::ParameterId;

std::optional<SlumpVisibility> SlumpVisibility::at(const std::array<SlumpGenerator, 2>& numerics,
                                                   const calibration::SimulationError& error,
                                                   const KnownBeforehand& known) {
  std::vector<View> views;
  for (const SlumpGenerator& generator : numerics) {
    auto view = view_of(generator, error, known);
    if (!view) return std::nullopt;
    views.push_back(std::move(*view));
  }
  return SlumpVisibility(std::move(views), error);
}

std::optional<SlumpVisibility::View> SlumpVisibility::view_of(const SlumpGenerator& generator,
                                                              const calibration::SimulationError& error,
                                                              const KnownBeforehand& known) {
  auto unchanged = generator.seen({}, generator.truth(), error);
  if (!unchanged) return std::nullopt;
  const Eigen::MatrixXd shared = calibration::directions_of(error, generator.experiments({}, error));
  const Eigen::Index rows = unchanged->size();
  // with rows that say how far each column may go: one standard error of what is known
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows + 2 + shared.cols(), 2 + shared.cols());
  for (Eigen::Index k = 0; k < 2; ++k) {
    model::ParameterValues<double> moved = generator.truth().values();
    if (k == 0) {
      moved[ParameterId::I_v] *= std::exp(known.viscosity);
    } else {
      moved[ParameterId::C_1] += known.c1;
    }
    const auto there = generator.seen({}, *model::Parameters<double>::create(moved), error);
    if (!there) return std::nullopt;
    columns.col(k).head(rows) = *there - *unchanged;
  }
  if (shared.cols() > 0) columns.topRightCorner(rows, shared.cols()) = shared;
  columns.bottomRows(columns.cols()).setIdentity();
  return View{generator, std::move(*unchanged), columns.rows(), discovery::Projection(columns)};
}

std::optional<SlumpVisibility::Shown> SlumpVisibility::of(const effects::Values<double>& effects) const {
  std::array<Eigen::VectorXd, 2> left;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const View& view = views_[k];
    const auto there = view.generator.seen(effects, view.generator.truth(), error_);
    if (!there) return std::nullopt;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(view.rows);
    change.head(there->size()) = *there - view.unchanged;
    left[k] = view.base.freed(change);
  }
  return Shown{std::sqrt(std::max(left[0].dot(left[1]), kLeast * kLeast)),
               0.5 * (left[0] + left[1]).head(views_[0].unchanged.size())};
}

}  // namespace isotach::bench
