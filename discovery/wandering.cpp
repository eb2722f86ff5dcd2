// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "discovery/wandering.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/distributions.hpp"
#include "discovery/limits.hpp"
#include "discovery/noise_replicates.hpp"

namespace isotach::discovery {

namespace {

constexpr unsigned kWanderSeed = 2;
constexpr double kNoDeviate = -std::numeric_limits<double>::infinity();

/// A chi-squared as a standard normal deviate.
double deviate(double squares, Eigen::Index degrees) {
  const double spread = 2.0 / (9.0 * static_cast<double>(degrees));
  return (std::cbrt(squares / static_cast<double>(degrees)) - (1.0 - spread)) / std::sqrt(spread);
}

/// How far the slot that stands out most does under noise, sorted.
std::vector<double> most_under_noise(const std::vector<WanderTrial>& trials) {
  Eigen::Index columns = 0;
  for (const WanderTrial& one : trials) columns += one.basis.cols();
  if (columns == 0) return {};
  Eigen::MatrixXd all(trials.front().basis.rows(), columns);
  Eigen::Index next = 0;
  for (const WanderTrial& one : trials) {
    all.middleCols(next, one.basis.cols()) = one.basis;
    next += one.basis.cols();
  }
  std::vector<double> most;
  for_noise_along(all, kWanderSeed, [&](const Eigen::VectorXd& z) {
    most.push_back(kNoDeviate);
    next = 0;
    for (const WanderTrial& one : trials) {
      const Eigen::Index rank = one.basis.cols();
      if (rank == 0) continue;
      most.back() = std::max(most.back(), deviate(z.segment(next, rank).squaredNorm(), rank));
      next += rank;
    }
  });
  std::sort(most.begin(), most.end());
  return most;
}

}  // namespace

std::string WanderedSlot::title() const {
  return fmt::format("{} over {}", name, along->words);
}

WanderTrial try_slot(const WanderedSlot& slot, const Eigen::MatrixXd& left, double plausible,
                     const Eigen::VectorXd& residuals) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(left, Eigen::ComputeThinU | Eigen::ComputeThinV);
  // of a direction, what it shows where its largest knot is of plausible size
  const Eigen::VectorXd shows =
      svd.singularValues().cwiseQuotient(svd.matrixV().cwiseAbs().colwise().maxCoeff().transpose());
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < shows.size(); ++k) {
    if (shows[k] >= kWanderShows) kept.push_back(k);
  }
  const auto rank = static_cast<Eigen::Index>(kept.size());
  const Eigen::MatrixXd inverse =
      svd.matrixV()(Eigen::all, kept) * svd.singularValues()(kept).cwiseInverse().asDiagonal() * plausible;
  WanderTrial trial{{slot, static_cast<std::size_t>(rank), 0.0, 1.0, kNoDeviate, {}, {}},
                    {},
                    inverse.rowwise().norm(),
                    svd.matrixU()(Eigen::all, kept)};
  const Eigen::VectorXd along = -trial.basis.transpose() * residuals;
  trial.change = inverse * along;
  trial.slot.gain = along.squaredNorm();
  if (rank > 0) {
    trial.slot.p_value = calibration::chi_squared_survival(trial.slot.gain, static_cast<double>(rank));
    trial.slot.stands_out = deviate(trial.slot.gain, rank);
  }
  return trial;
}

Wandering ranked(std::vector<WanderTrial> trials) {
  const std::vector<double> null = most_under_noise(trials);
  Wandering found;
  for (WanderTrial& one : trials) found.slots.push_back(std::move(one.slot));
  std::stable_sort(found.slots.begin(), found.slots.end(),
                   [](const auto& a, const auto& b) { return a.stands_out > b.stands_out; });
  if (found.slots.empty() || null.empty()) return found;
  const auto above = null.end() - std::lower_bound(null.begin(), null.end(), found.slots.front().stands_out);
  found.p_value = replicated_p(above, null.size());
  return found;
}

}  // namespace isotach::discovery
