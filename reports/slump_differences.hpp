// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How far apart simulated slumps are, and how strong their muds are at the rates of a slump.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "reports/compared_slump.hpp"
#include "reports/page.hpp"

namespace isotach::reports {

/// Least and greatest of a length among slumps (m), and the slumps that have them; the first of equal ones.
struct Spread {
  double least;
  double greatest;
  const ComparedSlump* least_in;
  const ComparedSlump* greatest_in;

  [[nodiscard]] double difference() const { return greatest - least; }
};

/// Heights and toes at an output time.
struct SpreadAt {
  double time;  ///< s
  Spread height;
  Spread toe;
};

/// At each output time that all slumps have.
[[nodiscard]] std::vector<SpreadAt> spreads(const EndedSlumps& slumps);

/// The section: heights and toes apart at each shared time, where there are two slumps and such a time; the
/// undrained strength of each at the critical state at three rates.
void add_difference_section(Page& page, const EndedSlumps& slumps);

/// "differences" of result.json: an array, one object for each shared time.
[[nodiscard]] nlohmann::ordered_json differences_json(const EndedSlumps& slumps);

/// "critical_state_strengths" of one slump: an array of rates and strengths.
[[nodiscard]] nlohmann::ordered_json strengths_json(const ComparedSlump& slump);

}  // namespace isotach::reports
