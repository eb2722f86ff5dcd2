// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One slot of the model at a time is let wander, over the time of each test or over stress: whether that
// closes the gap, and what the slot would have to do. It finds disagreements that no effect of the catalogue
// resembles, and describes them.
#pragma once

#include <vector>

#include "discovery/candidate.hpp"

namespace isotach::discovery {

/// What a slot wanders over.
enum class Along {
  time,   ///< of each test, a function for each
  stress  ///< ln of the stress read, one function for all tests
};
[[nodiscard]] std::string_view name_of(Along along);

/// A slot's change as a polygon over knots.
struct WanderCurve {
  std::string test;               ///< empty where it is that of all tests
  std::vector<double> at;         ///< s, or Pa
  std::vector<double> change;     ///< as SlotInfo has it
  std::vector<double> std_error;  ///< of `change`, by the noise alone
};

struct WanderingSlot {
  experiments::Slot slot;
  Along along;
  std::size_t freedom = 0;  ///< directions that the data show and the model's parameters cannot follow
  double gain = 0.0;        ///< of chi-squared, to first order
  double p_value = 1.0;     ///< that noise gains as much, of this slot alone
  /// The same as a standard normal deviate, which tells slots apart where p is zero to a computer: the cube
  /// root of Wilson and Hilferty, Proc. Nat. Acad. Sci. 17 (1931) 684-688.
  double stands_out = 0.0;
  std::vector<WanderCurve> curves;
  /// What it changes in the fitted tests, in their order, in units of the stated noise, beyond what the
  /// model's parameters take up.
  std::vector<experiments::Values> change;
};

struct Wandering {
  std::vector<WanderingSlot> slots;  ///< that which stands out most first
  /// Probability that noise makes the first stand out as far, by parametric bootstrap; at least
  /// 1/(kReplicates + 1), which stands for "less than that".
  double p_value = 1.0;
};

/// Lets each slot wander on top of `model`, by `weights` (of the fitted tests, as NoiseFit's).
[[nodiscard]] tl::expected<Wandering, calibration::FitFailure> let_wander(
    const datasets::Study& study, const Candidate& model,
    const std::vector<calibration::ExperimentWeights>& weights, int threads);

}  // namespace isotach::discovery
