// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Derivatives by differences where a prediction beside the point cannot be made.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/experiment.hpp"
#include "tests/seed_mud.hpp"

namespace isotach::experiments {
namespace {

/// Predicts 5 ln I_v, and fails where I_v is outside of its range.
class Logarithm final : public Experiment {
 public:
  Logarithm(double lower, double upper, bool interrupted = false)
      : lower_(lower), upper_(upper), interrupted_(interrupted) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] bool held_out() const override { return false; }
  [[nodiscard]] const Values& measured() const override { return zero_; }
  [[nodiscard]] std::string_view quantity() const override { return "-"; }
  [[nodiscard]] const Values& noise() const override { return zero_; }
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict(const model::Parameters<double>& parameters,
                                                                std::span<const double>) const override {
    const double I_v = parameters.I_v();
    if (I_v < lower_ || I_v > upper_) return tl::unexpected(PredictionFailure{"out of range", interrupted_});
    return Values{5.0 * std::log(I_v)};
  }

 private:
  std::string name_ = "logarithm";
  Values zero_{0.0};
  double lower_;
  double upper_;
  bool interrupted_;
};

constexpr double kIv = 0.05;

auto derivative(const Logarithm& experiment) {
  Eigen::MatrixXd direction = Eigen::MatrixXd::Zero(model::kParameterCount, 1);
  direction(static_cast<Eigen::Index>(model::ParameterId::I_v), 0) = kIv;
  return experiment.linearise(tests::seed_mud_with(model::ParameterId::I_v, kIv), {}, direction);
}

// d(5 ln x)/d(ln x) = 5. Differences over 3 % err by (0.03)^2/3, one-sided ones by 0.03/2.
TEST(Differences, AreOneSidedWhereTheOtherSideFails) {
  EXPECT_NEAR(derivative(Logarithm(0.0, 1.0))->jacobian(0, 0), 5.0, 5.0 * 4e-4);
  EXPECT_NEAR(derivative(Logarithm(kIv, 1.0))->jacobian(0, 0), 5.0, 5.0 * 0.016);
  EXPECT_NEAR(derivative(Logarithm(0.0, kIv))->jacobian(0, 0), 5.0, 5.0 * 0.016);
}

TEST(Differences, FailWhereBothSidesDo) {
  const auto both = derivative(Logarithm(kIv, kIv));
  ASSERT_FALSE(both.has_value());
  EXPECT_EQ(both.error().message, "out of range");
}

TEST(Differences, EndWithAnInterrupt) {
  const auto stopped = derivative(Logarithm(kIv, 1.0, true));
  ASSERT_FALSE(stopped.has_value());
  EXPECT_TRUE(stopped.error().interrupted);
}

}  // namespace
}  // namespace isotach::experiments
