// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Columns of oedometer curves.
#include "reports/oedometer_curves_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/estimates.hpp"
#include "reports/file_stems.hpp"
#include "reports/oedometer_view.hpp"
#include "reports/start_section.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using calibration::OedometerFit;

using Column = std::vector<double>;
using Texts = std::vector<std::string>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void write_test(OutputDirectory& output, const std::string& name, const TestView& view) {
  const auto& rows = view.experiment.test().record.rows;
  Column time;
  Column strain;
  Column void_ratio;
  Texts stage;
  Column measured;
  for (const datasets::OedometerRow& row : rows) {
    time.push_back(row.time);
    strain.push_back(row.axial_strain);
    void_ratio.push_back(view.experiment.void_ratio_of(row));
    stage.emplace_back(datasets::name_of(row.stage));
    measured.push_back(kPerPascal * row.axial_stress);
  }
  Column fitted_stress(rows.size(), kNone);
  Column fitted_strain(rows.size(), kNone);
  for (const experiments::PathPoint& point : view.path) {
    if (point.row == experiments::kNoRow) continue;
    fitted_stress[point.row] = kPerPascal * point.axial_stress;
    fitted_strain[point.row] = point.axial_strain;
  }
  Texts quantity(rows.size());
  Column residual(rows.size(), kNone);
  Column white(rows.size(), kNone);
  for (std::size_t i = 0; i < view.experiment.values().size(); ++i) {
    const experiments::ComparedValue& value = view.experiment.values()[i];
    quantity[value.row] = value.kind == experiments::ValueKind::strain ? "strain" : "stress";
    residual[value.row] = view.scaled[i];
    if (!view.white.empty()) white[value.row] = view.white[i];
  }
  const std::vector<CsvColumn> columns{{"time_s", time},
                                       {"axial_strain", strain},
                                       {"void_ratio", void_ratio},
                                       {"stage", stage},
                                       {"measured_stress_kPa", measured},
                                       {"fitted_stress_kPa", fitted_stress},
                                       {"fitted_strain", fitted_strain},
                                       {"quantity", quantity},
                                       {"residual_in_noise", residual},
                                       {"whitened_residual", white}};
  output.write_csv(name, columns);
}

void write_isotachs(OutputDirectory& output, const std::string& name, const TestView& view) {
  const CompressionCurve measured = measured_curve(view);
  if (measured.stress.empty()) return;
  const auto [least, greatest] = std::minmax_element(measured.stress.begin(), measured.stress.end());
  Column rate;
  Column stress;
  Column void_ratio;
  constexpr int kPieces = 40;
  for (const integrators::Isotach& isotach : view.isotachs) {
    for (int i = 0; i <= kPieces; ++i) {
      rate.push_back(isotach.axial_strain_rate());
      stress.push_back(*least * std::pow(*greatest / *least, static_cast<double>(i) / kPieces));
      void_ratio.push_back(view.void_ratio_on(isotach, stress.back() / kPerPascal));
    }
  }
  output.write_csv(name, std::vector<CsvColumn>{
                             {"rate_per_s", rate}, {"axial_stress_kPa", stress}, {"void_ratio", void_ratio}});
}

void write_constructions(OutputDirectory& output, const std::string& name,
                         const calibration::Constructions& drawn) {
  Texts line;
  Column stress;
  Column void_ratio;
  for (const ConstructionLine& one : construction_lines(drawn)) {
    line.insert(line.end(), one.stress.size(), one.name);
    stress.insert(stress.end(), one.stress.begin(), one.stress.end());
    void_ratio.insert(void_ratio.end(), one.void_ratio.begin(), one.void_ratio.end());
  }
  output.write_csv(
      name, std::vector<CsvColumn>{{"line", line}, {"axial_stress_kPa", stress}, {"void_ratio", void_ratio}});
}

void write_work(OutputDirectory& output, const std::string& name, const calibration::BeckerYield& becker) {
  Column stress;
  Column work;
  for (const calibration::WorkPoint& point : becker.points) {
    stress.push_back(kPerPascal * point.stress);
    work.push_back(kPerPascal * point.work);
  }
  output.write_csv(name, std::vector<CsvColumn>{{"axial_stress_kPa", stress}, {"work_kJ_per_m3", work}});
}

void write_profiles(OutputDirectory& output, const OedometerFit& fit) {
  Texts parameter;
  Column value;
  Column rise;
  Column threshold;
  for (const calibration::Profile& profile : fit.assessment->profiles) {
    const calibration::Coordinate& coordinate = fit.result.coordinates[profile.coordinate];
    for (const calibration::ProfilePoint& point : profile.points) {
      parameter.push_back(quantity_key(coordinate));
      value.push_back(quantity_at(coordinate, point.x));
      rise.push_back(point.delta);
      threshold.push_back(profile.threshold);
    }
  }
  output.write_csv("curves/oedometer_profiles.csv",
                   std::vector<CsvColumn>{
                       {"parameter", parameter}, {"value", value}, {"rise", rise}, {"threshold", threshold}});
}

void write_starts(OutputDirectory& output, const OedometerFit& fit) {
  const auto& coordinates = fit.result.coordinates;
  Texts kind;
  std::vector<Column> quantities(coordinates.size());
  for (const std::vector<double>& x : fit.assessment->multi_start.from) {
    kind.emplace_back("start");
    for (std::size_t k = 0; k < x.size(); ++k) quantities[k].push_back(quantity_at(coordinates[k], x[k]));
  }
  for (const calibration::Cluster& cluster : fit.assessment->multi_start.clusters) {
    kind.emplace_back("answer");
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      quantities[k].push_back(quantity_at(coordinates[k], cluster.best[static_cast<Eigen::Index>(k)]));
    }
  }
  std::vector<CsvColumn> columns{{"kind", kind}};
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    columns.push_back({quantity_key(coordinates[k]), quantities[k]});
  }
  output.write_csv("curves/oedometer_starts.csv", columns);
}

}  // namespace

void write_oedometer_curves(OutputDirectory& output, const OedometerFit& fit) {
  FileStems stems;
  std::size_t fitted = 0;
  for (const TestView& view : views_of(fit)) {
    const std::string file = stems.of(view.experiment.name()) + ".csv";
    write_test(output, "curves/oedometer/" + file, view);
    write_isotachs(output, "curves/oedometer_isotachs/" + file, view);
    if (view.summary.held_out) continue;
    if (fit.start && fitted < fit.start->tests.size()) {
      const calibration::Constructions& drawn = fit.start->tests[fitted];
      write_constructions(output, "curves/oedometer_constructions/" + file, drawn);
      if (drawn.becker) write_work(output, "curves/oedometer_work/" + file, *drawn.becker);
    }
    ++fitted;
  }
  if (!fit.assessment) return;
  write_profiles(output, fit);
  write_starts(output, fit);
}

}  // namespace isotach::reports
