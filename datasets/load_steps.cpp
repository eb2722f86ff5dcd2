// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Steps of an incremental-loading test: implementation.
#include "datasets/load_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isotach::datasets {

bool same_load(double a, double b) {
  return std::abs(a - b) <= kSameLoad * std::max(a, b);
}

void LoadStepBuilder::open(std::size_t line, std::string name, double begin, std::optional<Stage> recorded) {
  close();
  open_ = Open{line, std::move(name), {begin, 0.0, Stage::load, record_->rows.size(), 0}, recorded};
  latest_ = begin;
}

void LoadStepBuilder::add(OedometerRow row) {
  LoadStep& step = open_.value().step;
  if (row.time == step.begin && step.count == 0) {
    if (at_loading_++ == 0) first_at_loading_line_ = row.line;
    return;
  }
  if (!(row.time > latest_)) {
    record_->notes.push_back(
        {row.line, fmt::format("dropped: time {} s is not after {} s", row.time, latest_)});
    return;
  }
  latest_ = row.time;
  ++step.count;
  // The running mean of equal loads is that load to the last bit.
  step.load += (row.axial_stress - step.load) / static_cast<double>(step.count);
  record_->rows.push_back(row);
}

void LoadStepBuilder::close() {
  if (!open_) return;
  Open closed = *std::exchange(open_, std::nullopt);
  LoadStep& step = closed.step;
  if (step.count == 0) {
    record_->notes.push_back(
        {closed.line, fmt::format("step {} left out: it has no reading under its load", closed.name)});
    return;
  }
  step.stage = stage_of(closed);
  for (std::size_t i = step.first; i < step.first + step.count; ++i) {
    record_->rows[i].axial_stress = step.load;
    record_->rows[i].stage = step.stage;
  }
  latest_strain_ = record_->rows.back().axial_strain;
  record_->steps.push_back(step);
}

Stage LoadStepBuilder::stage_of(const Open& open) {
  const bool first = record_->steps.empty();
  const double load = open.step.load;
  const double before = first ? 0.0 : record_->steps.back().load;
  const bool lower = !first && load < before && !same_load(load, before);
  const double movement = record_->rows.back().axial_strain - latest_strain_;
  const bool recorded = open.recorded == Stage::load || open.recorded == Stage::unload;
  if (!recorded) {
    if (!first && same_load(load, before)) return record_->steps.back().stage;
    return lower ? Stage::unload : Stage::load;
  }
  const bool contradicts =
      open.recorded == Stage::unload ? !lower && movement > 0.0 : lower && movement < 0.0;
  if (!contradicts) return *open.recorded;
  const Stage stage = lower ? Stage::unload : Stage::load;
  const std::string than = first ? "it is the first" : fmt::format("it follows {:.6g} kPa", 1e-3 * before);
  record_->notes.push_back(
      {open.line, fmt::format("step {} is recorded as {} but read as {}: its load is {:.6g} kPa, {}, and the "
                              "strain {} by {:.3g} %",
                              open.name, name_of(*open.recorded), name_of(stage), 1e-3 * load, than,
                              movement > 0.0 ? "grows" : "falls", 100.0 * std::abs(movement))});
  return stage;
}

void LoadStepBuilder::finish() {
  close();
  record_->control = Control::stress;
  if (at_loading_ == 0) return;
  const char* const readings = at_loading_ == 1 ? "reading" : "readings";
  record_->notes.push_back(
      {first_at_loading_line_,
       fmt::format("{} {} at the very moment of loading left out (this is the first), as the load has not "
                   "acted yet",
                   at_loading_, readings)});
}

}  // namespace isotach::datasets
