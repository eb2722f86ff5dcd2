// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Stages split into rows, each integrated from where the last one ended.
#include "integrators/element_test.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace isotach::integrators {

namespace {

void require(bool ok, const Stage& stage, std::string_view rule) {
  if (!ok) throw std::invalid_argument(fmt::format("stage \"{}\": {}", stage.name, rule));
}

void check(const Stage& stage) {
  const double duration = stage.increment.duration;
  require(stage.rows >= 1, stage, "rows must be >= 1");
  require(duration >= 0.0 && std::isfinite(duration), stage, "duration must be >= 0 and finite");
  require(stage.first_row == 0.0 || (stage.first_row > 0.0 && stage.first_row < duration), stage,
          "the first row must lie within the duration");
  for (const std::optional<double>& target : stage.target) {
    if (target)
      require(duration > 0.0 && std::isfinite(*target), stage, "a target must be finite and take time");
  }
}

/// Goes through stages and rows, and remembers how far it came.
class Run {
 public:
  Run(const model::Law<double>& law, const model::State<double>& start, const Options& options,
      const ElementWatch& watch)
      : law_(law), options_(options), watch_(watch), state_(start) {}

  [[nodiscard]] tl::expected<std::vector<ElementRow>, ElementFailure> through(
      const std::vector<Stage>& stages) {
    if (!law_.in_domain(state_)) return fail(Failure{FailureKind::outside_domain, 0.0, state_}, 0.0);
    add_row(0.0);
    for (stage_ = 0; stage_ < stages.size(); ++stage_) {
      const Stage& stage = stages[stage_];
      Increment<double> increment = resolved(stage, strain_, state_);
      if (without_restart(stage, increment)) continue;
      double substep = 0.0;  // the loading has changed: what was a good one is not known to be
      double row_start = 0.0;
      for (int row = 1; row <= stage.rows; ++row) {
        const double row_end = row_time(stage, row);
        if (watch_.stop != nullptr && *watch_.stop) return interrupted(row_start);
        increment.duration = row_end - row_start;
        const auto result = advance(increment, substep);
        if (!result) return fail(result.error(), row_start + result.error().time);
        state_ = result->state;
        strain_ += result->strain;
        statistics_ += result->statistics;
        substep = result->next_substep;
        row_start = row_end;
        add_row(row_end);
      }
      stage_start_ += stage.increment.duration;
    }
    return std::move(rows_);
  }

 private:
  /// CVODE through all rows of a stage at once, where they are at equal intervals. Where it fails nothing has
  /// changed: then row by row, which finds the rows before the failure.
  [[nodiscard]] bool without_restart(const Stage& stage, const Increment<double>& increment) {
    if (options_.method != Method::cvode || stage.first_row != 0.0) return false;
    if (watch_.stop != nullptr && *watch_.stop) return false;
    const auto rows = integrate_cvode_rows(law_, state_, increment, stage.rows, options_.cvode);
    if (!rows) return false;
    const model::Mandel<double> strain = strain_;
    const Statistics statistics = statistics_;
    for (int row = 1; row <= stage.rows; ++row) {
      const Integrated<double>& at = (*rows)[static_cast<std::size_t>(row - 1)];
      state_ = at.state;
      strain_ = strain + at.strain;
      statistics_ = statistics;
      statistics_ += at.statistics;
      add_row(row_time(stage, row));
    }
    stage_start_ += stage.increment.duration;
    return true;
  }

  [[nodiscard]] tl::expected<Integrated<double>, Failure> advance(const Increment<double>& increment,
                                                                  double substep) const {
    switch (options_.method) {
      case Method::fellin_ostermann:
        return integrate_fellin_ostermann(law_, state_, increment, options_.fellin_ostermann, substep);
      case Method::rosenbrock:
        return integrate_rosenbrock(law_, state_, increment, options_.rosenbrock, substep);
      case Method::cvode:
        break;
    }
    return integrate(law_, state_, increment, options_);
  }

  void add_row(double time_in_stage) {
    rows_.push_back(
        {time(time_in_stage), stage_, strain_, state_, law_.overconsolidation_ratio(state_), statistics_});
    if (watch_.progress) watch_.progress(rows_.back().time);
  }

  [[nodiscard]] double time(double in_stage) const {
    return static_cast<double>(stage_start_ + static_cast<long double>(in_stage));
  }

  [[nodiscard]] tl::unexpected<ElementFailure> fail(const Failure& failure, double time_in_stage) {
    return tl::unexpected(ElementFailure{stage_, time(time_in_stage), failure, std::move(rows_)});
  }

  [[nodiscard]] tl::unexpected<ElementFailure> interrupted(double time_in_stage) {
    const Failure here{FailureKind::solver, 0.0, state_, statistics_};
    return tl::unexpected(ElementFailure{stage_, time(time_in_stage), here, std::move(rows_), true});
  }

  const model::Law<double>& law_;
  const Options& options_;
  const ElementWatch& watch_;
  model::State<double> state_;
  model::Mandel<double> strain_ = model::Mandel<double>::Zero();
  Statistics statistics_;
  std::vector<ElementRow> rows_;
  std::size_t stage_ = 0;
  long double stage_start_ = 0.0L;  // a sum of many durations must not show its round-off in a row's time
};

}  // namespace

Increment<double> resolved(const Stage& stage, const model::Mandel<double>& strain,
                           const model::State<double>& state) {
  Increment<double> increment = stage.increment;
  for (int i = 0; i < 6; ++i) {
    const auto component = static_cast<std::size_t>(i);
    if (!stage.target[component]) continue;
    const double target = *stage.target[component];
    if (increment.stress_controlled[component]) {
      increment.stress_rate[i] = (target - increment.condition.row(i).dot(state.stress)) / increment.duration;
    } else {
      increment.strain_rate[i] = (target - strain[i]) / increment.duration;
    }
  }
  return increment;
}

double row_time(const Stage& stage, int row) {
  const double duration = stage.increment.duration;
  if (row == stage.rows) return duration;
  if (stage.first_row == 0.0) return duration * row / stage.rows;
  return stage.first_row * std::pow(duration / stage.first_row, (row - 1.0) / (stage.rows - 1.0));
}

tl::expected<std::vector<ElementRow>, ElementFailure> run_element_test(const model::Law<double>& law,
                                                                       const model::State<double>& start,
                                                                       const std::vector<Stage>& stages,
                                                                       const Options& options,
                                                                       const ElementWatch& watch) {
  for (const Stage& stage : stages) check(stage);
  return Run(law, start, options, watch).through(stages);
}

}  // namespace isotach::integrators
