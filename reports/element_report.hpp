// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What `isotach element` writes of one element test: report, curves and result.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reports/element_result.hpp"
#include "reports/output_directory.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// The figures that the stages call for, what each stage ended with, material and start. Of a test that
/// failed: how far it came.
[[nodiscard]] Page element_report(const RunInfo& run, const datasets::ElementFile& test,
                                  const ElementRun& result);

/// curve.csv: time_s, stage (its name), strain_11 .. strain_23, stress_11_kPa .. stress_23_kPa, void_ratio,
/// ocr, a row for the start and each row of the stages; fabric.csv with omega_11 .. omega_23 where Omega is
/// not zero all along; curves/<figure>.csv for each figure of the report: curve (its name), and the two axes.
void write_curves(OutputDirectory& output, const datasets::ElementFile& test, const ElementRun& result);

/// Head, integrator and tolerance, the state at the end of each stage, cost; status "failed" (or
/// "interrupted") with stage and time, where it is so.
[[nodiscard]] nlohmann::ordered_json result_json(const RunInfo& run, const datasets::ElementFile& test,
                                                 const ElementRun& result);

/// Why and where a test failed, in one line; needs result.failure.
[[nodiscard]] std::string failure_text(const datasets::ElementFile& test, const ElementRun& result);

/// How a test ended, in one line without its end; needs at least one row.
[[nodiscard]] std::string summary_text(const datasets::ElementFile& test, const ElementRun& result);

}  // namespace isotach::reports
