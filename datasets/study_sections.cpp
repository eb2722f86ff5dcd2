// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The sections that studies and slump files share: implementation.
#include "datasets/study_sections.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace isotach::datasets {
namespace {

using model::ParameterInfo;

Range range_of(const ParameterInfo& parameter) {
  return {parameter.lower, parameter.upper, parameter.lower_open, true};
}

/// Specimens and moulds of a laboratory; what is larger is a mistake of unit.
constexpr Range kCellSize_mm = Range::positive(10000.0);

}  // namespace

model::Parameters<double> read_material(TomlTable material) {
  model::ParameterValues<double> values;
  for (const ParameterInfo& parameter : model::kParameterTable) {
    const double value = parameter.optional
                             ? material.number_if(parameter.key, range_of(parameter)).value_or(0.0)
                             : material.number(parameter.key, range_of(parameter));
    values[parameter.id] = parameter.to_si * value;
  }
  constexpr std::array<std::string_view, 2> kLode{"matsuoka-nakai", "none"};
  values.lode = material.choice_if("lode_dependence", kLode).value_or(0) == 0
                    ? model::LodeDependence::matsuoka_nakai
                    : model::LodeDependence::none;
  material.reject_unknown_keys();
  auto parameters = model::Parameters<double>::create(values);
  if (!parameters) {
    const model::ParameterError& error = parameters.error();
    throw material.error(model::info(error.id).key, fmt::format("{} is out of range", error.value),
                         error.accepted);
  }
  return *std::move(parameters);
}

std::string read_test_name(TomlTable& test, std::set<std::string>& names) {
  std::string name = test.text("name");
  if (name.find_first_of("/\\\n\r\t") != std::string::npos) {
    throw test.error("name", fmt::format("\"{}\"", name), "a name without slashes, tabs and line breaks");
  }
  if (!names.insert(name).second) {
    throw test.error("name", fmt::format("\"{}\" occurs twice", name), "a name of its own for each test");
  }
  return name;
}

mpm::Mud read_mud(TomlTable mud, Assumptions& assumptions) {
  mpm::Mud result;
  result.void_ratio = mud.number_if("void_ratio", kVoidRatio);
  if (const auto strength = mud.number_if("undrained_strength_kPa", Range::positive(1000.0))) {
    if (result.void_ratio) {
      throw mud.error("undrained_strength_kPa", "given together with void_ratio",
                      "either void_ratio or undrained_strength_kPa");
    }
    result.undrained_strength = 1e3 * *strength;
    result.strength_rate = mud.number_if("strength_rate_per_s", Range::positive(1000.0));
    if (!result.strength_rate) {
      assumptions.add("rate at which the undrained strength was measured not given, |D| = D_r assumed");
    }
  } else if (!result.void_ratio) {
    throw mud.error("void_ratio", "it is missing", "either void_ratio or undrained_strength_kPa");
  }
  const auto specific_gravity = mud.number_if("specific_gravity", kSpecificGravity);
  if (!specific_gravity) {
    assumptions.add(fmt::format("specific gravity not given, {} assumed", kAssumedSpecificGravity));
  }
  result.specific_gravity = specific_gravity.value_or(kAssumedSpecificGravity);
  const auto ocr = mud.number_if("ocr", Range::positive(100.0));
  if (!ocr) {
    assumptions.add(
        fmt::format("initial overconsolidation ratio not given, {} assumed", result.overconsolidation_ratio));
  }
  result.overconsolidation_ratio = ocr.value_or(result.overconsolidation_ratio);
  mud.reject_unknown_keys();
  return result;
}

namespace {

/// The keys that are there; the others stay.
void read_into(TomlTable& numerics, mpm::Numerics& result) {
  if (const auto size = numerics.number_if("cell_size_mm", kCellSize_mm)) result.cell_size = 1e-3 * *size;
  if (const auto points = numerics.number_if("points_per_cell", {4.0, 100.0})) {
    const double side = std::round(std::sqrt(*points));
    if (side * side != *points) {
      throw numerics.error("points_per_cell", fmt::format("{} is not a square number", *points),
                           "4, 9, 16, ..., 100");
    }
    result.points_per_cell = static_cast<int>(*points);
  }
  if (const auto modulus = numerics.number_if("water_bulk_modulus_kPa", Range::positive(2.2e6))) {
    result.water_bulk_modulus = 1e3 * *modulus;
  }
  result.courant = numerics.number_if("courant", Range::positive(1.0)).value_or(result.courant);
  result.tolerance = numerics.number_if("tolerance", Range::positive(0.1)).value_or(result.tolerance);
  result.inertia_scaling = numerics.number_if("inertia_scaling", {1.0, 1e6}).value_or(result.inertia_scaling);
  result.background_viscosity =
      numerics.number_if("background_viscosity_Pa_s", {0.0, 1000.0}).value_or(result.background_viscosity);
  if (const auto scheme = numerics.choice_if("scheme", mpm::kSchemeNames)) {
    result.scheme = static_cast<mpm::Scheme>(*scheme);
  }
}

}  // namespace

mpm::Numerics read_numerics(TomlTable& root) {
  mpm::Numerics result;
  auto numerics = root.table_if("numerics");
  if (!numerics) return result;
  read_into(*numerics, result);
  numerics->reject_unknown_keys();
  return result;
}

StudyNumerics read_study_numerics(TomlTable& root) {
  StudyNumerics result;
  auto numerics = root.table_if("numerics");
  if (!numerics) return result;
  read_into(*numerics, result.own);
  if (auto reference = numerics->table_if("reference")) {
    result.reference = result.own;
    read_into(*reference, *result.reference);
    reference->reject_unknown_keys();
  }
  numerics->reject_unknown_keys();
  return result;
}

void check_cell_size(TomlTable& root, const mpm::SlumpSetup& setup) {
  const double radius = 0.5 * setup.mould.diameter;
  if (setup.numerics.cell_size <= radius) return;
  const std::string found = fmt::format("{:.6g} is out of range", 1e3 * setup.numerics.cell_size);
  const std::string accepted = fmt::format("at most the mould's radius, {:.6g}", 1e3 * radius);
  if (auto numerics = root.table_if("numerics")) throw numerics->error("cell_size_mm", found, accepted);
  throw InputError(root.place(), "cell_size_mm", found + " (its default)", accepted);
}

}  // namespace isotach::datasets
