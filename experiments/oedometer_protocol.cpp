// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/oedometer_protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/primary_consolidation.hpp"
#include "experiments/strain_history.hpp"

namespace isotach::experiments {

namespace {

using datasets::OedometerRow;
using datasets::OedometerTest;
using datasets::Stage;

/// Rows first .. end - 1 of one stage.
struct Stretch {
  std::size_t first;
  std::size_t end;
};

/// The stretches of equal stage from row `first` on.
std::vector<Stretch> stretches_of(const std::vector<OedometerRow>& rows, std::size_t first) {
  std::vector<Stretch> stretches;
  while (first < rows.size()) {
    std::size_t end = first + 1;
    while (end < rows.size() && rows[end].stage == rows[first].stage) ++end;
    stretches.push_back({first, end});
    first = end;
  }
  return stretches;
}

/// Largest |d ln sigma/d strain| of a stretch as its ends show it: what a strain reading's noise does to ln
/// sigma.
double slope_of(const std::vector<OedometerRow>& rows, const Stretch& stretch) {
  const OedometerRow& first = rows[stretch.first];
  const OedometerRow& last = rows[stretch.end - 1];
  const double strain = last.axial_strain - first.axial_strain;
  return strain != 0.0 ? std::abs(std::log(last.axial_stress / first.axial_stress) / strain) : 0.0;
}

/// +1 where a stage loads, -1 where it unloads, `before` where it does neither.
double direction_of(Stage stage, double before) {
  if (stage == Stage::load) return 1.0;
  return stage == Stage::unload ? -1.0 : before;
}

/// Temperatures at the start and the end of each step of a protocol.
std::vector<double> temperatures_of(const OedometerProtocol& protocol,
                                    const std::vector<OedometerRow>& rows) {
  std::vector<const OedometerRow*> read;
  for (const OedometerRow& row : rows) {
    if (row.temperature) read.push_back(&row);
  }
  if (read.empty()) return {};
  const auto at = [&](double time) {
    const auto after =
        std::find_if(read.begin(), read.end(), [&](const auto* row) { return row->time >= time; });
    if (after == read.begin()) return *read.front()->temperature;
    if (after == read.end()) return *read.back()->temperature;
    const OedometerRow& a = **(after - 1);
    const OedometerRow& b = **after;
    return *a.temperature + (*b.temperature - *a.temperature) * (time - a.time) / (b.time - a.time);
  };
  double time = protocol.start.time;
  std::vector<double> temperatures{at(time)};
  for (const DriveStep& step : protocol.steps) {
    time += step.duration;
    temperatures.push_back(at(time));
  }
  return temperatures;
}

std::optional<double> rate_of(double strain, double time) {
  if (!(strain > 0.0 && time > 0.0)) return std::nullopt;
  return strain / time;
}

OedometerProtocol strain_controlled(const OedometerTest& test) {
  const auto& rows = test.record.rows;
  const std::vector<double> strain = commanded_strain(test.record);
  OedometerProtocol protocol;
  std::size_t first = 1;
  if (test.initial_axial_stress) {
    protocol.start = {0.0, 0.0, *test.initial_axial_stress, test.void_ratio, kNoRow};
    // a first row at time 0 is the start itself
    first = rows.front().time > 0.0 ? 0 : 1;
  } else {
    protocol.start = {rows.front().time, strain.front(), rows.front().axial_stress,
                      (1.0 + test.void_ratio) * (1.0 - strain.front()) - 1.0, 0};
  }
  double time = protocol.start.time;
  double height = 1.0 - protocol.start.axial_strain;  // present over first height
  double loading_strain = 0.0;
  double loading_time = 0.0;
  bool loaded = false;
  bool chain_begins = true;
  double direction = 1.0;
  for (const Stretch& stretch : stretches_of(rows, first)) {
    const Stage stage = rows[stretch.first].stage;
    direction = direction_of(stage, direction);
    const bool held = stage == Stage::hold || stage == Stage::relax;
    const bool stress_held = stage == Stage::hold && !test.record.stages_deduced;
    double held_stress = 0.0;
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      held_stress += rows[i].axial_stress / static_cast<double>(stretch.end - stretch.first);
    }
    const double slope = stress_held || holds_strain(test.record, stage) ? 0.0 : slope_of(rows, stretch);
    const std::size_t before = protocol.steps.empty() ? kNoRow : protocol.steps.size() - 1;
    const double strain_before = before == kNoRow ? 0.0 : 1.0 - height;
    if (stress_held) chain_begins = true;
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      const OedometerRow& row = rows[i];
      const double next_height = 1.0 - strain[i];
      const double increment = std::log(height / next_height);
      protocol.steps.push_back(
          {row.time - time, stress_held, stress_held ? held_stress : increment, i, direction, held});
      if (stage == Stage::load && (!loaded || loading_time > 0.0)) {
        loaded = true;
        loading_strain += increment;
        loading_time += row.time - time;
      }
      ComparedValue value{};
      value.step = protocol.steps.size() - 1;
      value.row = i;
      value.opens_chain = chain_begins;
      value.strain_origin = kNoRow;
      if (stress_held) {
        value.kind = ValueKind::strain;
        value.measured = row.axial_strain - strain_before;
        value.strain_origin = before;
        value.noise = test.noise.strain;
      } else {
        value.kind = ValueKind::log_stress;
        value.measured = std::log(row.axial_stress);
        const double floor = test.noise.stress_floor / row.axial_stress;
        const double from_strain = test.noise.strain * slope;
        value.known_variance = from_strain * from_strain;
        value.noise = std::sqrt(test.noise.stress_relative * test.noise.stress_relative + floor * floor +
                                value.known_variance);
      }
      protocol.values.push_back(value);
      chain_begins = false;
      time = row.time;
      height = next_height;
    }
    if (stress_held) chain_begins = true;
    if (loaded && stage == Stage::load && !protocol.first_loading_rate) {
      protocol.first_loading_rate = rate_of(loading_strain, loading_time);
    }
  }
  return protocol;
}

