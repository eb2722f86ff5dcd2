// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How plainly an effect shows in slump tests.
#pragma once

#include <array>
#include <optional>

#include "bench/discovery/slump_generator.hpp"
#include "discovery/linear_model.hpp"

namespace isotach::bench {

/// Standard errors that oedometer tests leave.
struct KnownBeforehand {
  double viscosity;  ///< of I_v, relative
  double c1;         ///< of C_1
};

/// Signal-to-noise ratio of effects: by the covariance of the outlines and of discovery's simulations, freed
/// of what the base's parameters, as far as they are not known, and errors that all tests share can do.
///
/// Two simulations differ by sigmas for no reason, and what an effect does to one is that and the effect. So
/// it is simulated by two numerics, and what counts is what both have: the root of the product of the two
/// changes.
class SlumpVisibility {
 public:
  /// The numerics have measured the truth without effects. Nothing where what is near it cannot be simulated.
  [[nodiscard]] static std::optional<SlumpVisibility> at(const std::array<SlumpGenerator, 2>& numerics,
                                                         const calibration::SimulationError& error,
                                                         const KnownBeforehand& known);

  /// What the effects change in the fitted tests' stations, decorrelated, and the base does not take up.
  struct Shown {
    double ratio;          ///< signal to noise; kLeast where the numerics do not agree on anything
    Eigen::VectorXd left;  ///< mean of the two numerics
  };
  /// Nothing where the effects cannot be simulated.
  [[nodiscard]] std::optional<Shown> of(const effects::Values<double>& effects) const;
  static constexpr double kLeast = 0.3;

 private:
  /// What one numerics has without effects, and what the base can do there.
  struct View {
    SlumpGenerator generator;
    Eigen::VectorXd unchanged;
    Eigen::Index rows;
    discovery::Projection base;
  };
  SlumpVisibility(std::vector<View> views, const calibration::SimulationError& error)
      : views_(std::move(views)), error_(error) {}

  [[nodiscard]] static std::optional<View> view_of(const SlumpGenerator& generator,
                                                   const calibration::SimulationError& error,
                                                   const KnownBeforehand& known);

  std::vector<View> views_;
  calibration::SimulationError error_;
};

}  // namespace isotach::bench
