// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slot of a model at a time is let wander: whether that closes the gap, and what the slot would have to
// do. It finds disagreements that no effect of the catalogue resembles, and describes them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.hpp"

namespace isotach::discovery {

/// What a slot wanders over.
struct WanderAxis {
  std::string_view name;   ///< "time"
  std::string_view words;  ///< "the time of each test"
  std::string_view label;  ///< of a drawn axis, with its unit
  double unit;             ///< of that, SI
  bool logarithmic;        ///< drawn so
};

/// What wanders.
struct WanderedSlot {
  std::string_view name;
  const WanderAxis* along;
  bool logarithmic;            ///< changes are those of a logarithm
  std::string_view unit = {};  ///< in which other changes are shown
  double unit_size = 1.0;      ///< of that, SI

  /// "D_r over the time of each test".
  [[nodiscard]] std::string title() const;
};

/// A slot's change as a polygon over knots.
struct WanderCurve {
  std::string test;               ///< empty where it is that of all tests
  std::vector<double> at;         ///< SI
  std::vector<double> change;     ///< SI, or of the logarithm
  std::vector<double> std_error;  ///< of `change`, by the noise alone
};

struct WanderingSlot {
  WanderedSlot slot;
  std::size_t freedom = 0;  ///< directions that the data show and the model's parameters cannot follow
  double gain = 0.0;        ///< of chi-squared, to first order
  double p_value = 1.0;     ///< that noise gains as much, of this slot alone
  /// The same as a standard normal deviate, which tells slots apart where p is zero to a computer: the cube
  /// root of Wilson and Hilferty, Proc. Nat. Acad. Sci. 17 (1931) 684-688. Least where there is no freedom.
  double stands_out = 0.0;
  std::vector<WanderCurve> curves;
  /// Of an oedometer: what it changes in the fitted tests, in their order, in units of the stated noise,
  /// beyond what the model's parameters take up.
  std::vector<experiments::Values> change;
};

struct Wandering {
  std::vector<WanderingSlot> slots;  ///< that which stands out most first
  /// Probability that noise makes the first stand out as far, by parametric bootstrap; at least
  /// 1/(kReplicates + 1), which stands for "less than that".
  double p_value = 1.0;
};

/// A slot on top of a model, before it is known how far it stands out.
struct WanderTrial {
  WanderingSlot slot;      ///< without curves
  Eigen::VectorXd change;  ///< at the knots, that improves the fit most
  Eigen::VectorXd std_error;
  Eigen::MatrixXd basis;  ///< orthonormal, of what the slot can do and the model's parameters cannot
};

/// `left` has, in a column for each knot, what a change of `plausible` size makes of the residuals, freed of
/// what the model's parameters can do.
[[nodiscard]] WanderTrial try_slot(const WanderedSlot& slot, const Eigen::MatrixXd& left, double plausible,
                                   const Eigen::VectorXd& residuals);

/// The slots by how far they stand out.
[[nodiscard]] Wandering ranked(std::vector<WanderTrial> trials);

}  // namespace isotach::discovery
