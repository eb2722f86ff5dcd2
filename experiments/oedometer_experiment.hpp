// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An oedometer test: what the apparatus did goes in, what it read comes out.
#pragma once

#include "effects/values.hpp"
#include "experiments/experiment.hpp"
#include "experiments/oedometer_protocol.hpp"
#include "experiments/path_point.hpp"
#include "experiments/wander.hpp"

namespace isotach::experiments {

class OedometerExperiment final : public Experiment {
 public:
  /// `effects` are on, those of other tests' kinds too, which do nothing here; of the parameters `free` the
  /// values are inputs. std::invalid_argument where nothing is left to be compared, where an effect needs
  /// what the test does not have, or where a parameter is free whose effect is off.
  explicit OedometerExperiment(datasets::OedometerTest test, effects::Values<double> effects = {},
                               std::vector<effects::ParameterRef> free = {});

  [[nodiscard]] const std::string& name() const override { return test_.name; }
  [[nodiscard]] bool held_out() const override { return test_.hold_out; }
  [[nodiscard]] const Values& measured() const override { return measured_; }
  [[nodiscard]] std::string_view quantity() const override;
  [[nodiscard]] const Values& noise() const override { return noise_; }
  [[nodiscard]] std::vector<Channel> channels() const override;
  /// K0 and OCR of the start, where the study lets them move, then the effects' free parameters.
  [[nodiscard]] std::vector<LocalQuantity> locals() const override;
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict(const model::Parameters<double>& parameters,
                                                                std::span<const double> local) const override;
  /// Exact, by automatic differentiation through the integrator.
  [[nodiscard]] tl::expected<Linearisation, PredictionFailure> linearise(
      const model::Parameters<double>& parameters, std::span<const double> local,
      const Eigen::MatrixXd& directions) const override;

  /// Predictions, and their derivatives by the coefficients (zero) of functions along which a slot wanders:
  /// `functions` has a column for each, a row for the start and for every step's end.
  [[nodiscard]] tl::expected<Linearisation, PredictionFailure> linearise_wander(
      const model::Parameters<double>& parameters, std::span<const double> local, Slot slot,
      const Eigen::MatrixXd& functions) const;

  [[nodiscard]] const datasets::OedometerTest& test() const { return test_; }
  /// The effects that are on, as given; and with the free parameters of `local`.
  [[nodiscard]] const effects::Values<double>& effects() const { return effects_; }
  [[nodiscard]] tl::expected<effects::Values<double>, PredictionFailure> effects_at(
      std::span<const double> local) const;
  [[nodiscard]] const std::vector<effects::ParameterRef>& free_effects() const { return free_; }
  [[nodiscard]] const OedometerProtocol& protocol() const { return protocol_; }
  [[nodiscard]] const std::vector<ComparedValue>& values() const { return protocol_.values; }
  /// The reading behind a value.
  [[nodiscard]] const datasets::OedometerRow& row_of(const ComparedValue& value) const {
    return test_.record.rows[value.row];
  }
  /// Void ratio of a reading, by the height (-).
  [[nodiscard]] double void_ratio_of(const datasets::OedometerRow& row) const {
    return (1.0 + test_.void_ratio) * (1.0 - row.axial_strain) - 1.0;
  }
  /// The start and the end of every step of the history.
  [[nodiscard]] tl::expected<std::vector<PathPoint>, PredictionFailure> path(
      const model::Parameters<double>& parameters, std::span<const double> local, Route route) const;
  /// The values that a path means.
  [[nodiscard]] Values values_of(const std::vector<PathPoint>& path) const;

 private:
  template <int Width>
  [[nodiscard]] tl::expected<Linearisation, PredictionFailure> linearise_with(
      const model::Parameters<double>& parameters, std::span<const double> local,
      const Eigen::MatrixXd& directions) const;

  datasets::OedometerTest test_;
  OedometerProtocol protocol_;
  effects::Values<double> effects_;
  std::vector<effects::ParameterRef> free_;
  Values measured_;
  Values noise_;
};

}  // namespace isotach::experiments
