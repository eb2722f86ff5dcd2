// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "experiments/strain_history.hpp"

#include <span>

namespace isotach::experiments {

namespace {

/// The nearest sequence in least squares that never goes against `direction` (+1 or -1): pool adjacent
/// violators.
void make_monotone(std::span<double> values, double direction) {
  struct Block {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (const double value : values) {
    blocks.push_back({direction * value, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().count += last.count;
    }
  }
  std::size_t i = 0;
  for (const Block& block : blocks) {
    // a block of one is the reading itself, to the last bit
    for (std::size_t k = 0; k < block.count; ++k) values[i++] = direction * block.mean();
  }
}

}  // namespace

bool holds_strain(const datasets::OedometerRecord& record, datasets::Stage stage) {
  return stage == datasets::Stage::relax || (record.stages_deduced && stage == datasets::Stage::hold);
}

std::vector<double> commanded_strain(const datasets::OedometerRecord& record) {
  const auto& rows = record.rows;
  std::vector<double> strain;
  strain.reserve(rows.size());
  for (const datasets::OedometerRow& row : rows) strain.push_back(row.axial_strain);
  for (std::size_t begin = 0; begin < rows.size();) {
    const datasets::Stage stage = rows[begin].stage;
    std::size_t end = begin + 1;
    while (end < rows.size() && rows[end].stage == stage) ++end;
    if (holds_strain(record, stage)) {
      // the reading before the stage was taken at the strain that is then held
      const std::size_t first = begin > 0 ? begin - 1 : begin;
      double sum = 0.0;
      for (std::size_t i = first; i < end; ++i) sum += rows[i].axial_strain;
      const double mean = sum / static_cast<double>(end - first);
      for (std::size_t i = first; i < end; ++i) strain[i] = mean;
    } else if (stage != datasets::Stage::hold) {
      make_monotone(std::span(strain).subspan(begin, end - begin),
                    stage == datasets::Stage::load ? 1.0 : -1.0);
    }
    begin = end;
  }
  return strain;
}

}  // namespace isotach::experiments
