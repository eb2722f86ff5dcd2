// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the law draws in the p-q plane of triaxial states: critical state and preconsolidation ellipse.
#pragma once

#include <cstddef>
#include <vector>

#include "model/mandel.hpp"
#include "model/parameters.hpp"

namespace isotach::reports {

/// Points of a curve in the p-q plane (in the unit of the pressure they were asked for with); q is the axial
/// less the lateral stress, positive in compression.
struct PlaneCurve {
  std::vector<double> p;
  std::vector<double> q;
};

/// The p-q plane of a material.
class StressPlane {
 public:
  explicit StressPlane(const model::Parameters<double>& material);

  /// q/p at the critical state in triaxial compression, M.
  [[nodiscard]] double compression_ratio() const { return compression_; }
  /// |q|/p at the critical state in triaxial extension: (3 - sin phi_c)/(3 + sin phi_c) M, or M where
  /// strength does not depend on the Lode angle.
  [[nodiscard]] double extension_ratio() const { return extension_; }

  /// The triaxial states about `axis` (0, 1, 2) whose equivalent pressure p_B+ is `p_B`, with the anisotropy
  /// tensor `omega` (the law's, tension positive): from the isotropic state through compression to p = 0,
  /// preceded, where `with_extension`, by those in extension.
  [[nodiscard]] PlaneCurve ellipse(double p_B, const model::Mandel<double>& omega, std::size_t axis,
                                   bool with_extension) const;

 private:
  double compression_;
  double extension_;
  bool lode_dependent_;
};

}  // namespace isotach::reports
