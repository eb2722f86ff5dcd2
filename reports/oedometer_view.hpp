// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// One test of an oedometer fit as its figures and curve files show it: data, model and residuals together.
#pragma once

#include <memory>
#include <vector>

#include "calibration/fit_oedometer.hpp"
#include "integrators/isotach.hpp"

namespace isotach::reports {

/// A test, how it is met, and the model's way through it. Refers to the fit, which must outlive it.
struct TestView {
  const experiments::OedometerExperiment& experiment;
  const calibration::TestSummary& summary;
  const experiments::Values& scaled;  ///< (predicted - measured)/noise of each compared value
  experiments::Values white;          ///< the same freed of the estimated noise; none of a held-out test
  std::vector<experiments::PathPoint> path;    ///< of the model, at the answer; empty where there is none
  std::vector<integrators::Isotach> isotachs;  ///< at decades of rate, the slowest first
  /// (1 + e by the height)/(1 + e of the law): not 1 where the start is given by an overconsolidation ratio.
  double drawn_over_law = 1.0;

  /// Void ratio by the height (-) of a strain since the start of the test.
  [[nodiscard]] double void_ratio_of_strain(double axial_strain) const {
    return (1.0 + experiment.test().void_ratio) * (1.0 - axial_strain) - 1.0;
  }
  /// The strain of a void ratio by the height.
  [[nodiscard]] double strain_of_void_ratio(double void_ratio) const {
    return 1.0 - (1.0 + void_ratio) / (1.0 + experiment.test().void_ratio);
  }
  /// Void ratio by the height on an isotach (-), at an axial effective stress (Pa).
  [[nodiscard]] double void_ratio_on(const integrators::Isotach& isotach, double axial_stress) const {
    return (1.0 + isotach.void_ratio_at(axial_stress)) * drawn_over_law - 1.0;
  }
  /// Whether loads were put on and the strain answered.
  [[nodiscard]] bool stepwise() const {
    return experiment.test().record.control == datasets::Control::stress;
  }
};

/// Views of all tests of a fit.
[[nodiscard]] std::vector<TestView> views_of(const calibration::OedometerFit& fit);

/// A compression curve as an engineer draws it.
struct CompressionCurve {
  std::vector<double> stress;      ///< kPa
  std::vector<double> void_ratio;  ///< by the height (-)
};

/// All readings, or the last one under each load of a stepwise test.
[[nodiscard]] CompressionCurve measured_curve(const TestView& view);
/// The model's, at the same readings and its start.
[[nodiscard]] CompressionCurve model_curve(const TestView& view);

}  // namespace isotach::reports
