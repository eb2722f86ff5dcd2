// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "cluster/message.hpp"

#include "journal/result_text.hpp"
#include "mpm/archive.hpp"
#include "mpm/setup_fields.hpp"

namespace isotach::cluster {

namespace {

void visit(mpm::Archive& archive, model::ParameterValues<double>& parameters, mpm::SlumpSetup& setup,
           double& time_limit) {
  archive(parameters);
  mpm::visit_fields(setup, [&](std::string_view, auto& value) { archive(value); });
  archive(setup.numerics.threads);
  archive(time_limit);
}

/// `columns` where the simulation has a result.
void visit(mpm::Archive& archive, journal::Simulation& simulation,
           std::optional<journal::ResultColumns>& columns) {
  archive(simulation.status);
  archive(simulation.message);
  archive(simulation.seconds);
  bool has_result = columns.has_value();
  archive(has_result);
  if (!has_result) return;
  if (!columns) columns.emplace();
  archive(columns->outlines);
  archive(columns->history);
  archive(columns->measures);
}

}  // namespace

std::string bytes_of(const Task& task) {
  mpm::Archive archive;
  auto [parameters, setup, time_limit] = task;
  auto values = parameters.values();
  visit(archive, values, setup, time_limit);
  return archive.bytes();
}

std::optional<Task> task_of(std::string_view bytes) {
  mpm::Archive archive(bytes);
  model::ParameterValues<double> values;
  mpm::SlumpSetup setup;
  double time_limit = 0.0;
  visit(archive, values, setup, time_limit);
  const auto parameters = model::Parameters<double>::create(values);
  if (!archive.complete() || !parameters) return std::nullopt;
  return Task{*parameters, std::move(setup), time_limit};
}

std::string bytes_of(const journal::Simulation& simulation) {
  mpm::Archive archive;
  std::optional<journal::ResultColumns> columns;
  if (simulation.result) columns = journal::columns_of(*simulation.result);
  journal::Simulation head{simulation.status, simulation.message, simulation.seconds, {}};
  visit(archive, head, columns);
  return archive.bytes();
}

std::optional<journal::Simulation> simulation_of(std::string_view bytes) {
  mpm::Archive archive(bytes);
  journal::Simulation simulation;
  std::optional<journal::ResultColumns> columns;
  visit(archive, simulation, columns);
  if (!archive.complete()) return std::nullopt;
  if (columns) {
    simulation.result = journal::result_of(*columns);
    if (!simulation.result) return std::nullopt;
  }
  return simulation;
}

}  // namespace isotach::cluster
