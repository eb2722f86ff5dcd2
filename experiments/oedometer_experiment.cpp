// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/oedometer_experiment.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/strain_history.hpp"
#include "integrators/fellin_ostermann.hpp"

namespace isotach::experiments {

namespace {

constexpr double kIntegrationTolerance = 4e-6;  // relative; far below any reading's noise

/// Largest |d ln sigma/d strain| of a stage as its ends show it: what a strain reading's noise does to ln
/// sigma.
std::vector<double> stage_slopes(const datasets::OedometerRecord& record,
                                 std::span<const datasets::OedometerRow> rows) {
  std::vector<double> slopes(rows.size(), 0.0);
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin + 1;
    while (end < rows.size() && rows[end].stage == rows[begin].stage) ++end;
    const double strain = rows[end - 1].axial_strain - rows[begin].axial_strain;
    if (!holds_strain(record, rows[begin].stage) && strain != 0.0) {
      const double slope = std::abs(std::log(rows[end - 1].axial_stress / rows[begin].axial_stress) / strain);
      for (std::size_t i = begin; i < end; ++i) slopes[i] = slope;
    }
    begin = end;
  }
  return slopes;
}

}  // namespace

OedometerExperiment::OedometerExperiment(datasets::OedometerTest test) : test_(std::move(test)) {
  const auto& all = test_.record.rows;
  const std::vector<double> strain = commanded_strain(test_.record);
  if (test_.initial_axial_stress) {
    start_ = {0.0, 0.0, *test_.initial_axial_stress, test_.initial_K0, test_.void_ratio};
    // a first row at time 0 is the start itself
    first_row_ = all.front().time > 0.0 ? 0 : 1;
  } else {
    start_ = {all.front().time, strain.front(), all.front().axial_stress, test_.initial_K0,
              (1.0 + test_.void_ratio) * (1.0 - strain.front()) - 1.0};
    first_row_ = 1;
  }
  const std::vector<double> slopes = stage_slopes(test_.record, rows());
  double time = start_.time;
  double height = 1.0 - start_.axial_strain;  // present over first height
  double void_ratio = start_.void_ratio;
  for (std::size_t i = 0; i < rows().size(); ++i) {
    const datasets::OedometerRow& row = rows()[i];
    const double next_height = 1.0 - strain[first_row_ + i];
    steps_.push_back({row.time - time, std::log(height / next_height)});
    void_ratio = (1.0 + void_ratio) * next_height / height - 1.0;
    void_ratios_.push_back(void_ratio);
    time = row.time;
    height = next_height;

    log_stress_.push_back(std::log(row.axial_stress));
    const double floor = test_.noise.stress_floor / row.axial_stress;
    const double from_strain = test_.noise.strain * slopes[i];
    noise_.push_back(std::sqrt(test_.noise.stress_relative * test_.noise.stress_relative + floor * floor +
                               from_strain * from_strain));
  }
}

std::optional<double> OedometerExperiment::first_loading_rate() const {
  double strain = 0.0;
  double time = 0.0;
  for (std::size_t i = 0; i < rows().size(); ++i) {
    if (rows()[i].stage == datasets::Stage::load) {
      strain += steps_[i].strain;
      time += steps_[i].duration;
    } else if (time > 0.0) {
      break;
    }
  }
  if (!(strain > 0.0 && time > 0.0)) return std::nullopt;
  return strain / time;
}

template <class S>
tl::expected<std::vector<S>, PredictionFailure> OedometerExperiment::predict_log_stress(
    const model::Parameters<S>& parameters) const {
  using std::log;
  const model::Law<S> law(parameters);
  model::State<S> state;
  state.stress.setConstant(S(0.0));
  state.stress[0] = S(-start_.axial_stress);
  state.stress[1] = state.stress[2] = S(-start_.axial_stress * start_.K0);
  state.void_ratio = S(start_.void_ratio);
  integrators::Tolerance tolerance;
  tolerance.relative = kIntegrationTolerance;

  std::vector<S> log_stress;
  log_stress.reserve(steps_.size());
  double substep = 0.0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    model::Mandel<S> strain_rate = model::Mandel<S>::Constant(S(0.0));
    strain_rate[0] = S(-steps_[i].strain / steps_[i].duration);
    const auto increment = integrators::strain_increment<S>(strain_rate, steps_[i].duration);
    auto result = integrators::integrate_fellin_ostermann(law, state, increment, tolerance, substep);
    if (!result) {
      return tl::unexpected(PredictionFailure{fmt::format(
          "{}: between time {:.6g} s and {:.6g} s (line {}): {}", test_.name,
          rows()[i].time - steps_[i].duration, rows()[i].time, rows()[i].line, result.error().message())});
    }
    state = result->state;
    substep = result->next_substep;
    log_stress.push_back(log(-state.stress[0]));
  }
  return log_stress;
}

tl::expected<Values, PredictionFailure> OedometerExperiment::predict(
    const model::Parameters<double>& parameters) const {
  return predict_log_stress(parameters);
}

tl::expected<Linearisation, PredictionFailure> OedometerExperiment::linearise(
    const model::Parameters<double>& parameters, std::span<const model::ParameterId> with_respect_to) const {
  using Jet = ceres::Jet<double, static_cast<int>(model::kParameterCount)>;
  model::ParameterValues<Jet> values;
  values.lode = parameters.lode();
  for (const auto& parameter : model::kParameterTable) values[parameter.id] = Jet(parameters[parameter.id]);
  for (std::size_t k = 0; k < with_respect_to.size(); ++k) {
    values[with_respect_to[k]].v[static_cast<Eigen::Index>(k)] = 1.0;
  }
  const auto jets = predict_log_stress(*model::Parameters<Jet>::create(values));
  if (!jets) return tl::unexpected(jets.error());

  Linearisation result;
  const auto columns = static_cast<Eigen::Index>(with_respect_to.size());
  result.jacobian.resize(static_cast<Eigen::Index>(jets->size()), columns);
  result.values.reserve(jets->size());
  for (std::size_t i = 0; i < jets->size(); ++i) {
    result.values.push_back((*jets)[i].a);
    result.jacobian.row(static_cast<Eigen::Index>(i)) = (*jets)[i].v.head(columns).transpose();
  }
  return result;
}

}  // namespace isotach::experiments
