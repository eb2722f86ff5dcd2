// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The verification report: sections and tables.
#include "reports/verification_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "reports/number.hpp"
#include "reports/verification_figures.hpp"
#include "verification/random_path.hpp"

namespace isotach::reports {

using verification::Check;
using verification::PathOutcome;
using verification::Verification;

namespace {

std::string percent(double share) {
  return format_number(100.0 * share, 3) + " %";
}

std::string order_text(const verification::ObservedOrder& order) {
  return fmt::format("{:.2f} ± {:.2f}", order.order, order.half_width);
}

std::string tick(const Check& check) {
  return check.pass() ? "✓" : "✗";
}

std::size_t passed_of(const Verification& result, const std::string& group, std::size_t& all) {
  std::size_t passed = 0;
  all = 0;
  for (const Check& check : result.checks) {
    if (check.group != group) continue;
    ++all;
    if (check.pass()) ++passed;
  }
  return passed;
}

void add_summary(Page& page, const Verification& result) {
  const std::size_t failed = result.failed();
  page.verdict(failed == 0 ? Tone::good : Tone::bad,
               failed == 0 ? fmt::format("All {} checks passed.", result.checks.size())
                           : fmt::format("{} of {} checks failed; they are listed below.", failed,
                                         result.checks.size()));
  const auto& random = result.random_paths;
  const auto errors = random.errors_over_tolerance();
  page.verdict(
      random.count(PathOutcome::failed) == 0 ? Tone::good : Tone::bad,
      fmt::format(
          "{} random strain paths: {} failures; 99.9 % have an error of at most {} TOL, the worst {} TOL.",
          random.records.size(), random.count(PathOutcome::failed),
          format_number(verification::quantile(errors, 0.999), 3),
          format_number(verification::quantile(errors, 1.0), 3)));
  for (const auto& scheme : result.convergence.schemes) {
    if (scheme.scheme == "fellin-ostermann" || scheme.scheme == "(5a) as printed") {
      page.verdict(Tone::plain,
                   fmt::format("Observed order of {}: {}.", scheme.scheme, order_text(scheme.order)));
    }
  }
  std::set<std::string> groups;
  for (const Check& check : result.checks) {
    if (!groups.insert(check.group).second) continue;
    std::size_t all = 0;
    const std::size_t passed = passed_of(result, check.group, all);
    page.fact("Checks: " + check.group, fmt::format("{} of {} passed", passed, all));
  }
  const bool full = result.plan.sampling == verification::Sampling::full;
  page.fact("Random samples",
            fmt::format("{} size, seed {}: {} paths, {} tangents", full ? "full" : "quick", result.plan.seed,
                        random.records.size(), result.tangents.records.size()));
}

/// The checks of a group, or only those that failed.
Table check_table(const Verification& result, const std::string& group, const std::string& caption) {
  using enum Alignment;
  Table table{
      .caption = caption,
      .header = {"", "Quantity", "By", "Expected", "Got", "Difference", "Allowed", "Source or meaning"},
      .alignment = {centre, left, left, right, right, right, right, left}};
  for (const Check& check : result.checks) {
    if (!group.empty() ? check.group != group : check.pass()) continue;
    table.rows.push_back({tick(check), check.name, check.integrator, format_number(check.expected, 8),
                          format_number(check.got, 8), format_number(check.got - check.expected, 2),
                          format_number(check.tolerance, 2), check.note});
  }
  return table;
}

/// The checks of a group with a row a quantity and a column an integrator: relative differences.
Table difference_table(const Verification& result, const std::string& group, const std::string& caption) {
  using enum Alignment;
  std::vector<std::string> quantities;
  std::vector<std::string> integrators;
  const auto place_in = [](std::vector<std::string>& list, const std::string& entry) {
    const auto found = std::find(list.begin(), list.end(), entry);
    if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
    list.push_back(entry);
    return list.size() - 1;
  };
  for (const Check& check : result.checks) {
    if (check.group != group) continue;
    place_in(quantities, check.name);
    if (!check.integrator.empty()) place_in(integrators, check.integrator);
  }
  Table table{.caption = caption, .header = {"Quantity", "Expected"}, .alignment = {left, right}};
  for (const std::string& integrator : integrators) {
    table.header.push_back(integrator);
    table.alignment.push_back(right);
  }
  table.header.push_back("Of what is allowed");
  table.alignment.push_back(right);
  std::vector<double> used(quantities.size(), 0.0);
  table.rows.assign(quantities.size(), std::vector<std::string>(integrators.size() + 3));
  for (const Check& check : result.checks) {
    if (check.group != group) continue;
    const std::size_t row = place_in(quantities, check.name);
    auto& cells = table.rows[row];
    cells[0] = check.name;
    cells[1] = format_number(check.expected, 10);
    const double difference = check.got - check.expected;
    used[row] = std::max(used[row], std::abs(difference) / check.tolerance);
    const std::string text =
        format_number(difference / std::abs(check.expected), 2) + (check.pass() ? "" : " ✗");
    // what no integrator has a part in is the same for all
    if (check.integrator.empty()) {
      std::fill(cells.begin() + 2, cells.end() - 1, text);
    } else {
      cells[2 + place_in(integrators, check.integrator)] = text;
    }
    cells.back() = percent(used[row]);
  }
  return table;
}

Table order_table(const verification::ConvergenceStudy& study) {
  using enum Alignment;
  Table table{.caption = "Observed orders of convergence, with 95 % intervals.",
              .header = {"Scheme", "Order", "Expected", "Sizes", "Meaning"},
              .alignment = {left, right, right, right, left}};
  for (const auto& scheme : study.schemes) {
    table.rows.push_back({scheme.scheme, order_text(scheme.order),
                          std::isnan(scheme.expected) ? "none" : format_number(scheme.expected, 1),
                          std::to_string(scheme.step.size()), scheme.meaning});
  }
  return table;
}

Table slip_table(const verification::ConvergenceStudy& study) {
  using enum Alignment;
  Table table{
      .caption = "The scheme with adaptive substeps, corrected and as the seed prints it.",
      .header = {"Variant", "TOL", "Time in", "Error", "Advanced", "Accepted", "Rejected", "Reached the end"},
      .alignment = {left, right, centre, right, right, right, right, centre}};
  for (const auto& run : study.slips) {
    table.rows.push_back({run.variant, fmt::format("{:.0e}", run.tolerance), run.time_unit,
                          format_number(run.error, 2), format_number(run.advanced, 4),
                          std::to_string(run.accepted), std::to_string(run.rejected),
                          run.finished ? "yes" : "no"});
  }
  table.notes = {
      "(5a): w = y_half + tau/2 F(y) + tau/2 F(y_half) advances by 1.5 tau and 2w − v by 2 tau: "
      "whatever the tolerance, the increment is advanced twice.",
      "Rejection where TOL > EST: good substeps are thrown away and bad ones kept; once a substep that "
      "is left meets its tolerance, nothing is accepted any more.",
      "(6b): the minimum of ratios and a time depends on the unit of time. In seconds and hours the "
      "time is the larger number and does nothing; in days, with less than one left, each substep is "
      "shorter than the last and the increment does not end."};
  return table;
}

Table outcome_table(const verification::RandomPathStudy& study) {
  using enum Alignment;
  Table table{.caption = "How the random paths ended.",
              .header = {"Outcome", "Paths", "Share"},
              .alignment = {left, right, right}};
  for (const auto outcome : {PathOutcome::complete, PathOutcome::pressure_gone, PathOutcome::domain_left,
                             PathOutcome::failed, PathOutcome::no_reference}) {
    const std::size_t count = study.count(outcome);
    table.rows.push_back({verification::name(outcome), std::to_string(count),
                          percent(static_cast<double>(count) / static_cast<double>(study.records.size()))});
  }
  return table;
}

Table quantile_table(const verification::RandomPathStudy& study) {
  using enum Alignment;
  Table table{.caption = "Achieved error max(|dT|/max(|T|, 1 Pa), |de|).",
              .header = {"Share of paths", "error/TOL at most", "per 0.1 of path at most"},
              .alignment = {left, right, right}};
  const auto errors = study.errors_over_tolerance();
  const auto per_path = study.errors_over_path();
  for (const double q : {0.5, 0.9, 0.99, 0.999, 1.0}) {
    table.rows.push_back({percent(q), format_number(verification::quantile(errors, q), 3),
                          format_number(verification::quantile(per_path, q), 3)});
  }
  table.notes = {"Paths shorter than 0.1 count as 0.1 in the last column."};
  return table;
}

/// Why errors grow where they do, with the numbers of this sample.
std::string explanation(const verification::RandomPathStudy& study) {
  constexpr double kLimit = 10.0;
  constexpr double kNearTheEnd = 0.35;
  std::size_t beyond = 0;
  std::size_t near_the_end = 0;
  for (const auto& record : study.records) {
    if (!(record.error > kLimit * study.plan.tolerance)) continue;
    ++beyond;
    if (record.least_F < kNearTheEnd) ++near_the_end;
  }
  const std::string growth = fmt::format(
      "Where the response is elastic, stress follows strain as exp(strain/kappa). A substep with EST = "
      "s TOL then leaves an error of (2/3) s TOL in ln|T| for each unit that ln|T| moves (the log "
      "length), and nothing makes it fade: the share s of the tolerance that EST may take is a quarter "
      "for this reason. What goes beyond comes from states close to q = 3p, where the lateral stress "
      "vanishes: the stiffness goes with F squared, and an error made at a small F is magnified when "
      "the stress is led back. Of the {} paths beyond 10 TOL, {} came below F = {}.",
      beyond, near_the_end, kNearTheEnd);
  std::size_t left = 0;
  std::size_t rotating = 0;
  for (const auto& record : study.records) {
    if (record.outcome != PathOutcome::domain_left) continue;
    ++left;
    if (verification::random_path(study.plan.seed, record.index).parameters.rotates()) ++rotating;
  }
  const std::string ends =
      left == 0 ? ""
                : fmt::format(
                      " {} paths left the law's domain, {} of them with a rotating ellipse: it vanishes "
                      "where (3/2) Omega:Omega reaches M squared, as an Omega won in compression can when M "
                      "falls towards extension. The reference ends there too, and the path is followed up to "
                      "there.",
                      left, rotating);
  return growth + ends;
}

Table worst_table(const verification::RandomPathStudy& study) {
  using enum Alignment;
  constexpr std::size_t kRows = 10;
  Table table{.caption = "The worst paths.",
              .header = {"Path", "error/TOL", "Length", "Log length", "Least F", "Substeps", "kappa", "I_v",
                         "Outcome"},
              .alignment = {right, right, right, right, right, right, right, right, left}};
  std::vector<const verification::PathRecord*> worst;
  for (const auto& record : study.records) worst.push_back(&record);
  const std::size_t rows = std::min(kRows, worst.size());
  std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(rows), worst.end(),
                    [](const auto* a, const auto* b) { return a->error > b->error; });
  worst.resize(rows);
  for (const auto& record : study.records) {
    if (record.outcome == PathOutcome::failed) worst.push_back(&record);
  }
  for (const auto* record : worst) {
    const auto parameters = verification::random_path(study.plan.seed, record->index).parameters;
    table.rows.push_back(
        {std::to_string(record->index), format_number(record->error / study.plan.tolerance, 3),
         format_number(record->length, 3), format_number(record->log_length, 3),
         format_number(record->least_F, 2), std::to_string(record->substeps),
         format_number(parameters.kappa(), 2), format_number(parameters.I_v(), 2),
         verification::name(record->outcome) + (record->message.empty() ? "" : ": " + record->message)});
  }
  table.notes = {
      fmt::format("`isotach verify --seed {} --random-path N` repeats path N by itself and writes it as an "
                  "element test.",
                  study.plan.seed)};
  return table;
}

}  // namespace

