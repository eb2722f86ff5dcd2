// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The section on the seed's test 1 under refinement.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/mpm_problems/cell_limit.hpp"
#include "bench/mpm_problems/vhp_slump.hpp"

namespace isotach::bench {

namespace {

constexpr std::array<double, 5> kTimes{0.5, 1.0, 5.0, 15.0, 30.0};  // s
constexpr std::size_t kShortRun = 3;                                // times of a run to 5 s
constexpr double kCells = 0.0039;  // m, where one choice is changed at a time
constexpr double kPercent = 100.0;
constexpr double kMillimetre = 1e-3;

mpm::SlumpResult run(double cell_size, std::size_t times = kTimes.size(),
                     const std::function<void(mpm::SlumpSetup&)>& change = nullptr) {
  mpm::SlumpSetup setup = seed_test_1(cell_size, {kTimes.begin(), kTimes.begin() + std::ptrdiff_t(times)});
  if (change) change(setup);
  return run_seed_mud(setup);
}

std::string millimetres(double length, int digits = 2) {
  return fmt::format("{:.{}f}", length / kMillimetre, digits);
}

std::string percent(double share) {
  return fmt::format("{:.2f}", kPercent * share);
}

/// What every table of runs tells, after a column that names the run.
std::vector<std::string> head_of_runs(const std::string& name) {
  std::vector<std::string> head{name, "points"};
  for (const char* quantity : {"height", "toe"}) {
    for (const double time : kTimes) head.push_back(fmt::format("{}, {:g} s", quantity, time));
  }
  for (const char* rest : {"volume (%)", "outline (%)", "energy (%)", "substepped (%)", "floored"}) {
    head.emplace_back(rest);
  }
  return head;
}

std::vector<std::string> row_of_run(const std::string& name, const mpm::SlumpResult& result) {
  std::vector<std::string> row{name, fmt::format("{}", result.points)};
  for (const bool height : {true, false}) {
    for (std::size_t k = 0; k < kTimes.size(); ++k) {
      const bool reached = k < result.outlines.size();
      row.push_back(reached ? millimetres(height ? result.outlines[k].height() : result.outlines[k].toe())
                            : "");
    }
  }
  row.push_back(percent(result.volume_error));
  row.push_back(percent(result.outline_volume_error));
  row.push_back(percent(result.energy_error));
  row.push_back(percent(static_cast<double>(result.substepped) / result.particle_steps));
  row.push_back(fmt::format("{}", result.floored));
  return row;
}

/// Runs of one number of points a cell, coarse cells to fine ones.
struct Refinement {
  int points;
  std::vector<mpm::SlumpResult> runs;
};

/// The default's first. Fine cells do not go on beyond 5 s, nor do more points.
std::vector<Refinement> refine() {
  const int usual = mpm::Numerics{}.points_per_cell;
  std::vector<Refinement> all{{usual, {}}, {9, {}}, {16, {}}};
  for (const double cell_size : {0.0078, kCells, 0.0026, 0.00195}) all[0].runs.push_back(run(cell_size));
  for (const double cell_size : {0.0013, 0.001}) all[0].runs.push_back(run(cell_size, kShortRun));
  const auto add = [](Refinement& refinement, double cell_size) {
    refinement.runs.push_back(run(cell_size, kShortRun, [&refinement](mpm::SlumpSetup& setup) {
      setup.numerics.points_per_cell = refinement.points;
    }));
  };
  for (const double cell_size : {0.0078, kCells, 0.0026, 0.00195}) add(all[1], cell_size);
  for (const double cell_size : {0.0078, kCells, 0.0026}) add(all[2], cell_size);
  return all;
}

SectionTable cells_table(const std::vector<Refinement>& refinements) {
  SectionTable table{head_of_runs("points a cell, cells (mm)"), {}};
  for (const Refinement& refinement : refinements) {
    for (const mpm::SlumpResult& result : refinement.runs) {
      table.rows.push_back(
          row_of_run(fmt::format("{}, {}", refinement.points, millimetres(result.cell_size)), result));
    }
  }
  return table;
}

/// Whether a difference is within a bound, as far as the limit's uncertainty allows to say; all in the same
/// unit.
std::string verdict(double difference, double uncertainty, double bound) {
  if (std::abs(difference) + uncertainty <= bound) return "yes";
  if (std::abs(difference) - uncertainty > bound) return "no";
  return std::abs(difference) <= bound ? "yes, not surely" : "no, not surely";
}

/// A height or a toe at a time, by cell size.
struct Series {
  std::vector<double> cells;   ///< m
  std::vector<double> values;  ///< m
};

Series series_of(const std::vector<mpm::SlumpResult>& runs, std::size_t time, bool height) {
  Series series;
  for (const mpm::SlumpResult& result : runs) {
    if (time >= result.outlines.size()) continue;
    series.cells.push_back(result.cell_size);
    series.values.push_back(height ? result.outlines[time].height() : result.outlines[time].toe());
  }
  return series;
}

std::string text_of(const CellLimit& limit) {
  return fmt::format("{} +- {}", millimetres(limit.value), millimetres(limit.uncertainty));
}

/// The limits of heights and toes, by all cells but the coarsest, and how far the two coarsest runs of the
/// default number of points are from each.
SectionTable limits_table(const std::vector<Refinement>& refinements) {
  SectionTable table{
      {"points a cell", "time (s)", "", "cells (mm)", "limit (mm)", "by the finest three (mm)",
       "4 points, 7.8 mm cells: off by (%)", "within 3 %", "3.9 mm: off by (%)", "within 1.5 %"},
      {}};
  for (const Refinement& refinement : refinements) {
    for (std::size_t time = 0; time < kTimes.size(); ++time) {
      for (const bool height : {true, false}) {
        const Series series = series_of(refinement.runs, time, height);
        if (series.cells.size() < 4) continue;
        const std::span<const double> cells(series.cells);
        const std::span<const double> values(series.values);
        const CellLimit limit = cell_limit(cells.subspan(1), values.subspan(1));
        std::vector<std::string> row{
            fmt::format("{}", refinement.points),
            fmt::format("{:g}", kTimes[time]),
            height ? "height" : "toe",
            fmt::format("{} to {}", millimetres(cells[1]), millimetres(cells.back())),
            text_of(limit),
            text_of(cell_limit(cells.last(3), values.last(3)))};
        const Series by_default = series_of(refinements.front().runs, time, height);
        const double uncertainty = kPercent * limit.uncertainty / limit.value;
        for (const auto& [value, bound] :
             {std::pair(by_default.values[0], 3.0), std::pair(by_default.values[1], 1.5)}) {
          const double difference = kPercent * (value / limit.value - 1.0);
          row.push_back(fmt::format("{:+.2f} +- {:.2f}", difference, uncertainty));
          row.push_back(verdict(difference, uncertainty, bound));
        }
        table.rows.push_back(row);
      }
    }
  }
  return table;
}

/// A choice other than the default.
struct Change {
  std::string name;
  std::function<void(mpm::SlumpSetup&)> apply;
};

std::vector<Change> changes() {
  std::vector<Change> all;
  for (const double bulk : {600e3, 1200e3, 2400e3}) {
    all.push_back({fmt::format("K_w = {:g} kPa", bulk / 1e3),
                   [bulk](mpm::SlumpSetup& setup) { setup.numerics.water_bulk_modulus = bulk; }});
  }
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    all.push_back({fmt::format("tolerance {:g}", tolerance),
                   [tolerance](mpm::SlumpSetup& setup) { setup.numerics.tolerance = tolerance; }});
  }
  all.push_back({"plain inertia", [](mpm::SlumpSetup& setup) { setup.numerics.inertia_scaling = 1.0; }});
  all.push_back({"rough wall", [](mpm::SlumpSetup& setup) { setup.mould.wall = mpm::Wall::rough(); }});
  return all;
}

SectionTable changes_table(const mpm::SlumpResult& by_default) {
  SectionTable table{head_of_runs("3.9 mm cells"), {}};
  table.rows.push_back(row_of_run("default", by_default));
  for (const Change& change : changes()) {
    table.rows.push_back(row_of_run(change.name, run(kCells, kTimes.size(), change.apply)));
  }
  return table;
}

/// Steps halved twice: where the slump ends up, and how much of that is creep after 5 s.
SectionTable steps_table(const mpm::SlumpResult& by_default) {
  SectionTable table{{"Courant number", "steps", "height, 30 s", "moved by", "toe, 30 s", "moved by",
                      "height, 5 to 30 s", "toe, 5 to 30 s", "volume (%)", "energy (%)"},
                     {}};
  auto add = [&, last = std::pair(std::nan(""), std::nan(""))](double courant,
                                                               const mpm::SlumpResult& result) mutable {
    const double height = result.outlines.back().height();
    const double toe = result.outlines.back().toe();
    const auto moved = [](double now, double before) {
      return std::isnan(before) ? std::string() : fmt::format("{:+.3f}", (now - before) / kMillimetre);
    };
    table.rows.push_back({fmt::format("{:g}", courant), fmt::format("{}", result.steps),
                          millimetres(height, 3), moved(height, last.first), millimetres(toe, 3),
                          moved(toe, last.second), moved(height, result.outlines[kShortRun - 1].height()),
                          moved(toe, result.outlines[kShortRun - 1].toe()), percent(result.volume_error),
                          percent(result.energy_error)});
    last = {height, toe};
  };
  add(mpm::Numerics{}.courant, by_default);
  for (const double courant : {0.4, 0.2}) {
    add(courant,
        run(kCells, kTimes.size(), [courant](mpm::SlumpSetup& setup) { setup.numerics.courant = courant; }));
  }
  return table;
}

constexpr const char* kText =
    "The mud of the seed paper at e = 3.891, 140 mm high in the mould of 78 mm, raised at 0.06 m/s; smooth "
    "wall, rough "
    "base, the default numerics but for what a row names. Heights and toes in mm. 'Volume' is the largest "
    "change of "
    "the points' volume, 'outline' that of the volume inside the outlines, 'energy' the largest gap in the "
    "energy "
    "budget over the initial potential energy; 'substepped' the share of point updates for which one step of "
    "the law "
    "was not enough, 'floored' the number that left the law's domain.\n\n"
    "From 1 s on and below 4 mm, heights and toes scatter with the cell size by a few tenths of a millimetre "
    "and tend "
    "nowhere at one order or from one side. So the limit is not Richardson's: lines in h and in h^2 are "
    "fitted by least "
    "squares to all cells but the coarsest; the limit is the mean of where they meet h = 0, its uncertainty "
    "the largest "
    "distance from there to either and to any value fitted. The limit by the finest three alone, beside it, "
    "extrapolates scatter. 'Not surely' says that the uncertainty reaches over the bound.\n\n"
    "The number of points a cell matters more than the cells. With 9 and 16, outlines hold the mud's volume "
    "better, "
    "heights are about 1 mm lower and toes 1 to 1.6 mm further out at every cell size below 8 mm, and the "
    "limits by 4 "
    "and by 9 points differ by more than both uncertainties. So the limit by 4 points is that of the default "
    "number of "
    "points and not of the slump: cells of 3.9 mm with 4 points are within 1.5 % of it from 1 s on, and 2 to "
    "3 % off the "
    "limit by 9 points. Those of 7.8 mm are within 3 % of either.\n\n"
    "A stiffer pore water takes the volume error with it and moves heights and toes by no more than the "
    "scatter, nor "
    "does the tolerance move them by more. The energy gap falls with the cell size; it is above 1 % with "
    "cells of "
    "7.8 mm, and with plain inertia, which takes eight times the steps. A rough wall still carries the mud "
    "at 0.5 s "
    "and holds it back for good.\n\n"
    "Steps halved in the fast part move height and toe by some 0.1 to 0.3 mm, without an order and in either "
    "direction for the toe (eight fills of 140 to 142 mm, cells of 4 mm, at 30 s: heights 0.15 to 0.27 mm "
    "lower, toes from 0.17 mm shorter to 0.11 mm longer); cells matter more. Late creep does not depend on "
    "the step: from 5 to 30 s it changes by a few hundredths of a millimetre, and from one state at 5 s on, "
    "halved steps move height and toe at 30 s by less than 0.1 mm (a test).";

}  // namespace

Section vhp_slump_section() {
  const std::vector<Refinement> refinements = refine();
  const mpm::SlumpResult& by_default = refinements.front().runs[1];
  return {"Slump of the seed's test 1",
          kText,
          {cells_table(refinements), limits_table(refinements), changes_table(by_default),
           steps_table(by_default)}};
}

}  // namespace isotach::bench
