// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Mandel vectors: the laws their conversions obey, against Eigen's 3x3 algebra.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "model/mandel.hpp"

namespace isotach::model {
namespace {

using Matrix3 = Eigen::Matrix3d;

// A few operations on numbers below 1: round-off of some machine epsilons.
constexpr double kRoundOff = 2e-15;

class RandomTensors : public testing::Test {
 protected:
  double number() { return uniform_(generator_); }
  Matrix3 symmetric(bool plane) {
    Matrix3 a;
    const double a12 = number();
    const double a13 = plane ? 0.0 : number();
    const double a23 = plane ? 0.0 : number();
    a << number(), a12, a13, a12, number(), a23, a13, a23, number();
    return a;
  }

 private:
  std::mt19937 generator_{20240501};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

template <int N>
struct Size {
  static constexpr int value = N;
};

template <class SizeType>
class Mandel6And4 : public RandomTensors {
 protected:
  static constexpr int N = SizeType::value;
  Matrix3 tensor() { return symmetric(N == kPlane); }
  static Mandel<double, N> mandel(const Matrix3& a) { return mandel_from_matrix<double, N>(a); }
};
using Sizes = testing::Types<Size<kGeneral>, Size<kPlane>>;
TYPED_TEST_SUITE(Mandel6And4, Sizes);

TYPED_TEST(Mandel6And4, MatrixRoundTripIsIdentity) {
  for (int i = 0; i < 20; ++i) {
    const Matrix3 a = this->tensor();
    const auto round_trip = matrix_from_mandel<double, TestFixture::N>(this->mandel(a));
    EXPECT_LE((round_trip - a).norm(), kRoundOff);
  }
}

TYPED_TEST(Mandel6And4, DotIsDoubleContractionAndNormIsFrobenius) {
  for (int i = 0; i < 20; ++i) {
    const Matrix3 a = this->tensor();
    const Matrix3 b = this->tensor();
    EXPECT_NEAR(this->mandel(a).dot(this->mandel(b)), (a * b).trace(), kRoundOff);
    EXPECT_NEAR(this->mandel(a).norm(), a.norm(), kRoundOff);
  }
}

TYPED_TEST(Mandel6And4, TraceDeviatorAndDeterminantAgreeWithMatrices) {
  constexpr int kSize = TestFixture::N;
  for (int i = 0; i < 20; ++i) {
    const Matrix3 a = this->tensor();
    const auto v = this->mandel(a);
    EXPECT_NEAR((trace<double, kSize>(v)), a.trace(), kRoundOff);
    EXPECT_NEAR((determinant<double, kSize>(v)), a.determinant(), kRoundOff);
    const Matrix3 dev = a - a.trace() / 3.0 * Matrix3::Identity();
    EXPECT_LE((deviator<double, kSize>(v) - this->mandel(dev)).norm(), kRoundOff);
  }
  EXPECT_EQ((unit_tensor<double, kSize>()), this->mandel(Matrix3::Identity()));
}

TYPED_TEST(Mandel6And4, CorotationIsCommutatorWithSpin) {
  constexpr int kSize = TestFixture::N;
  for (int i = 0; i < 20; ++i) {
    const Matrix3 t = this->tensor();
    Eigen::Vector3d spin(this->number(), 0.0, 0.0);
    if (kSize == kGeneral) spin.tail<2>() << this->number(), this->number();
    Matrix3 w = Matrix3::Zero();
    w(0, 1) = spin[0];
    w(0, 2) = spin[1];
    w(1, 2) = spin[2];
    w -= w.transpose().eval();
    const auto rate = corotation<double, kSize>(this->mandel(t), spin);
    EXPECT_LE((rate - this->mandel(w * t - t * w)).norm(), kRoundOff);
  }
}

using MandelVoigt = RandomTensors;

TEST_F(MandelVoigt, StressTimesEngineeringStrainIsDoubleContraction) {
  for (int i = 0; i < 20; ++i) {
    const Mandel<double> stress = mandel_from_matrix<double>(symmetric(false));
    const Mandel<double> strain = mandel_from_matrix<double>(symmetric(false));
    const double work =
        voigt_stress_from_mandel<double>(stress).dot(voigt_strain_from_mandel<double>(strain));
    EXPECT_NEAR(work, stress.dot(strain), kRoundOff);
  }
}

TEST_F(MandelVoigt, RoundTripsAreIdentities) {
  for (int i = 0; i < 20; ++i) {
    const Mandel<double> a = mandel_from_matrix<double>(symmetric(false));
    EXPECT_LE((mandel_from_voigt_stress<double>(voigt_stress_from_mandel<double>(a)) - a).norm(), kRoundOff);
    EXPECT_LE((mandel_from_voigt_strain<double>(voigt_strain_from_mandel<double>(a)) - a).norm(), kRoundOff);
    EXPECT_LE((mandel_from_components<double>(components_from_mandel<double>(a)) - a).norm(), kRoundOff);
  }
}

TEST_F(MandelVoigt, ComponentsStandInTheOrder11_22_33_12_13_23) {
  Matrix3 a;
  a << 1, 4, 5, 4, 2, 6, 5, 6, 3;
  const auto c = components_from_mandel<double>(mandel_from_matrix<double>(a));
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(c[i], i + 1.0, 2e-15);
  const auto engineering = voigt_strain_from_mandel<double>(mandel_from_matrix<double>(a));
  for (int i = 3; i < 6; ++i) EXPECT_NEAR(engineering[i], 2.0 * (i + 1.0), 4e-15);
}

TEST_F(MandelVoigt, OnlyTheSymmetricPartOfAMatrixIsTaken) {
  Matrix3 skew;
  skew << 0, 1, 2, -1, 0, 3, -2, -3, 0;
  EXPECT_EQ(mandel_from_matrix<double>(skew), Mandel<double>::Zero());
}

}  // namespace
}  // namespace isotach::model
