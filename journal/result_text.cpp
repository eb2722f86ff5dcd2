// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "journal/result_text.hpp"

#include <bit>

#include "journal/exact_json.hpp"
#include "mpm/archive.hpp"

namespace isotach::journal {

namespace {

static_assert(std::endian::native == std::endian::little, "the archive writes the machine's own bytes");

using nlohmann::ordered_json;

/// Calls visit(name, member) for every number of the result.
template <class Result, class Visitor>
void visit_measures(Result& result, Visitor&& visit) {
  visit("void_ratio", result.initial.void_ratio);
  visit("preconsolidation_pressure_Pa", result.initial.preconsolidation_pressure);
  visit("mean_effective_pressure_Pa", result.initial.mean_effective_pressure);
  visit("density_kg_per_m3", result.initial.density);
  visit("undrained_strength_Pa", result.initial.undrained_strength);
  visit("strength_rate_per_s", result.initial.strength_rate);
  visit("cell_size_m", result.cell_size);
  visit("points", result.points);
  visit("volume_error", result.volume_error);
  visit("outline_volume_error", result.outline_volume_error);
  visit("energy_error", result.energy_error);
  visit("steps", result.steps);
  visit("particle_steps", result.particle_steps);
  visit("substepped", result.substepped);
  visit("floored", result.floored);
}

ordered_json json_of(double value) {
  return exact_json(value);
}
template <class Integer>
ordered_json json_of(Integer value) {
  return value;
}

void read(const ordered_json& json, double& value) {
  value = exact_number(json);
}
template <class Integer>
void read(const ordered_json& json, Integer& value) {
  value = json.get<Integer>();
}

template <class T>
std::string bytes_of(std::vector<T> values) {
  mpm::Archive archive;
  archive(values);
  return archive.bytes();
}

template <class T>
bool read_bytes(const std::string& bytes, std::vector<T>& values) {
  mpm::Archive archive(bytes);
  archive(values);
  return archive.complete();
}

}  // namespace

ResultColumns columns_of(const mpm::SlumpResult& result) {
  ordered_json measures = ordered_json::object();
  visit_measures(result, [&](const char* name, const auto& value) { measures[name] = json_of(value); });
  return {bytes_of(result.outlines), bytes_of(result.history), measures.dump()};
}

std::optional<mpm::SlumpResult> result_of(const ResultColumns& columns) {
  mpm::SlumpResult result;
  if (!read_bytes(columns.outlines, result.outlines) || !read_bytes(columns.history, result.history)) {
    return std::nullopt;
  }
  try {
    const ordered_json measures = ordered_json::parse(columns.measures);
    visit_measures(result, [&](const char* name, auto& value) { read(measures.at(name), value); });
  } catch (const ordered_json::exception&) {
    return std::nullopt;
  }
  return result;
}

}  // namespace isotach::journal
