// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An oedometer test: what the apparatus did goes in, what it read comes out.
#pragma once

#include "experiments/experiment.hpp"
#include "experiments/oedometer_protocol.hpp"

namespace isotach::experiments {

/// A point of a test as the model goes through it. Compression positive.
struct PathPoint {
  double time;          ///< s
  std::size_t row;      ///< of the record; kNoRow at the start, if no reading is the start
  double axial_stress;  ///< Pa
  double axial_strain;  ///< engineering (-)
  double void_ratio;    ///< the law's (-)
  double K0;            ///< radial over axial effective stress (-)
  double ocr;           ///< p_B/p_B+ (-)
};

/// Which integrator makes a path.
enum class Route {
  fellin_ostermann,  ///< the one that fits use
  cvode              ///< the reference
};

class OedometerExperiment final : public Experiment {
 public:
  /// std::invalid_argument where nothing is left to be compared.
  explicit OedometerExperiment(datasets::OedometerTest test);

  [[nodiscard]] const std::string& name() const override { return test_.name; }
  [[nodiscard]] bool held_out() const override { return test_.hold_out; }
  [[nodiscard]] const Values& measured() const override { return measured_; }
  [[nodiscard]] std::string_view quantity() const override;
  [[nodiscard]] const Values& noise() const override { return noise_; }
  [[nodiscard]] std::vector<Channel> channels() const override;
  /// K0 and OCR of the start, where the study lets them move.
  [[nodiscard]] std::vector<LocalQuantity> locals() const override;
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict(const model::Parameters<double>& parameters,
                                                                std::span<const double> local) const override;
  /// Exact, by automatic differentiation through the integrator.
  [[nodiscard]] tl::expected<Linearisation, PredictionFailure> linearise(
      const model::Parameters<double>& parameters, std::span<const double> local,
      const Eigen::MatrixXd& directions) const override;

  [[nodiscard]] const datasets::OedometerTest& test() const { return test_; }
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
  datasets::OedometerTest test_;
  OedometerProtocol protocol_;
  Values measured_;
  Values noise_;
};

}  // namespace isotach::experiments
