// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Estimated noise against closed forms, a dense restatement of the likelihood, and simulations.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "calibration/noise_model.hpp"

namespace isotach::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A straight line (p = 2) through n values of noise still to be given.
Channel line(Index n) {
  Channel channel;
  channel.residuals.setZero(n);
  channel.jacobian.setOnes(n, 2);
  channel.jacobian.col(1).setLinSpaced(n, -1.0, 1.0);
  channel.known_variance.setZero(n);
  channel.chain_starts = {0};
  return channel;
}

/// What is left of a channel's residuals by ordinary least squares.
VectorXd left_over(const Channel& channel) {
  return channel.residuals - channel.jacobian * channel.jacobian.householderQr().solve(channel.residuals);
}

NoiseModel estimate_alone(const Channel& channel, const NoiseModel& start) {
  const Index p = channel.jacobian.cols();
  return estimate_noise(channel, MatrixXd::Zero(p, p), VectorXd::Zero(p), start);
}

/// The covariance a model makes, entry by entry.
MatrixXd covariance(const NoiseModel& model, const Channel& channel) {
  const Index n = channel.known_variance.size();
  MatrixXd S = MatrixXd::Zero(n, n);
  const auto sd = [&](Index i) {
    const double stress = channel.inverse_stress.size() > 0 ? channel.inverse_stress[i] : 0.0;
    return std::sqrt(std::pow(model.level, 2) + std::pow(model.floor * stress, 2) +
                     channel.known_variance[i]);
  };
  const auto chain = [&](Index i) {
    std::size_t k = 0;
    while (k + 1 < channel.chain_starts.size() && static_cast<Index>(channel.chain_starts[k + 1]) <= i) {
      ++k;
    }
    return k;
  };
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      if (chain(i) != chain(j)) continue;
      S(i, j) = sd(i) * sd(j) * (i == j ? 1.0 : model.serial_share * std::pow(model.rho, std::abs(i - j)));
    }
  }
  return S;
}

/// The restricted likelihood in dense matrices, as the header states it.
double dense_likelihood(const NoiseModel& model, const Channel& channel, const MatrixXd& H,
                        const VectorXd& g) {
  const MatrixXd S = covariance(model, channel);
  const MatrixXd inverse = S.inverse();
  const MatrixXd A = channel.jacobian.transpose() * inverse * channel.jacobian + H;
  const VectorXd b = channel.jacobian.transpose() * inverse * channel.residuals + g;
  const double Q = channel.residuals.dot(inverse * channel.residuals) - b.dot(A.inverse() * b);
  const double log_determinant = S.ldlt().vectorD().array().log().sum();
  return -0.5 * (log_determinant + std::log(A.determinant()) + Q);
}

/// Values of the noise of a model, from normal ones.
VectorXd draw(const NoiseModel& model, const Channel& channel, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  VectorXd values(channel.known_variance.size());
  double lasting = 0.0;
  for (Index i = 0; i < values.size(); ++i) {
    const bool first =
        std::find(channel.chain_starts.begin(), channel.chain_starts.end(), i) != channel.chain_starts.end();
    const double fresh = normal(generator);
    lasting = first ? fresh : model.rho * lasting + std::sqrt(1.0 - model.rho * model.rho) * fresh;
    values[i] = std::sqrt(model.serial_share) * lasting;
    if (model.serial_share < 1.0) values[i] += std::sqrt(1.0 - model.serial_share) * normal(generator);
  }
  const Whitening whitening(model, channel);
  return values.cwiseProduct(whitening.sd());
}

// Closed form: about a straight line the variance RSS/(n - 2). Alternating noise has no positive rho.
TEST(NoiseModel, IsTheUnbiasedVarianceAboutALine) {
  Channel channel = line(12);
  for (Index i = 0; i < 12; ++i) channel.residuals[i] = (i % 2 == 0 ? 1.0 : -1.0) * (3.0 + double(i * i % 5));
  const VectorXd rest = left_over(channel);
  for (const double start : {1e-3, 1.0, 1e3}) {
    const auto noise = estimate_alone(channel, {start, 0.0, 0.0, 0.0, 0.0});
    EXPECT_NEAR(noise.level, std::sqrt(rest.squaredNorm() / 10.0), 1e-7 * noise.level);
    EXPECT_EQ(noise.floor, 0.0);
    EXPECT_EQ(noise.rho, 0.0);
    EXPECT_DOUBLE_EQ(noise.effective_count, 12.0);
  }
}

