// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The coordinates a fit moves in, and what they stand for: logarithms, bounds, priors and the gauge.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "datasets/study.hpp"
#include "experiments/experiment.hpp"
#include "integrators/steady_oedometric.hpp"
#include "model/parameters.hpp"

namespace isotach::calibration {

using Experiments = std::vector<std::shared_ptr<const experiments::Experiment>>;

/// How a gauge ties D_r to the other parameters.
struct GaugeChoice {
  datasets::Gauge kind = datasets::Gauge::fixed;
  double reference_rate = 0.0;  ///< axial strain rate (1/s) of Gauge::crs_rate
};

/// A normal distribution of a coordinate.
struct CoordinatePrior {
  double mean;
  double std_error;
};

/// One coordinate: a material parameter, one of an effect, or a quantity of tests' start.
struct Coordinate {
  std::string name;                             ///< "lambda", "ring_friction.mu", "crs-1: K0"
  std::optional<model::ParameterId> id;         ///< of a material parameter
  std::optional<effects::ParameterRef> effect;  ///< of an effect's
  bool shared = false;                          ///< beside the material: one value for all experiments
  std::size_t experiment = 0;                   ///< else: which of the experiments
  std::size_t local = 0;                        ///< and which of its local quantities
  bool logarithmic = false;                     ///< the coordinate is the logarithm of the quantity
  double scale = 1.0;  ///< else the coordinate times this is the quantity: an effect's typical value
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  std::optional<CoordinatePrior> prior{};

  /// The quantity (SI) that a value of the coordinate stands for.
  [[nodiscard]] double quantity(double x) const { return logarithmic ? std::exp(x) : scale * x; }
  /// The value of the coordinate that stands for a quantity (SI).
  [[nodiscard]] double of_quantity(double quantity) const {
    return logarithmic ? std::log(quantity) : quantity / scale;
  }
  /// d quantity/dx.
  [[nodiscard]] double slope(double x) const { return logarithmic ? std::exp(x) : scale; }
  /// Width about x in which searches from elsewhere look: that of the bounds, but for an effect, whose bounds
  /// are those of the possible, some times its typical value or x.
  [[nodiscard]] double search_width(double x) const;
};

/// What a study says of the coordinates; of the material's in the order of ParameterId.
struct CoordinateSettings {
  std::array<std::optional<datasets::Bounds>, model::kParameterCount> bounds{};
  std::array<std::optional<datasets::Prior>, model::kParameterCount> priors{};
  std::vector<datasets::FreeEffect> effects{};  ///< of which the bounds are read
};

/// Free quantities as coordinates: ln of positive ones, C_1 and K0 as they are, an effect's that may be zero
/// over its typical value.
///
/// (e100, D_r) enter any prediction only through D_r (1+e100)^(-1/(lambda I_v)). Under Gauge::crs_rate D_r is
/// therefore not a coordinate but the |D_vis| of steady oedometric compression at the reference rate, a
/// function of lambda, kappa, phi_c and C_1; then OCR = 1 on that isotach and e100 is read off it.
class Parametrisation {
 public:
  /// `wanted` are the parameters a study wants moved; bounds in SI, defaults where absent. The effects' free
  /// parameters of those `experiments` that are not held out follow the material's coordinates, each once,
  /// then their local quantities.
  Parametrisation(const model::Parameters<double>& start, const std::vector<model::ParameterId>& wanted,
                  const CoordinateSettings& settings, const GaugeChoice& gauge,
                  const Experiments& experiments = {});

  /// All coordinates, the material's first.
  [[nodiscard]] const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  [[nodiscard]] std::size_t size() const { return coordinates_.size(); }
  /// The material parameters that are coordinates, in order.
  [[nodiscard]] const std::vector<model::ParameterId>& free() const { return free_; }
  /// Whether D_r follows from the others by the gauge.
  [[nodiscard]] bool gauged() const { return gauged_; }
  [[nodiscard]] const GaugeChoice& gauge() const { return gauge_; }
  [[nodiscard]] std::vector<double> start() const;
  [[nodiscard]] std::vector<double> lower() const;
  [[nodiscard]] std::vector<double> upper() const;
  /// Whether x_k lies on a bound of its coordinate, to the accuracy of an optimiser.
  [[nodiscard]] bool at_bound(const std::vector<double>& x, std::size_t k) const;
  /// x moved into the bounds.
  [[nodiscard]] std::vector<double> inside(std::vector<double> x) const;

  /// The parameters at coordinates x. Fails where they are not admissible together.
  template <class S>
  [[nodiscard]] tl::expected<model::Parameters<S>, std::string> at(const std::vector<S>& x) const {
    using std::exp;
    model::ParameterValues<S> values;
    values.lode = base_.lode;
    for (const auto& parameter : model::kParameterTable) values[parameter.id] = S(base_[parameter.id]);
    for (std::size_t k = 0; k < free_.size(); ++k) {
      values[free_[k]] = coordinates_[k].logarithmic ? exp(x[k]) : x[k];
    }
    auto parameters = model::Parameters<S>::create(values);
    if (!parameters) return tl::unexpected(parameters.error().message());
    if (!gauged_) return *parameters;
    const auto steady = integrators::steady_oedometric(*parameters, gauge_.reference_rate);
    if (!steady) return tl::unexpected(steady.error());
    values[model::ParameterId::D_r] = steady->viscous_rate;
    return *model::Parameters<S>::create(values);
  }

  /// Local quantities of an experiment at x: the study's, where they are no coordinates.
  [[nodiscard]] std::vector<double> local_at(const std::vector<double>& x, std::size_t experiment) const;
  /// The same of an experiment that need not be among those of this parametrisation: its own start, and the
  /// effects' parameters at x.
  [[nodiscard]] std::vector<double> local_of(const experiments::Experiment& experiment,
                                             const std::vector<double>& x) const;

  /// The parameters at x and their derivatives: column k is d(parameters in SI)/dx_k.
  struct Tangent {
    model::Parameters<double> parameters;
    Eigen::MatrixXd derivative;  ///< kParameterCount x size()
  };
  [[nodiscard]] tl::expected<Tangent, std::string> tangent(const std::vector<double>& x) const;
  /// The derivatives with the rows of an experiment's local quantities below: what Experiment::linearise
  /// takes.
  [[nodiscard]] Eigen::MatrixXd directions(const Tangent& tangent, const std::vector<double>& x,
                                           std::size_t experiment) const;

 private:
  [[nodiscard]] std::optional<std::size_t> find(const experiments::LocalQuantity& shared) const;
  void set_shared(const std::vector<experiments::LocalQuantity>& locals, const std::vector<double>& x,
                  std::vector<double>& values) const;

  model::ParameterValues<double> base_;
  std::vector<Coordinate> coordinates_;
  std::vector<model::ParameterId> free_;
  std::vector<std::vector<experiments::LocalQuantity>> locals_;  // of each experiment
  bool gauged_ = false;
  GaugeChoice gauge_;
};

/// Bounds used where a study gives none (SI).
[[nodiscard]] datasets::Bounds default_bounds(model::ParameterId id);

}  // namespace isotach::calibration
