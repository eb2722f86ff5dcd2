// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The stage of an oedometer test that a reading belongs to, as recorded or as deduced from the strain
// history.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace isotach::datasets {

/// What the apparatus was doing when a row was read.
enum class Stage {
  load,    ///< compression goes on
  unload,  ///< compression goes back
  hold,    ///< neither; recorded: the stress is held, as a rule; deduced: the strain stands still
  relax    ///< the strain is held; only ever recorded
};

/// The stage of that name (load, unload, hold, relax), in small or capital letters.
[[nodiscard]] std::optional<Stage> find_stage(std::string_view name);
/// The name as in data files.
[[nodiscard]] std::string_view name_of(Stage stage);

/// Stages deduced from a strain history, and the threshold they rest on.
struct DeducedStages {
  std::vector<Stage> stages;  ///< load, unload or hold, one a row: how the specimen came to that row
  double threshold = 0.0;     ///< movement of strain (-) below which a reversal is taken for noise
};

/// Deduces the direction of loading of each row.
///
/// A reversal counts once the strain has come back from its last extreme by more than the threshold
///   h = max(3 median of the non-zero |d_i|, 8 sigma),  sigma = 1.4826 median |d_{i+1} - d_i| / sqrt(6),
/// d_i the steps of strain from row to row: three steps of the record (or of its resolution, where that is
/// coarser than what a row moves), or eight standard deviations of its noise. Medians, so that neither holds
/// nor jumps of rate change h. The reversal is then placed at the extreme itself.
///
/// A hold is a stretch that stays within h of where it begins for at least five times as long as the test's
/// mean speed needs to cross h, and that does not drift: the medians of its two halves differ by at most h/4.
/// Several in a row are judged as one, so that slow loading is not taken for a hold.
///
/// `times` (s) increase strictly; `strains` (-) are compression positive; both have the same length.
[[nodiscard]] DeducedStages deduce_stages(std::span<const double> times, std::span<const double> strains);

}  // namespace isotach::datasets
