// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the reports of all fits share: verdicts in words, tables of parameters and tests, convergence.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibration/fit_result.hpp"
#include "datasets/study.hpp"
#include "reports/page.hpp"
#include "reports/run_info.hpp"

namespace isotach::reports {

/// The parameter's name, value and standard error with its unit: "D_r (6.80 ± 0.12)×10⁻⁷ 1/s".
[[nodiscard]] std::string parameter_text(const calibration::ParameterEstimate& estimate);

/// The 95 % interval in the unit of the parameter's key, "1.4136 to 1.4144"; kMissing where there is none.
[[nodiscard]] std::string interval_text(const calibration::ParameterEstimate& estimate);

/// Significant digits that show two of an interval's width, so that its ends differ.
[[nodiscard]] int interval_digits(double lower, double upper);
/// The same of an interval in the unit it is shown in.
[[nodiscard]] std::string interval_text(double ci95_lower, double ci95_upper);

/// Verdicts: one sentence each on those parameters that are well, weakly or not determined.
void add_parameter_verdicts(Page& page, const std::vector<calibration::ParameterEstimate>& estimates);
/// Verdict: whether every fitted test is met to within its noise, and how well those held out are predicted.
/// `tests` says which: "oedometer tests".
void add_adequacy_verdict(Page& page, const calibration::FitResult& result, std::string_view tests);
/// One warning each for what the fit had to say.
void add_warnings(Page& page, const std::vector<std::string>& warnings);

/// What the verdicts on parameters mean; the limits are those of calibration.
inline constexpr std::string_view kVerdictNote =
    "Identified: half the 95 % interval is at most 25 % of the value; weak: at most all of it, or the value "
    "lies on "
    "its bound; undetermined: more. C_1, which may be zero, is compared with 40 % of the range it can have. "
    "Fixed: "
    "not fitted.";

/// Whether a table of parameters says what they are and what the verdicts mean.
enum class Meanings { shown, left_out };

/// Value, error, interval, unit and verdict of every parameter.
[[nodiscard]] Table parameter_table(const std::vector<calibration::ParameterEstimate>& estimates,
                                    std::string caption, Meanings meanings);
/// The table of correlations; without rows where fewer than two parameters are free.
[[nodiscard]] Table correlation_table(const calibration::FitResult& result);
/// Null directions, if any, in words.
[[nodiscard]] std::vector<std::string> null_direction_sentences(const calibration::FitResult& result);
/// Best cost against evaluation, one line for each route.
[[nodiscard]] Figure cost_figure(const calibration::FitResult& result);
/// Best value of one free parameter against evaluation, one line for each route.
[[nodiscard]] Figure parameter_figure(const calibration::FitResult& result, std::size_t free_index);
/// How the routes ended and what they found: the one reported, the check, if any, and `further` ones.
[[nodiscard]] Table route_table(const calibration::FitResult& result,
                                const std::vector<calibration::OptimiserResult>& further = {});

/// Of a study's assumptions those on `subject`, with which they begin: "oedometer test".
[[nodiscard]] std::vector<std::string> assumptions_on(const std::vector<std::string>& all,
                                                      std::string_view subject);
/// The lines as one box, each with a bullet.
[[nodiscard]] std::string bulleted(const std::vector<std::string>& lines);

/// "crs-3 (held out)" or "crs-1".
[[nodiscard]] std::string title_of(const calibration::TestSummary& test);

/// Parts of a sentence as a list: "a, b and c".
[[nodiscard]] std::string listed(const std::vector<std::string>& parts);

/// What the study says of its data, as a line of the summary; nothing where it says nothing.
void add_data_note(Page& page, const datasets::Study& study);

}  // namespace isotach::reports
