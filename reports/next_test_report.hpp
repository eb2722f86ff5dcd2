// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which test to make next, as a page, as JSON and as CSV.
#pragma once

#include <nlohmann/json.hpp>

#include "calibration/next_test.hpp"
#include "reports/output_directory.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// What to do next and why, ellipses of I_v and C_1, the table of candidates, programmes, and what the
/// numbers rest on.
[[nodiscard]] Page next_test_report(const RunInfo& run, const datasets::Study& study,
                                    const calibration::NextTest& next);

/// "present", "tests", "candidates" (by falling gain), "programmes", "pair", "sequence", "next_test": the
/// name of the best candidate. Standard errors are those of ln I_v and of C_1.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::Study& study,
                                                 const calibration::NextTest& next);

/// candidates.csv: what the table of candidates has, by falling gain; curves/ellipses.csv: name, I_v, C_1 of
/// the 95 % ellipses that are drawn.
void write_curves(OutputDirectory& output, const calibration::NextTest& next);

/// Candidates that could be rated, the most useful first.
[[nodiscard]] std::vector<std::size_t> by_gain(const calibration::NextTest& next);

/// A closed curve with its name.
struct Ellipse {
  std::string name;
  std::vector<double> I_v;
  std::vector<double> C_1;
};

/// 95 % regions of I_v and C_1 together: at present, with each of the best candidates, and with the pair;
/// those that do not close are left out.
[[nodiscard]] std::vector<Ellipse> ellipses_of(const calibration::NextTest& next);

}  // namespace isotach::reports
