// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/restricted_likelihood.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "calibration/serial_filter.hpp"

namespace isotach::calibration {

namespace {

constexpr double kNullEigenvalue = 1e-12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

/// Directions that a symmetric positive matrix sees: scaling each coordinate to a unit diagonal, the columns
/// of `basis` make it the unit matrix, basis' matrix basis = 1.
struct SeenSpace {
  Eigen::MatrixXd basis;
  double log_determinant = 0.0;  ///< of the matrix, but for the eigenvalues left out
};

SeenSpace seen_space(const Eigen::MatrixXd& matrix) {
  const Eigen::Index p = matrix.rows();
  SeenSpace seen;
  if (p == 0) {
    seen.basis.resize(0, 0);
    return seen;
  }
  Eigen::VectorXd scale(p);
  for (Eigen::Index k = 0; k < p; ++k) {
    scale[k] = matrix(k, k) > 0.0 ? 1.0 / std::sqrt(matrix(k, k)) : 0.0;
    if (scale[k] > 0.0) seen.log_determinant += std::log(matrix(k, k));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * matrix *
                                                              scale.asDiagonal());
  const Eigen::VectorXd& eigenvalues = solver.eigenvalues();  // increasing
  Eigen::Index null = 0;
  while (null < p && !(eigenvalues[null] > kNullEigenvalue * eigenvalues[p - 1])) ++null;
  seen.basis.resize(p, p - null);
  for (Eigen::Index k = null; k < p; ++k) {
    seen.basis.col(k - null) = scale.cwiseProduct(solver.eigenvectors().col(k)) / std::sqrt(eigenvalues[k]);
    seen.log_determinant += std::log(eigenvalues[k]);
  }
  return seen;
}

}  // namespace

void require_consistent_noise(const Channel& channel, Eigen::Index count) {
  require(count > 0, "a channel without values");
  require(channel.known_variance.size() == count, "known_variance has another size than the channel");
  require(channel.known_variance.allFinite() && channel.known_variance.minCoeff() >= 0.0,
          "known_variance is negative or not finite");
  require(channel.inverse_stress.size() == 0 || channel.inverse_stress.size() == count,
          "inverse_stress has another size than the channel");
  require(channel.inverse_stress.size() == 0 ||
              (channel.inverse_stress.allFinite() && channel.inverse_stress.minCoeff() > 0.0),
          "inverse_stress is not positive and finite");
  const auto& starts = channel.chain_starts;
  require(!starts.empty() && starts.front() == 0 && starts.back() < static_cast<std::size_t>(count) &&
              std::adjacent_find(starts.begin(), starts.end(), std::greater_equal<>()) == starts.end(),
          "chain_starts do not begin with 0 and increase below the number of values");
}

RestrictedLikelihood::RestrictedLikelihood(const Channel& channel, const Eigen::MatrixXd& other_information,
                                           const Eigen::VectorXd& other_gradient, const NoiseModel& start)
    : channel_(channel), inverse_stress2_(channel.inverse_stress.array().square()) {
  const Eigen::Index n = channel.residuals.size();
  const Eigen::Index p = channel.jacobian.cols();
  require_consistent_noise(channel, n);
  require(channel.residuals.allFinite(), "residuals are not finite");
  require(channel.jacobian.rows() == n && channel.jacobian.allFinite(),
          "jacobian has another size than the channel, or is not finite");
  require(other_information.rows() == p && other_information.cols() == p && other_information.allFinite(),
          "other_information has another size than the coordinates, or is not finite");
  require(other_gradient.size() == p && other_gradient.allFinite(),
          "other_gradient has another size than the coordinates, or is not finite");

  const Eigen::MatrixXd unweighted = channel.jacobian.transpose() * channel.jacobian;
  require(n > seen_space(unweighted).basis.cols(),
          "a channel of " + std::to_string(n) + " values has no more than the coordinates it sees");
  correlated_ = static_cast<double>(n - static_cast<Eigen::Index>(channel.chain_starts.size()));

  // the null directions are of the geometry, so any noise will do to find them; but what a channel sees has
  // to be weighed against what the others see
  Channel own = channel;
  NoiseModel noise = start;
  if (noise.level == 0.0 && (noise.floor == 0.0 || own.inverse_stress.size() == 0)) {
    noise.level = std::sqrt(own.residuals.squaredNorm() / static_cast<double>(n));
    require(noise.level > 0.0, "residuals are all zero and the start has no noise either");
  }
  Whitening(noise, own).whiten(own.jacobian);
  reduce(own.jacobian.transpose() * own.jacobian + other_information, other_information, other_gradient);

  const Eigen::Index columns = values_.cols();
  variance_.resize(n);
  weight_.resize(n);
  scaled_.resize(n, columns);
  for (Eigen::MatrixXd* matrix : {&products_, &neighbours_, &ends_, &factor_}) {
    matrix->resize(columns, columns);
  }
}

void RestrictedLikelihood::reduce(const Eigen::MatrixXd& information,
                                  const Eigen::MatrixXd& other_information,
                                  const Eigen::VectorXd& other_gradient) {
  const SeenSpace seen = seen_space(information);
  change_of_variables_ = seen.log_determinant;
  const Eigen::Index r = seen.basis.cols();
  values_.resize(channel_.residuals.size(), r + 1);
  values_.leftCols(r) = channel_.jacobian * seen.basis;
  values_.col(r) = channel_.residuals;
  other_ = Eigen::MatrixXd::Zero(r + 1, r + 1);
  other_.topLeftCorner(r, r) = seen.basis.transpose() * other_information * seen.basis;
  other_.col(r).head(r) = seen.basis.transpose() * other_gradient;
  other_.row(r).head(r) = other_.col(r).head(r).transpose();
}

double RestrictedLikelihood::at_rho(double rho) {
  // whitened: the products of (u_i - rho u_{i-1})/sqrt(1 - rho^2), written out
  const double innovation = 1.0 - rho * rho;
  factor_ = other_ + ((1.0 + rho * rho) * products_ - rho * neighbours_ - rho * rho * ends_) / innovation;
  return reduced(log_variances_ + correlated_ * std::log(innovation));
}

double RestrictedLikelihood::at(double level, double floor, double rho, double share) {
  if (!scale(level, floor)) return kInfinity;
  const SerialFilter filter(rho, share, scaled_.rows(), channel_.chain_starts);
  white_ = scaled_;
  filter.apply(white_);
  factor_ = other_;
  factor_.noalias() += white_.transpose() * white_;
  return reduced(log_variances_ + filter.log_determinant());
}

double RestrictedLikelihood::reduced(double log_determinant) {
  // Cholesky of [A b; b' c] in place: ln det A, and c - b' A^-1 b is what is left in the corner
  const Eigen::Index last = factor_.cols() - 1;
  log_determinant += change_of_variables_;
  for (Eigen::Index k = 0; k < last; ++k) {
    const double pivot = factor_(k, k);
    if (!(pivot > 0.0)) return kInfinity;
    log_determinant += std::log(pivot);
    for (Eigen::Index j = k + 1; j <= last; ++j) {
      const double ratio = factor_(j, k) / pivot;
      for (Eigen::Index i = j; i <= last; ++i) factor_(i, j) -= ratio * factor_(i, k);
    }
  }
  return log_determinant + factor_(last, last);
}

bool RestrictedLikelihood::scale(double level, double floor) {
  variance_ = channel_.known_variance.array() + level * level;
  if (inverse_stress2_.size() > 0) variance_ += floor * floor * inverse_stress2_;
  if (!(variance_.minCoeff() > 0.0)) return false;
  log_variances_ = variance_.log().sum();
  weight_ = variance_.rsqrt();
  scaled_ = values_.array().colwise() * weight_;
  return true;
}

RestrictedLikelihood::Profile RestrictedLikelihood::at(double level, double floor) {
  if (!scale(level, floor)) return {kInfinity, 0.0};
  const Eigen::Index n = scaled_.rows();
  const Eigen::Index columns = scaled_.cols();
  for (Eigen::Index a = 0; a < columns; ++a) {
    const auto u = scaled_.col(a);
    for (Eigen::Index b = 0; b <= a; ++b) {
      const auto v = scaled_.col(b);
      double product = u.dot(v);
      double neighbour = u.tail(n - 1).dot(v.head(n - 1)) + u.head(n - 1).dot(v.tail(n - 1));
      double end = u[n - 1] * v[n - 1] + u[0] * v[0];
      for (std::size_t chain = 1; chain < channel_.chain_starts.size(); ++chain) {
        const auto first = static_cast<Eigen::Index>(channel_.chain_starts[chain]);
        neighbour -= u[first] * v[first - 1] + u[first - 1] * v[first];
        end += u[first] * v[first] + u[first - 1] * v[first - 1];
      }
      products_(a, b) = products_(b, a) = product;
      neighbours_(a, b) = neighbours_(b, a) = neighbour;
      ends_(a, b) = ends_(b, a) = end;
    }
  }

  // the whole range first: the likelihood of few values can have two maxima in rho
  constexpr std::array kGrid{0.0, 0.25, 0.5, 0.7, 0.85, 0.93, 0.97, kLargestRho};
  if (correlated_ == 0.0) return {at_rho(0.0), 0.0};
  std::size_t best = 0;
  double best_value = kInfinity;
  for (std::size_t k = 0; k < kGrid.size(); ++k) {
    const double value = at_rho(kGrid[k]);
    if (value < best_value) {
      best = k;
      best_value = value;
    }
  }
  const double low = kGrid[best == 0 ? 0 : best - 1];
  const double high = kGrid[std::min(best + 1, kGrid.size() - 1)];
  constexpr int kBits = 26;  // half of a double's: a minimum is known no better
  const auto [rho, value] =
      boost::math::tools::brent_find_minima([this](double trial) { return at_rho(trial); }, low, high, kBits);
  if (value < best_value) return {value, rho};
  return {best_value, kGrid[best]};
}

}  // namespace isotach::calibration
