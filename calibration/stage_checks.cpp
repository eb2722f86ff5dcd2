// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "calibration/stage_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "calibration/distributions.hpp"

namespace isotach::calibration {

namespace {

constexpr double kRare = 1e-3;
constexpr int kLags = 10;

/// Index of the stage that a value belongs to: stretches of equal stage, or load steps.
std::size_t stage_index(const experiments::OedometerExperiment& experiment, std::size_t row) {
  const auto& record = experiment.test().record;
  if (record.control == datasets::Control::stress) {
    std::size_t step = 0;
    while (step + 1 < record.steps.size() && row >= record.steps[step + 1].first) ++step;
    return step;
  }
  std::size_t index = 0;
  for (std::size_t i = 1; i <= row; ++i) {
    if (record.rows[i].stage != record.rows[i - 1].stage) ++index;
  }
  return index;
}

}  // namespace

TestCheck check_test(const experiments::OedometerExperiment& experiment, const experiments::Values& scaled,
                     const experiments::Values& white) {
  TestCheck check{
      experiment.name(),       experiment.held_out(),      {},   runs_test(scaled), ljung_box(scaled, kLags),
      ljung_box(white, kLags), autocorrelation(scaled, 1), false};
  check.patterned = check.runs.p_value < kRare || check.ljung_box.p_value < kRare;
  std::map<std::string, int> seen;
  const auto& values = experiment.values();
  for (std::size_t begin = 0; begin < values.size();) {
    const std::size_t index = stage_index(experiment, values[begin].row);
    std::size_t end = begin;
    double squares = 0.0;
    double sum = 0.0;
    while (end < values.size() && stage_index(experiment, values[end].row) == index) {
      squares += scaled[end] * scaled[end];
      sum += scaled[end];
      ++end;
    }
    const datasets::OedometerRow& first = experiment.row_of(values[begin]);
    const datasets::OedometerRow& last = experiment.row_of(values[end - 1]);
    const std::string name(datasets::name_of(first.stage));
    const int number = ++seen[name];
    const auto count = static_cast<double>(end - begin);
    StageCheck stage{};
    stage.stage = number == 1 ? name : fmt::format("{} {}", name, number);
    stage.from_time = first.time;
    stage.to_time = last.time;
    stage.from_stress = first.axial_stress;
    stage.to_stress = last.axial_stress;
    stage.count = end - begin;
    stage.rms_over_noise = std::sqrt(squares / count);
    stage.mean_over_noise = sum / count;
    stage.p_value = chi_squared_survival(squares, count);
    stage.misfit = stage.rms_over_noise > kStageMisfit && stage.p_value < kRare;
    check.stages.push_back(std::move(stage));
    begin = end;
  }
  return check;
}

}  // namespace isotach::calibration
