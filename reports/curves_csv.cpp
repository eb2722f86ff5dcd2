// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Curves as columns.
#include "reports/curves_csv.hpp"

#include <fmt/format.h>

#include "reports/estimates.hpp"
#include "reports/file_stems.hpp"
#include "reports/oedometer_curves_csv.hpp"
#include "reports/units.hpp"

namespace isotach::reports {
namespace {

using Column = std::vector<double>;

void write_convergence(OutputDirectory& output, const std::string& name,
                       const calibration::FitResult& result) {
  std::vector<std::string> routes;
  Column evaluations;
  Column costs;
  std::vector<Column> quantities(result.coordinates.size());
  const auto add = [&](const calibration::OptimiserResult& route) {
    for (const calibration::TracePoint& point : route.trace) {
      routes.push_back(route.route);
      evaluations.push_back(point.evaluation);
      costs.push_back(point.cost);
      for (std::size_t k = 0; k < quantities.size(); ++k) {
        quantities[k].push_back(quantity_at(result.coordinates[k], point.coordinates[k]));
      }
    }
  };
  add(result.main);
  if (result.check) add(*result.check);
  std::vector<CsvColumn> columns{{"route", routes}, {"evaluation", evaluations}, {"cost", costs}};
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    columns.push_back({quantity_key(result.coordinates[k]), quantities[k]});
  }
  output.write_csv(name, columns);
}

void write_distances(OutputDirectory& output, const std::string& name,
                     const calibration::SlumpComparison& comparison) {
  const experiments::SlumpExperiment& test = *comparison.experiment;
  Column time;
  Column r;
  Column z;
  Column distance;
  Column gone;
  for (const datasets::Outline& outline : test.test().outlines) {
    for (const datasets::OutlinePoint& point : outline.points) {
      const std::size_t i = distance.size();
      time.push_back(outline.time);
      r.push_back(kMillimetres * point.r);
      z.push_back(kMillimetres * point.z);
      distance.push_back(kMillimetres * comparison.distances[i]);
      gone.push_back(test.mould_gone()[i] ? 1.0 : 0.0);
    }
  }
  const std::vector<CsvColumn> columns{{"time_s", time},
                                       {"r_mm", r},
                                       {"z_mm", z},
                                       {"distance_mm", distance},
                                       {"distance_in_noise", test.in_noise(comparison.distances)},
                                       {"mould_gone", gone}};
  output.write_csv(name, columns);
}

}  // namespace

void write_outlines(OutputDirectory& output, const std::string& name,
                    const std::vector<mpm::Outline>& outlines) {
  Column time;
  Column r;
  Column z;
  for (const mpm::Outline& outline : outlines) {
    for (const mpm::OutlinePoint& point : outline.points) {
      time.push_back(outline.time);
      r.push_back(kMillimetres * point.r);
      z.push_back(kMillimetres * point.z);
    }
  }
  output.write_csv(name, std::vector<CsvColumn>{{"time_s", time}, {"r_mm", r}, {"z_mm", z}});
}

void write_curves(OutputDirectory& output, const calibration::OedometerFit& fit) {
  write_oedometer_curves(output, fit);
  write_convergence(output, "curves/oedometer_convergence.csv", fit.result);
}

void write_curves(OutputDirectory& output, const calibration::SlumpFit& fit) {
  FileStems stems;
  for (const calibration::SlumpComparison& comparison : fit.comparisons) {
    const std::string stem = stems.of(comparison.experiment->name());
    write_outlines(output, fmt::format("curves/slump/{}_outlines.csv", stem), comparison.simulation.outlines);
    write_distances(output, fmt::format("curves/slump/{}_distances.csv", stem), comparison);
  }
  write_convergence(output, "curves/slump_convergence.csv", fit.result);
}

void write_curves(OutputDirectory& output, const calibration::Calibration& calibration) {
  write_curves(output, calibration.oedometer);
  write_curves(output, calibration.slump);
}

void write_curves(OutputDirectory& output, const mpm::SlumpResult& result, const std::string& folder) {
  write_outlines(output, folder + "outlines.csv", result.outlines);
  std::vector<CsvColumn> columns;
  const auto add = [&](const char* header, double mpm::HistoryRow::*quantity, double factor) {
    Column values;
    for (const mpm::HistoryRow& row : result.history) values.push_back(factor * (row.*quantity));
    columns.push_back({header, std::move(values)});
  };
  add("time_s", &mpm::HistoryRow::time, 1.0);
  add("height_mm", &mpm::HistoryRow::height, kMillimetres);
  add("toe_mm", &mpm::HistoryRow::toe, kMillimetres);
  add("kinetic_J", &mpm::HistoryRow::kinetic, 1.0);
  add("potential_J", &mpm::HistoryRow::potential, 1.0);
  add("stress_work_J", &mpm::HistoryRow::stress_work, 1.0);
  add("boundary_work_J", &mpm::HistoryRow::boundary_work, 1.0);
  add("volume_mm3", &mpm::HistoryRow::volume, kMillimetres * kMillimetres * kMillimetres);
  add("inertia_scaling", &mpm::HistoryRow::inertia_scaling, 1.0);
  output.write_csv(folder + "history.csv", columns);
}

}  // namespace isotach::reports
