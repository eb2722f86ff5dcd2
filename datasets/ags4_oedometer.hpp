// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Incremental-loading oedometer tests out of the groups CONG and CONS of an AGS4 file.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/ags4.hpp"
#include "datasets/oedometer.hpp"
#include "datasets/specimen.hpp"

namespace isotach::datasets {

/// Key headings of CONG and CONS, which together name a specimen.
inline constexpr std::array<std::string_view, 7> kAgs4SpecimenKeys{
    "LOCA_ID", "SAMP_TOP", "SAMP_REF", "SAMP_TYPE", "SAMP_ID", "SPEC_REF", "SPEC_DPTH"};

/// How long each load is taken to last (s), as AGS4 has no times: the usual 24 h.
inline constexpr double kAgs4StepDuration = 86400.0;

/// One load of a test.
struct Ags4Increment {
  std::size_t line;
  std::string number;                       ///< CONS_INCN
  std::optional<double> stress;             ///< CONS_INCF (Pa), at the end of the increment
  std::optional<double> void_ratio;         ///< CONS_INCE (-), likewise
  std::optional<double> void_ratio_before;  ///< CONS_IVR (-)
};

/// One test of a file.
struct Ags4Oedometer {
  Selection name;                 ///< value of each of kAgs4SpecimenKeys that is not empty
  std::vector<std::size_t> rows;  ///< of the group CONS
  SpecimenData specimen;          ///< as far as read_ags4_oedometer has filled it
  std::vector<Ags4Increment> increments;
};

/// The specimens that the group CONS has rows of, in the file's order, not read further.
/// InputError: no group CONS, one without CONS_INCF or CONS_INCE, no row.
[[nodiscard]] std::vector<Ags4Oedometer> find_ags4_oedometers(const Ags4File& file);

/// One of these tests with its increments, in the order of CONS_INCN where that counts them, and with what
/// CONG says of the specimen: CONG_HIGT, CONG_SDIA (or CONG_DIA), CONG_IVR, CONG_MCI, CONG_BDEN, CONG_PDEN.
///
/// A # before a value means that the laboratory assumed it, which is passed on as an assumption. A density in
/// kN/m3 is taken as a unit weight; without such a unit, one above 5 too, as an assumption.
/// InputError: a number that cannot be, a unit that is not known, two rows of CONG for the specimen.
[[nodiscard]] Ags4Oedometer read_ags4_oedometer(const Ags4File& file, Ags4Oedometer test);

/// The stress-controlled record of a test that was read: one row at the end of each increment of 24 h, its
/// strain (e0 - e)/(1 + e0) with e0 = `void_ratio`. Increments without stress or void ratio are dropped and
/// named. InputError: fewer than 3 are left, a strain outside of (-1, 1).
[[nodiscard]] OedometerRecord record_of(const Ags4File& file, const Ags4Oedometer& test, double void_ratio);

}  // namespace isotach::datasets
