// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/material_table.hpp"

#include "reports/estimates.hpp"
#include "reports/number.hpp"

namespace isotach::reports {

Table material_table(const model::Parameters<double>& material) {
  using enum Alignment;
  Table table{.caption = "Material.",
              .header = {"Parameter", "Value", "Unit", "Meaning"},
              .alignment = {left, right, left, left}};
  for (const model::ParameterInfo& info : model::kParameterTable) {
    table.rows.push_back({std::string(info.name), format_number(in_key_unit(info.id, material[info.id])),
                          std::string(info.unit == "-" ? kMissing : info.unit), std::string(info.meaning)});
  }
  if (material.lode() == model::LodeDependence::none) {
    table.notes = {"Critical-state strength does not depend on the Lode angle."};
  }
  return table;
}

}  // namespace isotach::reports
