// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The verification as JSON and CSV, and a path as an element test file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "reports/json_number.hpp"
#include "reports/result_head.hpp"
#include "reports/verification_figures.hpp"
#include "reports/verification_report.hpp"

namespace isotach::reports {

using nlohmann::ordered_json;
using verification::PathOutcome;
using verification::Verification;

namespace {

constexpr std::array<const char*, 6> kComponents{"11", "22", "33", "12", "13", "23"};

/// Columns that grow row by row under fixed headers.
class Rows {
 public:
  explicit Rows(std::vector<std::string> texts, std::vector<std::string> numbers) {
    for (auto& header : texts) columns_.push_back({std::move(header), std::vector<std::string>{}});
    for (auto& header : numbers) columns_.push_back({std::move(header), std::vector<double>{}});
  }
  void add(const std::vector<std::string>& texts, const std::vector<double>& numbers) {
    std::size_t k = 0;
    for (const std::string& text : texts)
      std::get<std::vector<std::string>>(columns_[k++].values).push_back(text);
    for (const double number : numbers) std::get<std::vector<double>>(columns_[k++].values).push_back(number);
  }
  void write(OutputDirectory& output, const std::string& name) const { output.write_csv(name, columns_); }

 private:
  std::vector<CsvColumn> columns_;
};

std::string file_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '=' || c == '.'; }, '-');
  return name;
}

void write_random_paths(OutputDirectory& output, const verification::RandomPathStudy& study) {
  Rows distribution({"measure"}, {"value", "share_above"});
  const auto add = [&distribution](const char* measure, const std::vector<double>& sorted) {
    const Survival curve = survival(sorted);
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      distribution.add({measure}, {curve.value[i], curve.share[i]});
    }
  };
  add("error_over_TOL", study.errors_over_tolerance());
  add("error_over_TOL_per_0.1_of_path", study.errors_over_path());
  distribution.write(output, "random_paths.csv");

  constexpr std::size_t kWorst = 1000;
  std::vector<const verification::PathRecord*> records;
  for (const auto& record : study.records) records.push_back(&record);
  std::stable_sort(records.begin(), records.end(),
                   [](const auto* a, const auto* b) { return a->error > b->error; });
  records.resize(std::min(kWorst, records.size()));
  Rows worst({"outcome"}, {"path", "error", "length", "substeps", "evaluations"});
  for (const auto* record : records) {
    worst.add({verification::name(record->outcome)},
              {static_cast<double>(record->index), record->error, record->length,
               static_cast<double>(record->substeps), static_cast<double>(record->evaluations)});
  }
  worst.write(output, "random_paths_worst.csv");
}

void write_convergence(OutputDirectory& output, const verification::ConvergenceStudy& study) {
  Rows rows({"scheme"}, {"strain_of_substep", "error"});
  for (const auto& scheme : study.schemes) {
    for (std::size_t i = 0; i < scheme.step.size(); ++i)
      rows.add({scheme.scheme}, {scheme.step[i], scheme.error[i]});
  }
  for (std::size_t i = 0; i < study.est_step.size(); ++i) {
    rows.add({"EST corrected"}, {study.est_step[i], study.est_correct[i]});
    rows.add({"EST (5a) as printed"}, {study.est_step[i], study.est_printed[i]});
  }
  rows.write(output, "convergence.csv");
}

}  // namespace

void write_curves(OutputDirectory& output, const Verification& result) {
  write_convergence(output, result.convergence);
  write_random_paths(output, result.random_paths);
  Rows tangents({}, {"path", "strain", "against_jets", "against_differences", "against_exact_solution"});
  for (const auto& record : result.tangents.records) {
    tangents.add({}, {static_cast<double>(record.index), record.strain, record.jets, record.differences,
                      record.exact_solution});
  }
  tangents.write(output, "tangents.csv");
  Rows work({"path", "integrator"},
            {"tolerance", "error", "evaluations", "jacobians", "accepted", "rejected", "microseconds"});
  for (const auto& curve : result.work) {
    for (const auto& point : curve.points) {
      const auto& cost = point.statistics;
      work.add({curve.named.path.name, std::string(integrators::name(curve.method))},
               {point.tolerance, point.error, static_cast<double>(cost.evaluations),
                static_cast<double>(cost.jacobians), static_cast<double>(cost.accepted),
                static_cast<double>(cost.rejected), point.microseconds});
    }
  }
  work.write(output, "work_precision.csv");
  for (const auto& curve : result.curves) {
    Rows rows({},
              {"time_s", "strain_11", "gamma_12", "p_kPa", "q_kPa", "void_ratio", "fellin_ostermann_p_kPa",
               "fellin_ostermann_q_kPa", "fellin_ostermann_error", "rosenbrock_error"});
    for (const auto& row : curve.rows) {
      rows.add({}, {row.time, row.axial_strain, row.shear_strain, row.p_kPa, row.q_kPa, row.void_ratio,
                    row.fellin_ostermann_p_kPa, row.fellin_ostermann_q_kPa, row.fellin_ostermann_error,
                    row.rosenbrock_error});
    }
    rows.write(output, fmt::format("cross_check/{}.csv", file_name(curve.named.path.name)));
  }
}