/// From when on the readings of a step are compared (s after the load).
PrimaryConsolidation bound_primary(const OedometerTest& test, std::size_t index) {
  using Rule = datasets::EndOfPrimary::Rule;
  const datasets::LoadStep& step = test.record.steps[index];
  const auto rows = std::span(test.record.rows).subspan(step.first, step.count);
  PrimaryConsolidation result{index, 0.0, "all readings"};
  const Rule rule = test.end_of_primary.rule;
  if (rule == Rule::none) return result;
  if (rule == Rule::given) {
    result.end = test.end_of_primary.seconds;
    result.how = "given";
  } else {
    std::vector<double> times;
    std::vector<double> strains;
    for (const OedometerRow& row : rows) {
      times.push_back(row.time - step.begin);
      strains.push_back(row.axial_strain);
    }
    const bool taylor = rule == Rule::taylor;
    const double before = step.first > 0 ? test.record.rows[step.first - 1].axial_strain : 0.0;
    const auto end =
        taylor ? end_of_primary_taylor(times, strains, before) : end_of_primary_casagrande(times, strains);
    if (end) {
      result.end = *end;
      result.how = taylor ? "Taylor" : "Casagrande";
    } else {
      // where no construction works the last nine tenths of the step are taken for creep
      constexpr double kShare = 0.1;
      result.end = kShare * times.back();
      result.how = fmt::format("a tenth of the step, as {}", end.error());
    }
  }
  if (*result.end >= rows.back().time - step.begin) {
    // the last reading always counts: it is all that a file of end-of-step points has
    result.end = rows.back().time - step.begin;
    result.how += "; only the last reading is compared";
  }
  return result;
}

OedometerProtocol stress_controlled(const OedometerTest& test) {
  const auto& rows = test.record.rows;
  OedometerProtocol protocol;
  std::size_t first_step = 0;
  if (test.initial_axial_stress) {
    protocol.start = {test.record.steps.front().begin, 0.0, *test.initial_axial_stress, test.void_ratio,
                      kNoRow};
  } else {
    const datasets::LoadStep& seating = test.record.steps.front();
    const std::size_t row = seating.first + seating.count - 1;
    const double strain = rows[row].axial_strain;
    protocol.start = {rows[row].time, strain, seating.load, (1.0 + test.void_ratio) * (1.0 - strain) - 1.0,
                      row};
    first_step = 1;
  }
  double time = protocol.start.time;
  double stress = protocol.start.axial_stress;
  double strain = protocol.start.axial_strain;
  for (std::size_t k = first_step; k < test.record.steps.size(); ++k) {
    const datasets::LoadStep& step = test.record.steps[k];
    // what a law misses of a step shifts all of its readings alike; of the next one it misses something else
    bool chain_begins = true;
    protocol.consolidation.push_back(bound_primary(test, k));
    const double primary_end = *protocol.consolidation.back().end;
    const double first_reading = rows[step.first].time - step.begin;
    // a load is on within its primary consolidation, or at once: well before the first reading
    constexpr double kAtOnce = 0.1;
    const double ramp_end = step.begin + (primary_end > 0.0 ? primary_end : kAtOnce * first_reading);
    const double ramp_begin = time;
    const double old_stress = stress;
    const auto stress_at = [&](double when) {
      const double share = (when - ramp_begin) / (ramp_end - ramp_begin);
      return share >= 1.0 ? step.load : old_stress + share * (step.load - old_stress);
    };
    const auto advance_to = [&](double when, std::size_t row) {
      protocol.steps.push_back({when - time, true, stress_at(when), row,
                                step.stage == Stage::unload ? -1.0 : 1.0, time >= ramp_end});
      time = when;
    };
    for (std::size_t i = step.first; i < step.first + step.count; ++i) {
      if (rows[i].time <= time) continue;
      if (time < ramp_end && rows[i].time > ramp_end) advance_to(ramp_end, kNoRow);
      advance_to(rows[i].time, i);
      if (rows[i].time - step.begin < primary_end) continue;
      protocol.values.push_back({.step = protocol.steps.size() - 1,
                                 .row = i,
                                 .kind = ValueKind::strain,
                                 .measured = rows[i].axial_strain,
                                 .noise = test.noise.strain,
                                 .known_variance = 0.0,
                                 .strain_origin = kNoRow,
                                 .opens_chain = chain_begins});
      chain_begins = false;
    }
    stress = step.load;
    const double end_strain = rows[step.first + step.count - 1].axial_strain;
    if (!protocol.first_loading_rate && step.stage == Stage::load) {
      protocol.first_loading_rate = rate_of(std::log((1.0 - strain) / (1.0 - end_strain)), time - ramp_begin);
    }
    strain = end_strain;
  }
  return protocol;
}

}  // namespace

OedometerProtocol make_protocol(const OedometerTest& test) {
  OedometerProtocol protocol =
      test.record.control == datasets::Control::stress ? stress_controlled(test) : strain_controlled(test);
  protocol.temperatures = temperatures_of(protocol, test.record.rows);
  return protocol;
}

}  // namespace isotach::experiments