Page verification_report(const RunInfo& run, const Verification& result) {
  Page page("Constitutive verification",
            fmt::format("isotach {} · version {} · visco-hypoplastic law and its integration", run.command,
                        run.version));
  add_summary(page, result);
  if (result.failed() > 0) page.table(check_table(result, "", "Checks that failed."));

  page.section("Reference numbers and closed forms");
  page.paragraph(
      "Every number of the project's reference table for parameter set A, by all integrators; the "
      "explicit scheme at three tolerances, so that its error can be seen to shrink with them. It is "
      "allowed ten times the tolerance for each 0.1 of strain; holds, which have no strain of their "
      "own, count as 0.1.");
  Table references =
      difference_table(result, "reference numbers",
                       "Set A: relative differences from the reference numbers, integrator and tolerance.");
  references.notes = {
      "The reference numbers come from an independent implementation (implicit Radau, rtol 1e-11) and "
      "are printed with seven to eleven digits, which limits the smallest differences. The last column "
      "is the largest share that any integrator takes of what it is allowed."};
  page.table(std::move(references));
  page.table(difference_table(result, "closed forms", "Relative differences from closed forms."));

  page.section("Order of convergence, and the scheme as printed");
  page.paragraph(
      "Errors at the end of a general strain path (no symmetry, C_1 = 0.1, strain 0.025) for seven "
      "step sizes; the order is the slope of a straight line in logarithms. CVODE chooses order and "
      "steps by itself: its slope is that of error over mean step as its tolerance is tightened, and "
      "no order is claimed. The seed paper prints three slips in the scheme of Fellin and Ostermann "
      "(2002); each was programmed as printed, one at a time.");
  page.figures(convergence_figure(result.convergence), estimate_figure(result.convergence));
  page.table(order_table(result.convergence));
  page.table(slip_table(result.convergence));

  page.section("Error control over random strain paths");
  page.paragraph(
      fmt::format("{} paths ({} size), each with random parameters, state and strain path over the "
                  "admissible range: rates 1e-9 to 1e3 /s, OCR 0.8 to 50, stress ratios up to 0.95 M, "
                  "I_v from 0.01, kappa from 0.0006, a quarter of them with an inclined and rotating "
                  "ellipse, up to 0.5 of strain in up to four segments with reversals and holds. "
                  "Fellin-Ostermann at a relative tolerance of {:.0e} is compared at four checkpoints "
                  "a segment with Rosenbrock at 1e-10, and that on {} paths with CVODE at 1e-12 "
                  "(largest difference {} TOL).",
                  result.random_paths.records.size(),
                  result.plan.sampling == verification::Sampling::full ? "full" : "quick",
                  result.random_paths.plan.tolerance, result.random_paths.reference_errors.size(),
                  result.random_paths.reference_errors.empty()
                      ? std::string(kMissing)
                      : format_number(*std::max_element(result.random_paths.reference_errors.begin(),
                                                        result.random_paths.reference_errors.end()) /
                                          result.random_paths.plan.tolerance,
                                      2)));
  page.figures(error_distribution_figure(result.random_paths), error_over_length_figure(result.random_paths));
  page.table(outcome_table(result.random_paths));
  page.table(quantile_table(result.random_paths));
  page.table(worst_table(result.random_paths));
  page.paragraph(explanation(result.random_paths));
  page.table(check_table(result, "random paths", "Checks."));

  page.section("Cross-check along named paths");
  page.figure(cross_check_error_figure(result.curves));
  for (std::size_t i = 0; i < result.curves.size(); i += 2) {
    if (i + 1 < result.curves.size()) {
      page.figures(cross_check_figure(result.curves[i]), cross_check_figure(result.curves[i + 1]));
    } else {
      page.figure(cross_check_figure(result.curves[i]));
    }
  }
  page.table(check_table(result, "cross-check", "Largest errors along the paths."));

  page.section("Consistent tangent");
  page.paragraph(
      "The tangent is the exact derivative of the discrete map, by automatic differentiation of the "
      "substeps taken. As such it is compared with automatic differentiation by another route "
      "(parameters, state and increment all differentiable) and with central differences of one "
      "substep. Against the tangent of the exact solution, by differences of Rosenbrock at 1e-12, it "
      "is an approximation as good as the map itself.");
  page.figure(tangent_figure(result.tangents));
  page.table(check_table(result, "tangent",
                         fmt::format("First increments of {} random paths, strain 1e-5 to 1e-2.",
                                     result.tangents.records.size())));

  page.section("Properties of the law");
  page.table(check_table(result, "properties", "The worst of all random states or paths."));

  page.section("Work and precision");
  page.paragraph(
      "Each point is one run at one tolerance, tightened tenfold from point to point. Lower is better.");
  std::set<std::string> drawn;
  for (const auto& curve : result.work) {
    const std::string& name = curve.named.path.name;
    if (drawn.insert(name).second) {
      page.figures(work_figure(result.work, name, false), work_figure(result.work, name, true));
    }
  }
  return page;
}

Page random_path_report(const RunInfo& run, const verification::Path& path,
                        const verification::PathRecord& record, double tolerance) {
  Page page("One random path of the verification",
            fmt::format("isotach {} · version {} · {}", run.command, run.version, path.name));
  page.verdict(record.outcome == PathOutcome::failed ? Tone::bad : Tone::plain,
               fmt::format("{}: achieved error {} TOL.", verification::name(record.outcome),
                           format_number(record.error / tolerance, 3)));
  page.fact("Tolerance", fmt::format("{:.0e}, Fellin-Ostermann, relative", tolerance));
  page.fact("Length", fmt::format("integral |D| dt = {}", format_number(record.length, 4)));
  page.fact("Work", fmt::format("{} substeps, {} evaluations", record.substeps, record.evaluations));
  if (!record.message.empty()) page.box(Tone::warning, record.message);
  page.section("The path as an element test");
  page.preformatted(element_toml(path));
  return page;
}

}  // namespace isotach::reports