ordered_json result_json(const RunInfo& run, const Verification& result) {
  ordered_json json = result_head(run, result.failed() == 0 ? "ok" : "failed");
  const auto& random = result.random_paths;
  json["sampling"] = result.plan.sampling == verification::Sampling::full ? "full" : "quick";
  json["seed"] = result.plan.seed;
  json["checks_failed"] = result.failed();
  const auto errors = random.errors_over_tolerance();
  ordered_json outcomes = ordered_json::object();
  for (const auto outcome : {PathOutcome::complete, PathOutcome::pressure_gone, PathOutcome::domain_left,
                             PathOutcome::failed, PathOutcome::no_reference}) {
    outcomes[verification::name(outcome)] = random.count(outcome);
  }
  json["random_paths"] = {{"paths", random.records.size()},
                          {"tolerance", random.plan.tolerance},
                          {"outcomes", outcomes},
                          {"error_over_tolerance",
                           {{"median", json_number(verification::quantile(errors, 0.5))},
                            {"q99", json_number(verification::quantile(errors, 0.99))},
                            {"q999", json_number(verification::quantile(errors, 0.999))},
                            {"largest", json_number(verification::quantile(errors, 1.0))}}},
                          {"worst_path", random.records[random.worst()].index}};
  json["orders"] = ordered_json::array();
  for (const auto& scheme : result.convergence.schemes) {
    json["orders"].push_back({{"scheme", scheme.scheme},
                              {"order", json_number(scheme.order.order)},
                              {"half_width_95", json_number(scheme.order.half_width)}});
  }
  json["checks"] = ordered_json::array();
  for (const auto& check : result.checks) {
    json["checks"].push_back({{"group", check.group},
                              {"name", check.name},
                              {"integrator", check.integrator},
                              {"expected", json_number(check.expected)},
                              {"got", json_number(check.got)},
                              {"tolerance", json_number(check.tolerance)},
                              {"pass", check.pass()},
                              {"note", check.note}});
  }
  return json;
}

ordered_json result_json(const RunInfo& run, const verification::Path& path,
                         const verification::PathRecord& record, double tolerance) {
  ordered_json json = result_head(run, record.outcome == PathOutcome::failed ? "failed" : "ok");
  json["path"] = path.name;
  json["outcome"] = verification::name(record.outcome);
  json["message"] = record.message;
  json["tolerance"] = tolerance;
  json["error"] = json_number(record.error);
  json["length"] = json_number(record.length);
  json["substeps"] = record.substeps;
  json["evaluations"] = record.evaluations;
  return json;
}

std::string element_toml(const verification::Path& path) {
  std::string text = fmt::format("# {}\n[material]\n", path.name);
  for (const model::ParameterInfo& info : model::kParameterTable) {
    text += fmt::format("{} = {:.17g}\n", info.key, path.parameters[info.id] / info.to_si);
  }
  if (path.parameters.lode() == model::LodeDependence::none) text += "lode_dependence = \"none\"\n";
  const auto tensor = [](const model::Mandel<double>& mandel, double factor) {
    const auto components = model::components_from_mandel<double>(mandel);
    std::string list;
    for (int i = 0; i < 6; ++i) list += fmt::format("{}{:.17g}", i == 0 ? "" : ", ", components[i] * factor);
    return "[" + list + "]";
  };
  // files are compression positive
  text += fmt::format("\n[state]\nstress_kPa = {}\nvoid_ratio = {:.17g}\n", tensor(path.start.stress, -1e-3),
                      path.start.void_ratio);
  if (!path.start.omega.isZero(0.0)) text += fmt::format("omega = {}\n", tensor(path.start.omega, -1.0));
  int number = 0;
  for (const auto& increment : path.increments) {
    text += fmt::format("\n[[stage]]\nname = \"segment {}\"\nduration_s = {:.17g}\nrows = 20\n", ++number,
                        increment.duration);
    const auto rates = model::components_from_mandel<double>(increment.strain_rate);
    std::string list;
    for (int i = 0; i < 6; ++i) {
      if (rates[i] == 0.0) continue;
      list += fmt::format("{}{} = {:.17g}", list.empty() ? "" : ", ",
                          kComponents[static_cast<std::size_t>(i)], -rates[i]);
    }
    if (!list.empty()) text += fmt::format("strain_rate_per_s = {{ {} }}\n", list);
  }
  return text;
}

}  // namespace isotach::reports
