// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The stage of an oedometer test: implementation.
#include "datasets/loading_stage.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isotach::datasets {
namespace {

constexpr std::array<std::pair<std::string_view, Stage>, 4> kStageNames{
    {{"load", Stage::load}, {"unload", Stage::unload}, {"hold", Stage::hold}, {"relax", Stage::relax}}};

/// Median; 0 for no values.
double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double reversal_threshold(std::span<const double> strains) {
  std::vector<double> steps;
  std::vector<double> second_differences;
  for (std::size_t i = 1; i < strains.size(); ++i) {
    const double step = strains[i] - strains[i - 1];
    if (step != 0.0) steps.push_back(std::abs(step));
    if (i + 1 < strains.size()) second_differences.push_back(std::abs(strains[i + 1] - strains[i] - step));
  }
  // 1.4826: standard deviation over median absolute value, Gaussian; 6 = 1 + 4 + 1 of a second difference
  const double noise = 1.4826 * median(std::move(second_differences)) / std::sqrt(6.0);
  return std::max(3.0 * median(std::move(steps)), 8.0 * noise);
}

/// Rows at which the strain turns, first and last row included.
std::vector<std::size_t> turning_points(std::span<const double> strains, double threshold) {
  std::vector<std::size_t> turns{0};
  std::size_t lowest = 0;
  std::size_t highest = 0;
  int direction = 0;  // 0 until the first movement beyond the threshold
  for (std::size_t i = 1; i < strains.size(); ++i) {
    if (strains[i] > strains[highest]) highest = i;
    if (strains[i] < strains[lowest]) lowest = i;
    if (direction >= 0 && strains[highest] - strains[i] > threshold) {
      if (direction > 0) turns.push_back(highest);
      direction = -1;
      lowest = i;
    } else if (direction <= 0 && strains[i] - strains[lowest] > threshold) {
      if (direction < 0) turns.push_back(lowest);
      direction = 1;
      highest = i;
    }
  }
  turns.push_back(strains.size() - 1);
  return turns;
}

/// Rows first .. last.
struct Stretch {
  std::size_t first;
  std::size_t last;
};

/// Stretches that may stand still: within `threshold` of their first strain for at least `duration`.
/// Neighbours are one stretch, so that slow loading shows as drift.
std::vector<Stretch> standing_stretches(std::span<const double> times, std::span<const double> strains,
                                        double threshold, double duration) {
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first < strains.size();) {
    std::size_t last = first;
    while (last + 1 < strains.size() && std::abs(strains[last + 1] - strains[first]) <= threshold) ++last;
    if (last > first && times[last] - times[first] >= duration) {
      const bool continues = !stretches.empty() && stretches.back().last + 1 == first;
      if (continues) {
        stretches.back().last = last;
      } else {
        stretches.push_back({first, last});
      }
    }
    first = last + 1;
  }
  return stretches;
}

/// Without the rows at both ends that still move: those further than half the threshold from the median.
Stretch without_moving_ends(Stretch stretch, std::span<const double> strains, double threshold) {
  const auto begin = strains.begin() + static_cast<std::ptrdiff_t>(stretch.first);
  const auto end = strains.begin() + static_cast<std::ptrdiff_t>(stretch.last) + 1;
  const double level = median(std::vector<double>(begin, end));
  const auto moves = [&](std::size_t row) { return std::abs(strains[row] - level) > 0.5 * threshold; };
  while (stretch.first < stretch.last && moves(stretch.first)) ++stretch.first;
  while (stretch.last > stretch.first && moves(stretch.last)) --stretch.last;
  return stretch;
}

/// Whether the later half of the stretch lies elsewhere than the earlier one. Medians of halves, as the first
/// and the last row may still belong to the movement before and behind.
bool drifts(Stretch stretch, std::span<const double> strains, double threshold) {
  const auto begin = strains.begin() + static_cast<std::ptrdiff_t>(stretch.first);
  const auto end = strains.begin() + static_cast<std::ptrdiff_t>(stretch.last) + 1;
  const auto middle = begin + (end - begin) / 2;
  const double move = median(std::vector<double>(middle, end)) - median(std::vector<double>(begin, middle));
  return std::abs(move) > 0.25 * threshold;
}

}  // namespace

std::optional<Stage> find_stage(std::string_view name) {
  const auto same_letter = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
  };
  for (const auto& [known, stage] : kStageNames) {
    if (std::equal(name.begin(), name.end(), known.begin(), known.end(), same_letter)) return stage;
  }
  return std::nullopt;
}

std::string_view name_of(Stage stage) {
  return std::find_if(kStageNames.begin(), kStageNames.end(),
                      [&](const auto& entry) { return entry.second == stage; })
      ->first;
}

DeducedStages deduce_stages(std::span<const double> times, std::span<const double> strains) {
  DeducedStages deduced;
  deduced.stages.assign(strains.size(), Stage::hold);
  if (strains.size() < 2) return deduced;
  deduced.threshold = reversal_threshold(strains);

  const std::vector<std::size_t> turns = turning_points(strains, deduced.threshold);
  // Of a record that never leaves its threshold only a monotone one, a few rows long, is known to move.
  const bool moved = std::abs(strains.back() - strains.front()) > deduced.threshold || turns.size() > 2;
  const bool monotone =
      std::is_sorted(strains.begin(), strains.end()) || std::is_sorted(strains.rbegin(), strains.rend());
  if (!moved && !monotone) return deduced;
  double path = 0.0;
  for (std::size_t turn = 1; turn < turns.size(); ++turn) {
    const double move = strains[turns[turn]] - strains[turns[turn - 1]];
    path += std::abs(move);
    if (move == 0.0) continue;
    for (std::size_t row = turns[turn - 1] + 1; row <= turns[turn]; ++row) {
      deduced.stages[row] = move > 0.0 ? Stage::load : Stage::unload;
    }
  }
  deduced.stages[0] = deduced.stages[1];
  if (path == 0.0) return deduced;

  const double mean_speed = path / (times.back() - times.front());
  for (Stretch stretch :
       standing_stretches(times, strains, deduced.threshold, 5.0 * deduced.threshold / mean_speed)) {
    stretch = without_moving_ends(stretch, strains, deduced.threshold);
    if (stretch.last == stretch.first || drifts(stretch, strains, deduced.threshold)) continue;
    // The row that opens the stretch was arrived at by moving.
    for (std::size_t row = stretch.first + 1; row <= stretch.last; ++row) deduced.stages[row] = Stage::hold;
  }
  return deduced;
}

}  // namespace isotach::datasets
