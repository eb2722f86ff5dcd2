// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests that could be made next, as a file lists them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/loading_stage.hpp"
#include "datasets/study.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::datasets {

/// A choice of times at which a slump is photographed.
struct PictureTimes {
  std::string name;           ///< "early"
  std::vector<double> times;  ///< s, increasing, > 0
};

/// A slump test that could be made; each of its choices of pictures is a candidate.
struct CandidateSlump {
  std::string name;
  std::string programme;  ///< of which it is a part; empty: of none
  mpm::SlumpSetup setup;  ///< its times are those of all pictures together
  std::vector<PictureTimes> pictures;
};

/// A part of a strain-controlled oedometer test.
struct CandidateStage {
  Stage stage;      ///< load, unload or relax
  double strain;    ///< engineering axial strain at its end (-)
  double rate;      ///< of axial strain (1/s), > 0; of load and unload
  double duration;  ///< s; of relax
};

/// A strain-controlled oedometer test that could be made. Where the start is not given it is that of the
/// study's first test.
struct CandidateOedometer {
  std::string name;
  std::string programme;
  std::vector<CandidateStage> stages;
  int readings;                        ///< of the whole test, as many in each stage, at least 4
  std::optional<double> void_ratio;    ///< at the start (-)
  std::optional<double> axial_stress;  ///< at the start (Pa)
  std::optional<double> K0;            ///< at the start (-)
};

struct Candidates {
  std::vector<CandidateSlump> slumps;
  std::vector<CandidateOedometer> oedometers;
  std::vector<std::string> assumptions;

  /// All pictures and protocols.
  [[nodiscard]] std::size_t count() const;
};

/// The candidates that are looked at where a user names none, as a file would list them.
[[nodiscard]] std::string_view default_candidates();

/// Reads a file of [pictures], [[slump]], [[slump_grid]] and [[oedometer]] (docs/next-test.md). Mud, base and
/// numerics that it does not give are those of the study's first slump test.
/// InputError: as read_study, and a file without a candidate.
[[nodiscard]] Candidates read_candidates(const std::filesystem::path& file, const Study& study,
                                         const ReadOptions& options = {});
/// The same of a text in memory; `file` is only named in messages.
[[nodiscard]] Candidates parse_candidates(std::string text, const std::filesystem::path& file,
                                          const Study& study);

}  // namespace isotach::datasets
