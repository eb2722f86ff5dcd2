// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The Rosenbrock integrator: order conditions, observed order, cost and accuracy of long holds, control,
// failures.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <vector>

#include "integrators/increment_system.hpp"
#include "integrators/rosenbrock_tableau.hpp"
#include "tests/set_a.hpp"

namespace isotach::integrators {
namespace {

using tests::compression_rate;
using tests::Law;
using tests::set_a;
using tests::State;
using tests::stress_kPa;
using tests::Vector6;

constexpr double kYear = 365.25 * 86400.0;

constexpr int kStages = static_cast<int>(Rodas5P::kStages);
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// alpha, beta = alpha + Gamma and the weights of the classical form of the method (Hairer and Wanner II,
/// IV.7).
struct Classical {
  Matrix alpha;
  Matrix beta;
  Vector weights;
  Vector embedded_weights;
};

Classical classical() {
  Matrix a = Matrix::Zero(kStages, kStages);
  Matrix C = Matrix::Zero(kStages, kStages);
  for (int i = 0; i < kStages; ++i) {
    for (int j = 0; j < kStages; ++j) {
      a(i, j) = Rodas5P::kA[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      C(i, j) = Rodas5P::kC[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  // C = 1/gamma - Gamma^-1, a = alpha Gamma^-1, m = b Gamma^-1 (ibid., eq. 7.25)
  const Matrix gamma = (Matrix::Identity(kStages, kStages) / Rodas5P::kGamma - C).inverse();
  const Matrix alpha = a * gamma;
  Vector m = a.row(kStages - 1).transpose();
  const Vector embedded = gamma.transpose() * m;
  m[kStages - 1] = 1.0;
  return {alpha, alpha + gamma, gamma.transpose() * m, embedded};
}

/// A rooted tree; children in any order.
struct Tree {
  std::vector<Tree> children;
  [[nodiscard]] int size() const {
    int sum = 1;
    for (const Tree& child : children) sum += child.size();
    return sum;
  }
  /// gamma(t) of Butcher: the size times those of the children.
  [[nodiscard]] double density() const {
    double product = size();
    for (const Tree& child : children) product *= child.density();
    return product;
  }
};

/// Trees of each size up to `largest`: a root with children of non-increasing place in the list, so that each
/// tree comes once.
std::vector<Tree> trees(int largest) {
  std::vector<Tree> all{Tree{}};
  for (int size = 2; size <= largest; ++size) {
    const std::size_t smaller = all.size();
    std::vector<Tree> found;
    std::function<void(Tree, int, std::size_t)> grow = [&](Tree tree, int left, std::size_t last) {
      if (left == 0) {
        found.push_back(tree);
        return;
      }
      for (std::size_t i = 0; i < last; ++i) {
        if (all[i].size() > left) continue;
        Tree grown = tree;
        grown.children.push_back(all[i]);
        grow(grown, left - all[i].size(), i + 1);
      }
    };
    grow(Tree{}, size - 1, smaller);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

/// Stage values of the elementary weight: beta joins an only child, alpha each of several (Hairer and Wanner
/// II, theorem IV.7.4).
Vector stage_weights(const Classical& method, const Tree& tree) {
  Vector product = Vector::Ones(kStages);
  for (const Tree& child : tree.children) {
    const Matrix& join = tree.children.size() == 1 ? method.beta : method.alpha;
    product = product.cwiseProduct(join * stage_weights(method, child));
  }
  return product;
}

double largest_defect(const Classical& method, const Vector& weights, int order) {
  double largest = 0.0;
  for (const Tree& tree : trees(order)) {
    if (tree.size() != order) continue;
    largest = std::max(largest, std::abs(weights.dot(stage_weights(method, tree)) - 1.0 / tree.density()));
  }
  return largest;
}

TEST(Rodas5P, TreesAreAllRootedTrees) {
  std::vector<int> count(7, 0);
  for (const Tree& tree : trees(6)) ++count[static_cast<std::size_t>(tree.size())];
  EXPECT_EQ(count, (std::vector<int>{0, 1, 1, 2, 4, 9, 20}));  // OEIS A000081
}

TEST(Rodas5P, SolutionMeetsTheOrderConditionsUpToFiveAndNotSix) {
  const Classical method = classical();
  // coefficients of up to 1e2 with 16 digits
  for (int order = 1; order <= 5; ++order)
    EXPECT_LT(largest_defect(method, method.weights, order), 1e-13) << order;
  EXPECT_GT(largest_defect(method, method.weights, 6), 1e-5);
}

TEST(Rodas5P, EmbeddedSolutionMeetsThemUpToFourAndNotFive) {
  const Classical method = classical();
  for (int order = 1; order <= 4; ++order) {
    EXPECT_LT(largest_defect(method, method.embedded_weights, order), 1e-13) << order;
  }
  EXPECT_GT(largest_defect(method, method.embedded_weights, 5), 1e-5);
}

TEST(Rodas5P, StabilityFunctionsAreBoundedOnTheImaginaryAxisAndVanishAtInfinity) {
  const Classical method = classical();
  // R(i y) = 1 + i y b (I - i y beta)^-1 (1 ... 1), in real and imaginary parts
  const auto size_at = [&](double y, const Vector& weights) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(2 * kStages, 2 * kStages);
    matrix.topRightCorner(kStages, kStages) = y * method.beta;
    matrix.bottomLeftCorner(kStages, kStages) = -y * method.beta;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * kStages);
    right.head(kStages).setOnes();
    const Eigen::VectorXd stages = matrix.partialPivLu().solve(right);
    return std::hypot(1.0 - y * weights.dot(stages.tail(kStages)), y * weights.dot(stages.head(kStages)));
  };
  for (const Vector& weights : {method.weights, method.embedded_weights}) {
    for (double y = 1e-2; y < 1e4; y *= 1.1) EXPECT_LE(size_at(y, weights), 1.0 + 1e-12) << y;
    EXPECT_LT(size_at(1e8, weights), 1e-6);
  }
}

/// The largest of the errors of T (relative), e and strain.
double error(const Integrated<double>& a, const Integrated<double>& b) {
  return std::max({(a.state.stress - b.state.stress).norm() / b.state.stress.norm(),
                   std::abs(a.state.void_ratio - b.state.void_ratio), (a.state.omega - b.state.omega).norm(),
                   (a.strain - b.strain).norm()});
}

Integrated<double> reference(const Law& law, const State& start, const Increment<double>& increment) {
  CvodeTolerance tolerance;
  tolerance.relative = 1e-13;
  tolerance.absolute_stress = 1e-8;
  return integrate_cvode(law, start, increment, tolerance).value();
}

Integrated<double> rosenbrock(const Law& law, const State& start, const Increment<double>& increment,
                              double relative) {
  Tolerance tolerance;
  tolerance.relative = relative;
  return integrate_rosenbrock(law, start, increment, tolerance).value();
}

Law law_of(double I_v, double C_1 = 0.0, double C_2 = 0.0, double C_3 = 0.0) {
  auto values = tests::set_a_values();
  values[model::ParameterId::I_v] = I_v;
  values[model::ParameterId::C_1] = C_1;
  values[model::ParameterId::C_2] = C_2;
  values[model::ParameterId::C_3] = C_3;
  return Law(model::Parameters<double>::create(values).value());
}

Increment<double> hold(double duration) {
  Increment<double> increment;
  increment.duration = duration;
  increment.stress_controlled.fill(true);
  return increment;
}

Increment<double> oedometric_hold(double duration) {
  Increment<double> increment;
  increment.duration = duration;
  increment.stress_controlled[0] = true;
  return increment;
}

Increment<double> sheared_with_spin(double duration) {
  Increment<double> shear;
  shear.duration = duration;
  shear.strain_rate[3] = 5e-7 * std::numbers::sqrt2;
  shear.spin[0] = 5e-7;
  shear.stress_controlled[1] = true;
  return shear;
}

/// n equal steps: n increments at a tolerance that never rejects.
Integrated<double> in_equal_steps(int n, const Law& law, const State& start, Increment<double> increment) {
  increment.duration /= n;
  Integrated<double> reached{start, Vector6::Zero(), 0.0, {}};
  for (int i = 0; i < n; ++i) {
    const auto step = rosenbrock(law, reached.state, increment, 1e30);
    EXPECT_EQ(step.statistics.accepted, 1);
    EXPECT_EQ(step.statistics.rejected, 0);
    reached.state = step.state;
    reached.strain += step.strain;
  }
  return reached;
}

TEST(Rosenbrock, GlobalErrorInEqualStepsIsOfOrderFive) {
  State inclined{stress_kPa(70.0, 100.0, 75.0), 1.45};
  inclined.omega << -0.05, 0.1, -0.05, 0.02, 0.0, 0.0;
  struct Case {
    Law law;
    State start;
    double duration;
    int coarsest;
  };
  for (const Case& c : {Case{law_of(0.05, 0.1), {stress_kPa(70.0, 100.0, 75.0), 1.5}, 1e4, 2},
                        Case{law_of(0.05, 0.1, 10.0, 0.5), inclined, 2e4, 4}}) {
    const auto increment = sheared_with_spin(c.duration);
    // CVODES' own error is 1e-12, not small enough for the finest
    const auto expected = in_equal_steps(1024, c.law, c.start, increment);
    EXPECT_LT(error(reference(c.law, c.start, increment), expected), 1e-10);
    double last = 0.0;
    for (int level = 0; level < 6; ++level) {
      const double now = error(in_equal_steps(c.coarsest << level, c.law, c.start, increment), expected);
      if (level > 0) {
        EXPECT_GT(std::log2(last / now), 4.7) << level << ": " << last << " to " << now;
        EXPECT_LT(std::log2(last / now), 5.5) << level << ": " << last << " to " << now;
      }
      last = now;
    }
  }
}

TEST(Rosenbrock, IsotropicCreepFollowsTheClosedFormOverAMillionSecondsAndThirtyYears) {
  // eps = I_v lambda ln(1 + t/t0), t0 = I_v lambda/rv0, rv0 = sqrt3 D_r OCR^(-1/I_v)
  for (const double I_v : {0.05, 0.01}) {
    for (const double ocr : {1.0, 0.9}) {
      for (const double duration : {1e6, 30.0 * kYear}) {
        const Law law = law_of(I_v);
        const State start{stress_kPa(100.0, 100.0, 100.0), law.void_ratio_at(ocr * 100e3)};
        const double t0 = I_v * 0.1 / (std::sqrt(3.0) * 1e-6 * std::pow(ocr, -1.0 / I_v));
        const double strain = I_v * 0.1 * std::log1p(duration / t0);
        for (const double relative : {1e-4, 1e-6, 1e-8}) {
          const auto end = rosenbrock(law, start, hold(duration), relative);
          EXPECT_NEAR(-end.strain.head<3>().sum(), strain, relative) << I_v << " " << ocr << " " << duration;
          EXPECT_NEAR(1.0 + end.state.void_ratio, (1.0 + start.void_ratio) * std::exp(-strain),
                      2.0 * relative);
          EXPECT_LE((end.state.stress - start.stress).norm(), 1e-12 * 100e3);
        }
      }
    }
  }
}

TEST(Rosenbrock, IsotropicRelaxationFollowsTheClosedForm) {
  // p = p0 (1 + rv0 t/(I_v kappa))^(-I_v); the first is a reference number, 68.87465481 kPa
  for (const double I_v : {0.05, 0.01}) {
    for (const double ocr : {1.0, 0.9}) {
      const Law law = law_of(I_v);
      const State start{stress_kPa(100.0, 100.0, 100.0), law.void_ratio_at(ocr * 100e3)};
      const double rv0 = std::sqrt(3.0) * 1e-6 * std::pow(ocr, -1.0 / I_v);
      const double p = 100.0 * std::pow(1.0 + rv0 * 1e6 / (I_v * 0.02), -I_v);
      if (I_v == 0.05 && ocr == 1.0) {
        EXPECT_NEAR(p, 68.87465481, 1e-8);
      }
      for (const double relative : {1e-4, 1e-6, 1e-8}) {
        const auto end = rosenbrock(law, start, strain_increment<double>(Vector6::Zero(), 1e6), relative);
        EXPECT_NEAR(tests::p_kPa(end.state), p, relative * p) << I_v << " " << ocr;
      }
    }
  }
}

TEST(Rosenbrock, AMillionSecondHoldAtOneInAMillionCostsTensOfSubsteps) {
  const State isotropic{stress_kPa(100.0, 100.0, 100.0), 1.5};
  const State anisotropic{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const Law law = law_of(0.05);
  for (const auto& end : {rosenbrock(law, isotropic, hold(1e6), 1e-6),
                          rosenbrock(law, anisotropic, oedometric_hold(1e6), 1e-6)}) {
    EXPECT_LE(end.statistics.accepted, 25);
    EXPECT_LE(end.statistics.rejected, 2);
    EXPECT_LE(end.statistics.evaluations, 180);
    EXPECT_EQ(end.statistics.jacobians, end.statistics.accepted);
  }
}

TEST(Rosenbrock, RoundOffAroundIsotropicStressRejectsNoSubstep) {
  // the Jacobian's derivative of F must not be round-off's: F has a kink at isotropic stress
  const auto end = rosenbrock(law_of(0.05), {stress_kPa(100.0, 100.0, 100.0), 1.5},
                              strain_increment<double>(Vector6::Zero(), 1e6), 1e-8);
  EXPECT_LE(end.statistics.rejected, 2);
}

TEST(Rosenbrock, DerivativeAlongPressureIsThatOfTheIsotropicStateAUnitInTheLastPlaceAway) {
  // isotropic relaxation: dp/dt = -(p/kappa) r0 (p/p_B)^(1/I_v), hence d(dp/dt)/dp = (1 + 1/I_v) (dp/dt)/p
  const Law law = law_of(0.05);
  const auto increment = strain_increment<double>(Vector6::Zero(), 1.0);
  IncrementSystem<model::Fabric::none> system(law, increment, 1e5);
  for (int component = 0; component < 6; ++component) {
    IncrementSystem<model::Fabric::none>::Unknowns y;
    IncrementSystem<model::Fabric::none>::Unknowns rate;
    IncrementSystem<model::Fabric::none>::Jacobian jacobian;
    y.setZero();
    y.head<3>().setConstant(-0.95);
    y[6] = 1.5;
    y[component] += 1.2e-16;
    ASSERT_TRUE(system.rate_and_jacobian(y, rate, jacobian));
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(jacobian.row(i).head<3>().sum() * y[i] / rate[i], 21.0, 1e-10) << component;
    }
  }
}

TEST(Rosenbrock, GlobalErrorStaysBelowTheToleranceAndFallsWithIt) {
  const Law stiff = law_of(0.01);
  const Law rotating = law_of(0.05, 0.05, 10.0, 0.5);
  State inclined{stress_kPa(100.0, 65.0, 65.0), 1.5};
  inclined.omega << 0.1, -0.05, -0.05, 0.0, 0.0, 0.0;
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const State below{start.stress, stiff.void_ratio_at(0.9 * stiff.measures(start).equivalent_pressure)};
  const auto crs = strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 2e5);
  struct Case {
    const char* name;
    const Law& law;
    const State& start;
    Increment<double> increment;
  };
  for (const Case& c : {Case{"CRS", stiff, start, crs}, Case{"CRS from OCR 0.9", stiff, below, crs},
                        Case{"creep over 30 years", stiff, below, oedometric_hold(30.0 * kYear)},
                        Case{"CRS with Omega", rotating, inclined, crs},
                        Case{"creep with Omega", rotating, inclined, oedometric_hold(30.0 * kYear)},
                        Case{"shear", rotating, inclined, sheared_with_spin(3e5)}}) {
    const auto expected = reference(c.law, c.start, c.increment);
    const double coarse = error(rosenbrock(c.law, c.start, c.increment, 1e-5), expected);
    const double medium = error(rosenbrock(c.law, c.start, c.increment, 1e-7), expected);
    const double fine = error(rosenbrock(c.law, c.start, c.increment, 1e-9), expected);
    EXPECT_LT(coarse, 1e-5) << c.name;
    EXPECT_LT(medium, 1e-7) << c.name;
    EXPECT_LT(fine, 1e-9) << c.name;
    EXPECT_LT(fine, 1e-2 * coarse) << c.name;
  }
}

TEST(Rosenbrock, StateWithAnOmegaThatStaysZeroMovesAsOneWithout) {
  // C_3 = 0 keeps Omega at zero, while C_2 asks for the form with it
  const State start{stress_kPa(100.0, 65.0, 80.0), 1.5};
  const auto increment = strain_increment<double>(compression_rate(1e-6, 1e-7, 0.0), 1e5);
  const auto with = rosenbrock(law_of(0.05, 0.1, 10.0, 0.0), start, increment, 1e-7);
  const auto without = rosenbrock(law_of(0.05, 0.1), start, increment, 1e-7);
  EXPECT_EQ(with.state.omega, Vector6::Zero());
  EXPECT_EQ(with.statistics.accepted, without.statistics.accepted);
  EXPECT_LT(error(with, without), 1e-12);
}

TEST(Rosenbrock, MixedControlReachesThePrescribedStressesAndStrains) {
  const State start{stress_kPa(100.0, 100.0, 100.0), 1.4};
  Increment<double> increment;
  increment.duration = 3e4;
  increment.strain_rate << -1e-6, 0.0, 0.0, 0.0, 2e-7, 0.0;
  increment.stress_rate << 0.0, -0.5, 0.3, 0.1, 0.0, -0.2;
  increment.stress_controlled = {false, true, true, true, false, true};
  const auto end = rosenbrock(law_of(0.05, 0.1), start, increment, 1e-6);
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    if (increment.stress_controlled[static_cast<std::size_t>(i)]) {
      EXPECT_NEAR(end.state.stress[i], start.stress[i] + 3e4 * increment.stress_rate[i], 1e-12 * 100e3);
    } else {
      EXPECT_NEAR(end.strain[i], 3e4 * increment.strain_rate[i], 1e-14);
    }
  }
  const auto expected = reference(law_of(0.05, 0.1), start, increment);
  EXPECT_LT(error(end, expected), 1e-6);
}

TEST(Rosenbrock, SpinAloneTurnsStressAndOmega) {
  // no creep (e = 0.2), D = 0, constant W12: R A R^T with the rotation by W12 t
  State start{stress_kPa(130.0, 80.0, 90.0), 0.2};
  start.omega << 0.1, -0.07, -0.03, 0.02, 0.0, 0.01;
  Increment<double> increment;
  increment.duration = 1.0;
  increment.spin[0] = 0.7;
  const auto end = rosenbrock(law_of(0.05), start, increment, 1e-10);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(0.7), std::sin(0.7), -std::sin(0.7), std::cos(0.7);
  for (const auto& [from, to] :
       {std::pair{start.stress, end.state.stress}, std::pair{start.omega, end.state.omega}}) {
    const Eigen::Matrix3d expected = turn * model::matrix_from_mandel<double, 6>(from) * turn.transpose();
    EXPECT_LE((model::matrix_from_mandel<double, 6>(to) - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(Rosenbrock, ZeroDurationReturnsTheState) {
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto end = integrate_rosenbrock(law_of(0.05), start, Increment<double>{}, Tolerance{}).value();
  EXPECT_EQ(end.state.stress, start.stress);
  EXPECT_EQ(end.state.void_ratio, start.void_ratio);
  EXPECT_EQ(end.strain, Vector6::Zero());
}

TEST(Rosenbrock, NextSubstepCarriesOnWithoutRejections) {
  const Law law = law_of(0.05);
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto first = rosenbrock(law, start, oedometric_hold(1e6), 1e-6);
  EXPECT_GT(first.next_substep, 0.0);
  const auto second =
      integrate_rosenbrock(law, first.state, oedometric_hold(1e6), Tolerance{}, first.next_substep).value();
  EXPECT_EQ(second.statistics.rejected, 0);
  EXPECT_LE(second.statistics.accepted, 5);
}

TEST(Rosenbrock, FailuresAreResults) {
  const Law law = law_of(0.05);
  const State start{stress_kPa(100.0, 65.0, 65.0), 1.5};
  const auto crs = strain_increment<double>(compression_rate(1e-6, 0.0, 0.0), 1e5);

  const auto outside = integrate_rosenbrock(law, {stress_kPa(400.0, -20.0, -20.0), 1.5}, crs, Tolerance{});
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().kind, FailureKind::outside_domain);
  EXPECT_EQ(outside.error().time, 0.0);

  auto not_a_number = crs;
  not_a_number.strain_rate[4] = std::nan("");
  EXPECT_FALSE(integrate_rosenbrock(law, start, not_a_number, Tolerance{}));

  Tolerance few;
  few.relative = 1e-8;
  few.max_substeps = 10;
  const auto limited = integrate_rosenbrock(law, start, crs, few);
  ASSERT_FALSE(limited);
  EXPECT_EQ(limited.error().kind, FailureKind::too_many_substeps);
  EXPECT_EQ(limited.error().statistics.accepted + limited.error().statistics.rejected, 10);
  EXPECT_NEAR(1.0 + limited.error().last_state.void_ratio, 2.5 * std::exp(-1e-6 * limited.error().time),
              1e-9);
}

TEST(Rosenbrock, UnloadingIntoTensionStopsWherePressureVanishes) {
  // p = 100 kPa falls by 1 kPa/s and vanishes after 100 s
  const Law law = law_of(0.05);
  const State start{stress_kPa(100.0, 100.0, 100.0), 0.2};
  Increment<double> unload = hold(150.0);
  unload.stress_rate.head<3>().setConstant(1e3);
  const auto end = integrate_rosenbrock(law, start, unload, Tolerance{});
  ASSERT_FALSE(end);
  EXPECT_NE(end.error().kind, FailureKind::outside_domain);  // the start was inside
  EXPECT_NEAR(end.error().time, 100.0, 1e-6);
  EXPECT_TRUE(law.in_domain(end.error().last_state));
  EXPECT_NEAR(tests::p_kPa(end.error().last_state), 100.0 - end.error().time, 1e-9);
}

TEST(Methods, EachIsFoundByItsName) {
  for (const auto method : kMethods) EXPECT_EQ(find_method(name(method)), method);
  EXPECT_EQ(name(Method::rosenbrock), "rosenbrock");
  EXPECT_FALSE(find_method("runge-kutta"));
  EXPECT_FALSE(find_method(""));
}

}  // namespace
}  // namespace isotach::integrators
