// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The coefficients of the Rosenbrock method.
#pragma once

#include <array>
#include <cstddef>

namespace isotach::integrators {

/// RODAS5P: eight stages, order 5 with an embedded solution of order 4, stiffly accurate, both L-stable;
/// keeps its order on stiff problems whose solution is driven by the forcing (Prothero-Robinson), such as
/// steady compression.
///
/// Source: G. Steinebach, Construction of Rosenbrock-Wanner method Rodas5P and numerical benchmarks within
/// the Julia Differential Equations package, BIT Numer. Math. 63 (2023) 27. In the form free of products with
/// the Jacobian (Hairer and Wanner, Solving Ordinary Differential Equations II, eq. IV.7.25): over a step h
/// from y
///
///   u_i = y + sum_{j<i} a_ij k_j,   (1/(h gamma) - J) k_i = f(u_i) + sum_{j<i} (C_ij/h) k_j,
///
/// the embedded solution is u_8, the solution u_8 + k_8, so that k_8 estimates the error.
struct Rodas5P {
  static constexpr std::size_t kStages = 8;
  static constexpr int kOrder = 5;
  static constexpr int kEmbeddedOrder = 4;

  static constexpr double kGamma = 0.21193756319429014;

  /// a_ij at [i][j], both from 0.
  static constexpr std::array<std::array<double, kStages>, kStages> kA{{
      {},
      {3.0},
      {2.849394379747939, 0.45842242204463923},
      {-6.954028509809101, 2.489845061869568, -10.358996098473584},
      {2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641},
      {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256,
       0.030198172008377946},
      {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946,
       1.0},
      {-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946,
       1.0, 1.0},
  }};

  /// C_ij at [i][j], both from 0.
  static constexpr std::array<std::array<double, kStages>, kStages> kC{{
      {},
      {-14.155112264123755},
      {-17.97296035885952, -2.859693295451294},
      {147.12150275711716, -1.41221402718213, 71.68940251302358},
      {165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306},
      {24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471},
      {30.91273214028599, -3.1208243349937974, 77.79954646070892, 34.28646028294783, -19.097331116725623,
       -28.087943162872662},
      {37.80277123390563, -3.2571969029072276, 112.26918849496327, 66.9347231244047, -40.06618937091002,
       -54.66780262877968, -9.48861652309627},
  }};
};

}  // namespace isotach::integrators
