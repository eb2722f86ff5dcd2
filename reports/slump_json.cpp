// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Translation of a slump's result into JSON.
#include "reports/slump_json.hpp"

#include <algorithm>

#include "reports/json_number.hpp"

namespace isotach::reports {

using nlohmann::ordered_json;

double largest_inertia_scaling(const mpm::SlumpResult& result) {
  double largest = 1.0;
  for (const mpm::HistoryRow& row : result.history) largest = std::max(largest, row.inertia_scaling);
  return largest;
}

ordered_json slump_json(const mpm::SlumpSetup& setup, const mpm::SlumpResult& result) {
  ordered_json json;
  json["outlines"] = ordered_json::array();
  for (std::size_t k = 0; k < result.outlines.size(); ++k) {
    json["outlines"].push_back({{"time_s", json_number(setup.times[k])},
                                {"height_mm", json_number(1e3 * result.outlines[k].height())},
                                {"toe_mm", json_number(1e3 * result.outlines[k].toe())}});
  }
  json["volume_error"] = json_number(result.volume_error);
  json["outline_volume_error"] = json_number(result.outline_volume_error);
  json["energy_error"] = json_number(result.energy_error);
  json["particle_steps"] = json_number(result.particle_steps);
  json["steps"] = result.steps;
  json["points"] = result.points;
  json["floored"] = result.floored;
  json["substepped"] = result.substepped;
  json["initial"] = {
      {"void_ratio", json_number(result.initial.void_ratio)},
      {"preconsolidation_pressure_kPa", json_number(1e-3 * result.initial.preconsolidation_pressure)},
      {"mean_effective_pressure_kPa", json_number(1e-3 * result.initial.mean_effective_pressure)},
      {"density_kg_per_m3", json_number(result.initial.density)},
      {"undrained_strength_kPa", json_number(1e-3 * result.initial.undrained_strength)},
      {"strength_rate_per_s", json_number(result.initial.strength_rate)}};
  const mpm::Numerics& numerics = setup.numerics;
  json["numerics"] = {{"cell_size_mm", json_number(1e3 * result.cell_size)},
                      {"cell_size_asked_mm", json_number(1e3 * numerics.cell_size)},
                      {"points_per_cell", numerics.points_per_cell},
                      {"water_bulk_modulus_kPa", json_number(1e-3 * numerics.water_bulk_modulus)},
                      {"background_viscosity_Pa_s", json_number(numerics.background_viscosity)},
                      {"scheme", mpm::kSchemeNames[static_cast<std::size_t>(numerics.scheme)]},
                      {"inertia_scaling_limit", json_number(numerics.inertia_scaling)},
                      {"inertia_scaling_used", json_number(largest_inertia_scaling(result))},
                      {"courant", json_number(numerics.courant)},
                      {"tolerance", json_number(numerics.tolerance)}};
  return json;
}

}  // namespace isotach::reports
