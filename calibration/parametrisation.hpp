// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The coordinates a fit moves in, and the parameters they stand for: logarithms, bounds and the gauge.
#pragma once

#include <string>
#include <vector>

#include "datasets/study.hpp"
#include "integrators/steady_oedometric.hpp"
#include "model/parameters.hpp"

namespace isotach::calibration {

/// How a gauge ties D_r to the other parameters.
struct GaugeChoice {
  datasets::Gauge kind = datasets::Gauge::fixed;
  double reference_rate = 0.0;  ///< axial strain rate (1/s) of Gauge::crs_rate
};

/// Free parameters as coordinates: ln of positive ones, C_1 as it is.
///
/// (e100, D_r) enter any prediction only through D_r (1+e100)^(-1/(lambda I_v)). Under Gauge::crs_rate D_r is
/// therefore not a coordinate but the |D_vis| of steady oedometric compression at the reference rate, a
/// function of lambda, kappa, phi_c and C_1; then OCR = 1 on that isotach and e100 is read off it.
class Parametrisation {
 public:
  /// `wanted` are the parameters a study wants moved; `bounds` in SI, in the order of ParameterId, defaults
  /// where absent.
  Parametrisation(const model::Parameters<double>& start, const std::vector<model::ParameterId>& wanted,
                  const std::array<std::optional<datasets::Bounds>, model::kParameterCount>& bounds,
                  const GaugeChoice& gauge);

  /// The parameters that are coordinates, in order.
  [[nodiscard]] const std::vector<model::ParameterId>& free() const { return free_; }
  /// Whether D_r follows from the others by the gauge.
  [[nodiscard]] bool gauged() const { return gauged_; }
  [[nodiscard]] const GaugeChoice& gauge() const { return gauge_; }
  [[nodiscard]] const std::vector<double>& start() const { return start_; }
  [[nodiscard]] const std::vector<double>& lower() const { return lower_; }
  [[nodiscard]] const std::vector<double>& upper() const { return upper_; }
  /// Whether coordinate k is the logarithm of its parameter.
  [[nodiscard]] bool logarithmic(std::size_t k) const { return !model::may_be_zero(free_[k]); }

  /// The parameters at coordinates x (size of free()). Fails where they are not admissible together.
  template <class S>
  [[nodiscard]] tl::expected<model::Parameters<S>, std::string> at(const std::vector<S>& x) const {
    using std::exp;
    model::ParameterValues<S> values;
    values.lode = base_.lode;
    for (const auto& parameter : model::kParameterTable) values[parameter.id] = S(base_[parameter.id]);
    for (std::size_t k = 0; k < free_.size(); ++k) values[free_[k]] = logarithmic(k) ? exp(x[k]) : x[k];
    auto parameters = model::Parameters<S>::create(values);
    if (!parameters) return tl::unexpected(parameters.error().message());
    if (!gauged_) return *parameters;
    const auto steady = integrators::steady_oedometric(*parameters, gauge_.reference_rate);
    if (!steady) return tl::unexpected(steady.error());
    values[model::ParameterId::D_r] = steady->viscous_rate;
    return *model::Parameters<S>::create(values);
  }

  /// The parameters at x and their derivatives: column k is d(parameters in SI)/dx_k.
  struct Tangent {
    model::Parameters<double> parameters;
    Eigen::MatrixXd derivative;  ///< kParameterCount x free().size()
  };
  [[nodiscard]] tl::expected<Tangent, std::string> tangent(const std::vector<double>& x) const;

 private:
  model::ParameterValues<double> base_;
  std::vector<model::ParameterId> free_;
  bool gauged_ = false;
  GaugeChoice gauge_;
  std::vector<double> start_;
  std::vector<double> lower_;
  std::vector<double> upper_;
};

/// Bounds used where a study gives none (SI).
[[nodiscard]] datasets::Bounds default_bounds(model::ParameterId id);

}  // namespace isotach::calibration
