// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Outlines parted by arc length, and the covariance of what is compared there.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "experiments/outline_stations.hpp"
#include "experiments/slump_experiment.hpp"

namespace isotach::experiments {
namespace {

/// A cylinder 4 wide and 3 high (m): arc length 7 from toe to axis.
datasets::Outline cylinder(double time) {
  return {time, {{4.0, 0.0}, {4.0, 1.0}, {4.0, 3.0}, {3.9, 3.0}, {3.8, 3.0}, {3.7, 3.0}, {0.0, 3.0}}};
}

TEST(OutlineStations, AreStretchesOfEqualLength) {
  const std::vector<OutlineStation> stations = outline_stations({cylinder(1.0)}, 1.0);
  // points at 0, 1, 3, 3.1, 3.2, 3.3 and 7 of 7: stretches 0, 1, 3 and the last, which has its end
  ASSERT_EQ(stations.size(), 4U);
  EXPECT_EQ(stations[0].points, (std::vector<std::size_t>{0}));
  EXPECT_EQ(stations[2].points, (std::vector<std::size_t>{2, 3, 4, 5}));
  EXPECT_EQ(stations[3].points, (std::vector<std::size_t>{6}));
  EXPECT_NEAR(stations[0].place, 0.5 / 7.0, 1e-12);
  EXPECT_NEAR(stations[2].place, 3.5 / 7.0, 1e-12);
}

TEST(OutlineStations, EveryPointOfAllOutlinesIsInOne) {
  const std::vector<OutlineStation> stations = outline_stations({cylinder(1.0), cylinder(2.0)}, 0.37);
  std::vector<int> met(14, 0);
  for (const OutlineStation& station : stations) {
    for (const std::size_t i : station.points) {
      ++met[i];
      EXPECT_EQ(station.outline, i < 7 ? 0U : 1U);
      EXPECT_EQ(station.time, i < 7 ? 1.0 : 2.0);
    }
  }
  EXPECT_EQ(met, std::vector<int>(14, 1));
}

TEST(OutlineStations, MeansAreThoseOfTheirPoints) {
  const std::vector<OutlineStation> stations = outline_stations({cylinder(1.0)}, 1.0);
  const std::vector<double> means = station_means(stations, std::vector<double>{1, 2, 3, 5, 7, 9, 11});
  EXPECT_EQ(means, (std::vector<double>{1, 2, 6, 11}));
}

TEST(Resampled, PointsLieAtEqualArcLengths) {
  const std::vector<mpm::OutlinePoint> line{{4.0, 0.0}, {4.0, 3.0}, {0.0, 3.0}};
  const auto points = resampled(line, 8);
  ASSERT_EQ(points.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(points[k].r, k <= 3 ? 4.0 : 7.0 - double(k), 1e-12);
    EXPECT_NEAR(points[k].z, k <= 3 ? double(k) : 3.0, 1e-12);
  }
}

const OutlineErrors kErrors{0.8e-3, {0.9e-3, 2e-3, 0.2, 1.0}, {0.5e-3, 1e-3, 0.1, 2.0}};

TEST(StationCovariance, AddsWhatIsOwnAndWhatIsShared) {
  const std::vector<OutlineStation> stations{
      {0, 0.9, 0.1, {0, 1, 2, 3}}, {0, 0.9, 0.3, {4}}, {1, 2.9, 0.3, {5}}};
  const Eigen::MatrixXd c = station_covariance(stations, {false, false, true}, kErrors);
  EXPECT_NEAR(c(0, 0), 0.64e-6 / 4.0 + 4e-6 + 1e-6, 1e-15);
  EXPECT_NEAR(c(2, 2), 0.64e-6 + 0.81e-6 + 0.25e-6, 1e-15);
  EXPECT_NEAR(c(0, 1), 4e-6 * std::exp(-1.0) + 1e-6 * std::exp(-2.0), 1e-15);
  // t + 0.1 s is 1 and 3 s
  EXPECT_NEAR(c(1, 2), 1.8e-6 * std::exp(-std::log(3.0)) + 0.5e-6 * std::exp(-0.5 * std::log(3.0)), 1e-15);
  EXPECT_EQ((c - c.transpose()).norm(), 0.0);
}

TEST(StationCovariance, IsPositiveDefiniteWithoutReadingErrors) {
  std::vector<OutlineStation> stations;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int i = 0; i < 20; ++i)
      stations.push_back({k, 1.0 + double(k), (i + 0.5) / 20.0, {stations.size()}});
  }
  OutlineErrors errors = kErrors;
  errors.reading = 0.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      station_covariance(stations, std::vector<bool>(60, true), errors));
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
}

TEST(OutlineErrors, PartsTheNoiseOfAStudy) {
  const OutlineErrors errors = errors_of({1.2e-3, 2.5e-3, 0.9e-3}, {});
  EXPECT_NEAR(errors.reading * errors.reading + errors.measuring.outline * errors.measuring.outline, 1.44e-6,
              1e-15);
  EXPECT_NEAR(errors.reading * errors.reading + errors.measuring.lifting * errors.measuring.lifting, 6.25e-6,
              1e-15);
  EXPECT_EQ(errors.measuring.outline, 0.9e-3);
}

// Errors drawn as the study says they are come out of it with unit variance, and independent.
TEST(SlumpExperiment, DecorrelatedErrorsHaveUnitVariance) {
  datasets::SlumpTest test{"drawn", {}, {cylinder(1.0), cylinder(3.0)}, {}, {1.2e-3, 2.5e-3, 0.9e-3}, false};
  test.setup.mould.lift_speed = 10.0;  // gone at once
  const SlumpExperiment experiment(test);
  const std::vector<OutlineStation>& stations = experiment.stations();
  const auto n = static_cast<Eigen::Index>(stations.size());
  ASSERT_EQ(n, 14);  // stretches of 4 mm: every point is its own
  const Eigen::MatrixXd covariance =
      station_covariance(stations, std::vector<bool>(14, true), errors_of(test.noise, {}));
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::MatrixXd moment = Eigen::MatrixXd::Zero(n, n);
  constexpr int kDraws = 4000;
  for (int k = 0; k < kDraws; ++k) {
    Eigen::VectorXd z(n);
    for (Eigen::Index i = 0; i < n; ++i) z[i] = normal(random);
    const Eigen::VectorXd drawn = root * z;
    const Values seen = experiment.decorrelated({drawn.data(), drawn.data() + n});
    const Eigen::Map<const Eigen::VectorXd> x(seen.data(), n);
    moment += x * x.transpose() / kDraws;
  }
  // standard errors are 1/sqrt(4000) = 0.016 off the diagonal and 0.022 on it
  EXPECT_LT((moment - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 0.09);
}

}  // namespace
}  // namespace isotach::experiments
