// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/strain_history.hpp"

namespace isotach::experiments {

bool holds_strain(const datasets::OedometerRecord& record, datasets::Stage stage) {
  return stage == datasets::Stage::relax || (record.stages_deduced && stage == datasets::Stage::hold);
}

std::vector<double> commanded_strain(const datasets::OedometerRecord& record) {
  const auto& rows = record.rows;
  std::vector<double> strain;
  strain.reserve(rows.size());
  for (const datasets::OedometerRow& row : rows) strain.push_back(row.axial_strain);
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin + 1;
    while (end < rows.size() && rows[end].stage == rows[begin].stage) ++end;
    if (holds_strain(record, rows[begin].stage)) {
      // the reading before the stage was taken at the strain that is then held
      const std::size_t first = begin > 0 ? begin - 1 : begin;
      double sum = 0.0;
      for (std::size_t i = first; i < end; ++i) sum += rows[i].axial_strain;
      const double mean = sum / static_cast<double>(end - first);
      for (std::size_t i = first; i < end; ++i) strain[i] = mean;
    }
    begin = end;
  }
  return strain;
}

}  // namespace isotach::experiments