// A column twice is a direction that nothing sees; what is fitted are still two numbers. Where the others
// hold the coordinates firmly, the channel loses none: level^2 = r'r/n.
TEST(NoiseModel, CountsOnlyWhatTheChannelDetermines) {
  Channel channel = line(12);
  for (Index i = 0; i < 12; ++i) channel.residuals[i] = (i % 2 == 0 ? 1.0 : -1.0) * (3.0 + double(i * i % 5));
  const MatrixXd firm = 1e12 * MatrixXd::Identity(2, 2);
  const auto held = estimate_noise(channel, firm, VectorXd::Zero(2), {1.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(held.level, channel.residuals.norm() / std::sqrt(12.0), 1e-7 * held.level);

  const auto plain = estimate_alone(channel, {1.0, 0.0, 0.0, 0.0, 0.0});
  channel.jacobian.conservativeResize(Eigen::NoChange, 4);
  channel.jacobian.col(2) = 7.0 * channel.jacobian.col(1) - channel.jacobian.col(0);
  channel.jacobian.col(3).setZero();
  const auto doubled = estimate_alone(channel, {1.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(doubled.level, plain.level, 1e-7 * plain.level);
}

// Everything at once: floor, known variance, three chains, another channel's information; the likelihood is
// that of the dense formula, and no neighbour is better.
TEST(NoiseModel, MaximisesTheLikelihoodOfTheDenseFormula) {
  std::mt19937_64 generator(7);
  Channel channel = line(60);
  channel.inverse_stress = (-VectorXd::LinSpaced(60, std::log(2e3), std::log(4e5))).array().exp();
  channel.known_variance.setLinSpaced(60, 1e-6, 4e-5);
  channel.chain_starts = {0, 20, 21};
  channel.residuals = draw({0.01, 60.0, 0.5, 0.0, 0.0}, channel, generator);
  MatrixXd H(2, 2);
  H << 3e4, 1e4, 1e4, 5e4;
  const VectorXd g = VectorXd::Constant(2, 30.0);
  const auto noise = estimate_noise(channel, H, g, {0.03, 20.0, 0.1, 0.0, 0.0});
  EXPECT_GT(noise.level, 0.0);
  EXPECT_GT(noise.floor, 0.0);
  EXPECT_GT(noise.rho, 0.0);
  const double best = dense_likelihood(noise, channel, H, g);
  EXPECT_NEAR(noise.log_likelihood, best, 1e-8 * std::abs(best));
  for (const double factor : {0.98, 1.02}) {
    for (double NoiseModel::*part : {&NoiseModel::level, &NoiseModel::floor, &NoiseModel::rho}) {
      NoiseModel other = noise;
      other.*part *= factor;
      EXPECT_LT(dense_likelihood(other, channel, H, g), best) << factor;
    }
  }
  const VectorXd ones = VectorXd::Ones(60);
  NoiseModel unit{1.0, 0.0, noise.rho, 0.0, 0.0};
  channel.known_variance.setZero();
  EXPECT_NEAR(noise.effective_count, ones.dot(covariance(unit, channel).inverse() * ones), 1e-9);
}

// The same where part of the noise is white, which no other than the split model makes as likely.
TEST(NoiseModel, MaximisesTheLikelihoodOfTheSumOfItsParts) {
  std::mt19937_64 generator(7);
  Channel channel = line(300);
  channel.inverse_stress = (-VectorXd::LinSpaced(300, std::log(2e3), std::log(4e5))).array().exp();
  channel.known_variance.setLinSpaced(300, 1e-6, 4e-6);
  channel.chain_starts = {0, 140, 141};
  channel.residuals = draw({0.01, 60.0, 0.8, 0.0, 0.0, 0.5}, channel, generator);
  MatrixXd H(2, 2);
  H << 3e4, 1e4, 1e4, 5e4;
  const VectorXd g = VectorXd::Constant(2, 30.0);
  const auto noise = estimate_noise(channel, H, g, {0.03, 20.0, 0.1, 0.0, 0.0});
  EXPECT_GT(noise.floor, 0.0);
  EXPECT_LT(noise.serial_share, 0.9);
  const double best = dense_likelihood(noise, channel, H, g);
  EXPECT_NEAR(noise.log_likelihood, best, 1e-8 * std::abs(best));
  for (const double factor : {0.98, 1.02}) {
    for (double NoiseModel::*part :
         {&NoiseModel::level, &NoiseModel::floor, &NoiseModel::rho, &NoiseModel::serial_share}) {
      NoiseModel other = noise;
      other.*part *= factor;
      EXPECT_LT(dense_likelihood(other, channel, H, g), best) << factor;
    }
  }
  EXPECT_DOUBLE_EQ(noise.neighbours(), noise.rho * noise.serial_share);
  const NoiseModel unit{1.0, 0.0, noise.rho, 0.0, 0.0, noise.serial_share};
  channel.known_variance.setZero();
  const VectorXd ones = VectorXd::Ones(300);
  EXPECT_NEAR(noise.effective_count, ones.dot(covariance(unit, channel).inverse() * ones), 1e-9);
}

// Theory: the errors of ln level, rho and share by their information 1/2 tr(S^-1 S_a S^-1 S_b), S_a the
// derivative of the dense covariance; tolerances as for the autoregression, the spread's a little wider since
// the likelihood of 500 values is not quite a parabola in three numbers.
TEST(NoiseModel, RecoversThePartThatLastsAndTheWhiteOne) {
  constexpr int kSeries = 100;
  constexpr Index kCount = 500;
  const NoiseModel truth{0.02, 0.0, 0.8, 0.0, 0.0, 0.5};
  std::mt19937_64 generator(23);
  Channel channel = line(kCount);
  const MatrixXd inverse = covariance(truth, channel).inverse();
  std::vector<MatrixXd> slopes;
  constexpr double kStep = 1e-4;
  for (double NoiseModel::*part : {&NoiseModel::level, &NoiseModel::rho, &NoiseModel::serial_share}) {
    NoiseModel up = truth;
    NoiseModel down = truth;
    const double step = part == &NoiseModel::level ? kStep * truth.level : kStep;
    up.*part += step;
    down.*part -= step;
    slopes.emplace_back(inverse * (covariance(up, channel) - covariance(down, channel)) / (2.0 * kStep));
  }
  Eigen::Matrix3d information;
  for (Index a = 0; a < 3; ++a) {
    for (Index b = 0; b < 3; ++b) {
      information(a, b) = 0.5 * slopes[static_cast<std::size_t>(a)]
                                    .cwiseProduct(slopes[static_cast<std::size_t>(b)].transpose())
                                    .sum();
    }
  }
  const Eigen::Vector3d error = information.inverse().diagonal().cwiseSqrt();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (int series = 0; series < kSeries; ++series) {
    channel.residuals = draw(truth, channel, generator);
    const auto noise = estimate_alone(channel, {0.005, 0.0, 0.0, 0.0, 0.0});
    EXPECT_LE(noise.rho, kLargestSplitRho);
    const Eigen::Vector3d miss(std::log(noise.level / truth.level), noise.rho - truth.rho,
                               noise.serial_share - truth.serial_share);
    mean += miss / kSeries;
    square += miss.cwiseAbs2() / kSeries;
  }
  for (Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 0.0, 4.0 * error[k] / std::sqrt(kSeries) + 5.0 / kCount) << k;
    EXPECT_NEAR(std::sqrt(square[k]) / error[k], 1.0, 0.35) << k;
  }
}

/// Mean square of what residuals make of a slow signature, both whitened by their estimated noise: 1 where
/// the noise is described well, more where names would follow from noise.
struct SlowSignature {
  double mean_square = 0.0;
  double splits = 0.0;  ///< share of series in which a white part was found
};
SlowSignature slow_signature(const NoiseModel& truth, int series) {
  std::mt19937_64 generator(29);
  Channel channel = line(200);
  SlowSignature found;
  for (int k = 0; k < series; ++k) {
    channel.residuals = draw(truth, channel, generator);
    const auto noise = estimate_alone(channel, {0.005, 0.0, 0.0, 0.0, 0.0});
    if (noise.serial_share < 1.0) found.splits += 1.0 / series;
    MatrixXd all(200, 4);  // line, signature, residuals
    all << channel.jacobian, (3.0 * channel.jacobian.col(1)).array().sin().matrix(), channel.residuals;
    Whitening(noise, channel).whiten(all);
    const Eigen::HouseholderQR<MatrixXd> qr(all.leftCols(3));
    const VectorXd turned = qr.householderQ().transpose() * all.col(3);
    found.mean_square += turned[2] * turned[2] / series;  // along what the line leaves of the signature
  }
  return found;
}

// The mean of N squares of normal values is 1 within 4 sqrt(2/N); what estimating the noise adds or takes is
// of order 1/(independent values), 40 here. Whitened by an autoregression alone this mean square is 1.9.
TEST(NoiseModel, NoiseOfTwoPartsDoesNotPassForASlowSignature) {
  constexpr int kSeries = 400;
  const auto found = slow_signature({0.02, 0.0, 0.8, 0.0, 0.0, 0.5}, kSeries);
  EXPECT_NEAR(found.mean_square, 1.0, 4.0 * std::sqrt(2.0 / kSeries) + 2.0 / 40.0);
  EXPECT_GT(found.splits, 0.7);
}

// A white part, or one that lasts, is found where there is none in as few cases as Akaike's price lets
// through: -2 ln(likelihood) gains as chi-squared of one or two degrees on a boundary, 2 in about one of ten.
TEST(NoiseModel, WhatIsOfOnePartIsNotSplit) {
  for (const double rho : {0.0, 0.6}) {
    const auto found = slow_signature({0.02, 0.0, rho, 0.0, 0.0}, 200);
    EXPECT_LT(found.splits, 0.1) << rho;
    EXPECT_NEAR(found.mean_square, 1.0, 4.0 * std::sqrt(2.0 / 200.0) + 2.0 / 50.0) << rho;
  }
}

// Theory (information of a stationary AR(1) process): var rho = (1 - rho^2)/n, var ln sd = (1 + rho^2)/(2 n
// (1 - rho^2)); the mean of N estimates then lies within 4 standard errors, their spread within 25 % of it
// (five of its standard errors, 1/sqrt(2 N)). What the line takes from the chain counts at order 1/n: allowed
// for.
TEST(NoiseModel, RecoversLevelAndCorrelation) {
  constexpr int kSeries = 200;
  constexpr double kRho = 0.6;
  std::mt19937_64 generator(11);
  Channel channel = line(600);
  double mean_rho = 0.0;
  double square_rho = 0.0;
  double mean_level = 0.0;
  double square_level = 0.0;
  for (int series = 0; series < kSeries; ++series) {
    channel.residuals = draw({0.02, 0.0, kRho, 0.0, 0.0}, channel, generator);
    const auto noise = estimate_alone(channel, {0.005, 0.0, 0.0, 0.0, 0.0});
    const double level = std::log(noise.level / 0.02);
    mean_rho += noise.rho / kSeries;
    square_rho += std::pow(noise.rho - kRho, 2) / kSeries;
    mean_level += level / kSeries;
    square_level += level * level / kSeries;
  }
  const double rho_error = std::sqrt((1.0 - kRho * kRho) / 600.0);
  const double level_error = std::sqrt((1.0 + kRho * kRho) / (1200.0 * (1.0 - kRho * kRho)));
  EXPECT_NEAR(mean_rho, kRho, 4.0 * rho_error / std::sqrt(kSeries) + 2.0 / 600.0);
  EXPECT_NEAR(mean_level, 0.0, 4.0 * level_error / std::sqrt(kSeries) + 2.0 / 600.0);
  EXPECT_NEAR(std::sqrt(square_rho) / rho_error, 1.0, 0.25);
  EXPECT_NEAR(std::sqrt(square_level) / level_error, 1.0, 0.25);
}

// Theory: information of independent values 1/2 sum (d ln sd^2/da)(d ln sd^2/db), for a, b = ln level, ln
// floor.
TEST(NoiseModel, RecoversLevelAndFloor) {
  constexpr int kSeries = 200;
  const NoiseModel truth{0.01, 50.0, 0.0, 0.0, 0.0};
  std::mt19937_64 generator(13);
  Channel channel = line(600);
  channel.inverse_stress = (-VectorXd::LinSpaced(600, std::log(2e3), std::log(4e5))).array().exp();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (Index i = 0; i < 600; ++i) {
    const double level2 = truth.level * truth.level;
    const double floor2 = std::pow(truth.floor * channel.inverse_stress[i], 2);
    const Eigen::Vector2d slope = 2.0 / (level2 + floor2) * Eigen::Vector2d(level2, floor2);
    information += 0.5 * slope * slope.transpose();
  }
  const Eigen::Vector2d error = information.inverse().diagonal().cwiseSqrt();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d square = Eigen::Vector2d::Zero();
  for (int series = 0; series < kSeries; ++series) {
    channel.residuals = draw(truth, channel, generator);
    const auto noise = estimate_alone(channel, {0.1, 1.0, 0.5, 0.0, 0.0});
    const Eigen::Vector2d miss(std::log(noise.level / truth.level), std::log(noise.floor / truth.floor));
    mean += miss / kSeries;
    square += miss.cwiseAbs2() / kSeries;
    EXPECT_LT(noise.neighbours(), 0.2);  // five standard errors
  }
  for (Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(mean[k], 0.0, 4.0 * error[k] / std::sqrt(kSeries) + 2.0 / 600.0) << k;
    EXPECT_NEAR(std::sqrt(square[k]) / error[k], 1.0, 0.25) << k;
  }
}

TEST(NoiseModel, SaysZeroOfWhatIsNotThere) {
  std::mt19937_64 generator(17);
  Channel channel = line(400);
  channel.inverse_stress = (-VectorXd::LinSpaced(400, std::log(2e3), std::log(4e5))).array().exp();
  channel.residuals = draw({0.0, 50.0, 0.0, 0.0, 0.0}, channel, generator);
  const auto floor_alone = estimate_alone(channel, {0.01, 1.0, 0.0, 0.0, 0.0});
  EXPECT_LT(floor_alone.level, 2e-4);  // the smallest sd is 1.25e-4
  EXPECT_NEAR(floor_alone.floor, 50.0, 4.0 * 50.0 / std::sqrt(800.0));
  // more than the scatter is known to be there, and it alternates: nothing to add, nothing correlated
  channel.known_variance.setConstant(1.1e-4);
  for (Index i = 0; i < 400; ++i) channel.residuals[i] = i % 2 == 0 ? 0.01 : -0.01;
  const auto known = estimate_alone(channel, {0.01, 1.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(known.level, 0.0);
  EXPECT_EQ(known.floor, 0.0);
  EXPECT_EQ(known.rho, 0.0);
}

TEST(NoiseModel, PerfectResidualsKeepAMillionthOfTheStart) {
  const auto noise = estimate_alone(line(20), {0.01, 0.0, 0.0, 0.0, 0.0});
  EXPECT_GT(noise.level, 0.0);
  EXPECT_LE(noise.level, 1e-8);
  EXPECT_TRUE(std::isfinite(noise.log_likelihood));
}

TEST(Whitening, TurnsTheCovarianceIntoTheUnitMatrix) {
  Channel channel = line(12);
  channel.inverse_stress.setLinSpaced(12, 1e-4, 1e-5);
  channel.known_variance.setLinSpaced(12, 0.0, 1e-4);
  channel.chain_starts = {0, 4, 5};
  const NoiseModel model{0.01, 200.0, 0.9, 0.0, 0.0};
  const Whitening whitening(model, channel);
  MatrixXd product = covariance(model, channel);
  EXPECT_NEAR(whitening.log_determinant(), std::log(product.determinant()), 1e-10);
  EXPECT_TRUE(whitening.sd().cwiseAbs2().isApprox(product.diagonal(), 1e-14));
  whitening.whiten(product);
  MatrixXd transposed = product.transpose();
  whitening.whiten(transposed);
  EXPECT_LT((transposed - MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e-13);
  VectorXd vector = VectorXd::LinSpaced(12, 1.0, 2.0);  // a vector as the column of a matrix
  MatrixXd matrix = vector;
  whitening.whiten(vector);
  whitening.whiten(matrix);
  EXPECT_EQ(vector, matrix.col(0));
}

// At the limits and between: white alone, nearly so, a part of each, the autoregression alone.
TEST(Whitening, FreesTheSumOfAPartThatLastsAndAWhiteOne) {
  Channel channel = line(40);
  channel.inverse_stress.setLinSpaced(40, 1e-4, 1e-5);
  channel.known_variance.setLinSpaced(40, 0.0, 1e-4);
  channel.chain_starts = {0, 30, 31};
  for (const double share : {0.0, 1e-9, 0.3, 0.9, 1.0 - 1e-9, 1.0}) {
    for (const double rho : {0.0, 0.5, 0.9, kLargestRho}) {
      const NoiseModel model{0.01, 200.0, rho, 0.0, 0.0, share};
      const Whitening whitening(model, channel);
      MatrixXd product = covariance(model, channel);
      EXPECT_NEAR(whitening.log_determinant(), product.ldlt().vectorD().array().log().sum(), 1e-8);
      whitening.whiten(product);
      MatrixXd transposed = product.transpose();
      whitening.whiten(transposed);
      EXPECT_LT((transposed - MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-11) << share << rho;
    }
  }
}

TEST(NoiseModel, RejectsWhatDoesNotFit) {
  const NoiseModel start{0.01, 0.0, 0.0, 0.0, 0.0};
  Channel good = line(12);
  good.residuals.setLinSpaced(12, 1.0, 3.0);
  const auto rejected = [&](auto change) {
    Channel channel = good;
    change(channel);
    EXPECT_THROW((void)estimate_alone(channel, start), std::invalid_argument);
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  rejected([](Channel& c) { c.residuals[3] = kNaN; });
  rejected([](Channel& c) { c.jacobian(3, 1) = kNaN; });
  rejected([](Channel& c) { c.known_variance[3] = -1e-9; });
  rejected([](Channel& c) { c.known_variance[3] = kNaN; });
  rejected([](Channel& c) { c.known_variance.resize(5); });
  rejected([](Channel& c) { c.inverse_stress.setZero(12); });
  rejected([](Channel& c) { c.inverse_stress.setOnes(11); });
  rejected([](Channel& c) { c.chain_starts = {}; });
  rejected([](Channel& c) { c.chain_starts = {1}; });
  rejected([](Channel& c) { c.chain_starts = {0, 5, 5}; });
  rejected([](Channel& c) { c.chain_starts = {0, 12}; });
  rejected([](Channel& c) { c = line(2); });                                // as many coordinates as values
  EXPECT_THROW((void)estimate_alone(line(12), {}), std::invalid_argument);  // no residual, no noise
  EXPECT_THROW((void)estimate_noise(good, MatrixXd::Zero(3, 3), VectorXd::Zero(2), start),
               std::invalid_argument);
  EXPECT_THROW((void)Whitening({}, good), std::invalid_argument);
  EXPECT_THROW((void)Whitening({1.0, 0.0, 1.0, 0.0, 0.0}, good), std::invalid_argument);
  EXPECT_THROW((void)Whitening({kNaN, 0.0, 0.0, 0.0, 0.0}, good), std::invalid_argument);
  EXPECT_THROW((void)Whitening({1.0, 0.0, 0.5, 0.0, 0.0, 1.1}, good), std::invalid_argument);
  EXPECT_THROW((void)Whitening({1.0, 0.0, 0.5, 0.0, 0.0, -0.1}, good), std::invalid_argument);
  VectorXd other(11);
  EXPECT_THROW(Whitening(start, good).whiten(other), std::invalid_argument);
}

}  // namespace
}  // namespace isotach::calibration
