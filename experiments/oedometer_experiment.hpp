// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A strain-driven oedometer test: the measured strain history goes in, ln of axial effective stress comes
// out.
#pragma once

#include <optional>

#include "datasets/study.hpp"
#include "experiments/experiment.hpp"
#include "model/law.hpp"

namespace isotach::experiments {

/// One step of the strain history, from the row before (or the start) to a row.
struct StrainStep {
  double duration;  ///< s, > 0
  double strain;    ///< logarithmic axial strain increment (-), compression positive
};

/// Where the specimen starts.
struct OedometerStart {
  double time;          ///< s
  double axial_strain;  ///< engineering (-)
  double axial_stress;  ///< Pa, compression positive
  double K0;
  double void_ratio;
};

class OedometerExperiment final : public Experiment {
 public:
  explicit OedometerExperiment(datasets::OedometerTest test);

  [[nodiscard]] const std::string& name() const override { return test_.name; }
  [[nodiscard]] bool held_out() const override { return test_.hold_out; }
  [[nodiscard]] const Values& measured() const override { return log_stress_; }
  [[nodiscard]] std::string_view quantity() const override { return "ln(axial effective stress)"; }
  [[nodiscard]] const Values& noise() const override { return noise_; }
  [[nodiscard]] tl::expected<Values, PredictionFailure> predict(
      const model::Parameters<double>& parameters) const override;
  /// Exact, by automatic differentiation through the integrator.
  [[nodiscard]] tl::expected<Linearisation, PredictionFailure> linearise(
      const model::Parameters<double>& parameters,
      std::span<const model::ParameterId> with_respect_to) const override;

  [[nodiscard]] const datasets::OedometerTest& test() const { return test_; }
  [[nodiscard]] const OedometerStart& start() const { return start_; }
  /// The rows that are compared: all, or all but the first where that is the start.
  [[nodiscard]] std::span<const datasets::OedometerRow> rows() const {
    return std::span(test_.record.rows).subspan(first_row_);
  }
  /// One for each of rows().
  [[nodiscard]] const std::vector<StrainStep>& steps() const { return steps_; }
  /// Void ratio at each of rows(), from the strains that drive the model.
  [[nodiscard]] const Values& void_ratios() const { return void_ratios_; }
  /// Axial strain rate (1/s, logarithmic, > 0) of the first loading stage, from its ends; nothing where the
  /// test has no loading.
  [[nodiscard]] std::optional<double> first_loading_rate() const;

 private:
  template <class S>
  tl::expected<std::vector<S>, PredictionFailure> predict_log_stress(
      const model::Parameters<S>& parameters) const;

  datasets::OedometerTest test_;
  OedometerStart start_{};
  std::size_t first_row_ = 0;
  std::vector<StrainStep> steps_;
  Values log_stress_;
  Values noise_;
  Values void_ratios_;
};

}  // namespace isotach::experiments
