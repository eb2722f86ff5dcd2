// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The tables of docs/seed-programme.md: the slumps of the seed paper, and what its conclusions rest on.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/mpm_problems/section.hpp"
#include "datasets/slump_file.hpp"
#include "integrators/element_test.hpp"
#include "model/law.hpp"
#include "mpm/slump.hpp"

namespace {

using namespace isotach;
using model::ParameterId;

constexpr double kMillimetre = 1e-3;
constexpr std::array<double, 2> kCells{0.008, 0.004};  // m
constexpr std::array<double, 3> kViscosities{0.03, 0.05, 0.06};
constexpr std::array<double, 3> kHypoplasticConstants{0.025, 0.05, 0.1};

datasets::SlumpFile paper_slump(const std::string& name) {
  return datasets::read_slump_file(std::filesystem::path(ISOTACH_SOURCE_DIR "/datasets/pippi2019") /
                                   (name + ".toml"));
}

mpm::SlumpResult run(const datasets::SlumpFile& slump) {
  mpm::RunOptions options;
  options.history = false;
  auto result = mpm::run_slump(slump.material, slump.setup, options);
  if (!result) throw std::runtime_error(slump.file.stem().string() + ": " + result.error().message);
  return std::move(*result);
}

void set(datasets::SlumpFile& slump, ParameterId id, double value) {
  model::ParameterValues<double> values = slump.material.values();
  values[id] = value;
  slump.material = model::Parameters<double>::create(values).value();
}

std::string millimetres(double length) {
  return fmt::format("{:.1f}", length / kMillimetre);
}

void print(const std::string& title, bench::SectionTable table) {
  fmt::print("{}", bench::markdown({title, "", {std::move(table)}}));
  std::fflush(stdout);
}

/// Heights and toes of several files at times that all of them have, a row for each file and cell size.
void print_figure(const std::string& title, const std::vector<std::string>& names,
                  const std::vector<double>& times) {
  bench::SectionTable table{{"file", "cells (mm)", "e0"}, {}};
  for (const char* quantity : {"height", "toe"}) {
    for (const double time : times) table.head.push_back(fmt::format("{}, {:g} s", quantity, time));
  }
  for (const double cell_size : kCells) {
    for (const std::string& name : names) {
      datasets::SlumpFile slump = paper_slump(name);
      slump.setup.numerics.cell_size = cell_size;
      slump.setup.times = times;
      const mpm::SlumpResult result = run(slump);
      std::vector<std::string> row{name, fmt::format("{:g}", cell_size / kMillimetre),
                                   fmt::format("{:.3f}", result.initial.void_ratio)};
      for (const mpm::Outline& outline : result.outlines) row.push_back(millimetres(outline.height()));
      for (const mpm::Outline& outline : result.outlines) row.push_back(millimetres(outline.toe()));
      table.rows.push_back(std::move(row));
    }
  }
  print(title, std::move(table));
}

/// Heights at several times and toes at the last, of three slumps each: "67.7 / 77.4 / 82.0".
std::vector<std::string> heights_and_toes(const std::vector<mpm::SlumpResult>& results) {
  const auto joined = [&results](auto&& length) {
    std::vector<std::string> parts;
    for (const mpm::SlumpResult& result : results) parts.push_back(millimetres(length(result)));
    return fmt::format("{}", fmt::join(parts, " / "));
  };
  std::vector<std::string> cells;
  for (std::size_t k = 0; k < results.front().outlines.size(); ++k) {
    cells.push_back(joined([k](const auto& result) { return result.outlines[k].height(); }));
  }
  cells.push_back(joined([](const auto& result) { return result.outlines.back().toe(); }));
  return cells;
}

std::vector<std::string> head_of(std::vector<std::string> first, const std::vector<double>& times) {
  for (const double time : times) first.push_back(fmt::format("heights, {:g} s", time));
  first.push_back(fmt::format("toes, {:g} s", times.back()));
  return first;
}

datasets::SlumpFile viscosity_slump(double I_v, double strength_rate) {
  datasets::SlumpFile slump = paper_slump("iv-0.03");
  set(slump, ParameterId::I_v, I_v);
  slump.setup.mud.strength_rate = strength_rate;
  return slump;
}

/// What C_u = 0.117 kPa means at other rates.
void print_strengths(const std::vector<double>& strength_rates) {
  constexpr std::array<double, 3> kRates{1.0, 1e-2, 1e-4};
  bench::SectionTable table{{"D_m (1/s)", "I_v", "e0", "p_B0 (kPa)"}, {}};
  for (const double rate : kRates) table.head.push_back(fmt::format("C_u (kPa) at {:g} 1/s", rate));
  for (const double strength_rate : strength_rates) {
    for (const double I_v : kViscosities) {
      const datasets::SlumpFile slump = viscosity_slump(I_v, strength_rate);
      const mpm::InitialState initial = mpm::initial_state(slump.material, slump.setup.mud);
      std::vector<std::string> row{fmt::format("{:g}", strength_rate), fmt::format("{:g}", I_v),
                                   fmt::format("{:.3f}", initial.void_ratio),
                                   fmt::format("{:.3f}", 1e-3 * initial.preconsolidation_pressure)};
      for (const double rate : kRates) {
        row.push_back(
            fmt::format("{:.3f}", 1e-3 * mpm::critical_state_strength(slump.material, initial, rate)));
      }
      table.rows.push_back(std::move(row));
    }
  }
  print("Strength at the rates of a slump, C_1 0.1", std::move(table));
}

/// The I_v study with C_u taken as measured at other rates.
void print_strength_rates(const std::string& title, double fill_height, double lift_speed,
                          const std::vector<double>& strength_rates, const std::vector<double>& times) {
  bench::SectionTable table{head_of({"D_m (1/s)", "cells (mm)"}, times), {}};
  for (const double cell_size : kCells) {
    for (const double strength_rate : strength_rates) {
      std::vector<mpm::SlumpResult> results;
      for (const double I_v : kViscosities) {
        datasets::SlumpFile slump = viscosity_slump(I_v, strength_rate);
        slump.setup.mould.fill_height = fill_height;
        slump.setup.mould.lift_speed = lift_speed;
        slump.setup.numerics.cell_size = cell_size;
        slump.setup.times = times;
        results.push_back(run(slump));
      }
      table.rows.push_back(
          {fmt::format("{:g}", strength_rate), fmt::format("{:g}", cell_size / kMillimetre)});
      for (std::string& cell : heights_and_toes(results)) table.rows.back().push_back(std::move(cell));
    }
  }
  print(title, std::move(table));
}

/// The C_1 study from other overconsolidation ratios.
void print_overconsolidation(const std::vector<double>& times) {
  bench::SectionTable table{head_of({"OCR0", "cells (mm)"}, times), {}};
  for (const double cell_size : kCells) {
    for (const double ocr : {1.0, 1.5, 3.0}) {
      std::vector<mpm::SlumpResult> results;
      for (const double C_1 : kHypoplasticConstants) {
        datasets::SlumpFile slump = paper_slump("c1-0.1");
        set(slump, ParameterId::C_1, C_1);
        slump.setup.mud.overconsolidation_ratio = ocr;
        slump.setup.numerics.cell_size = cell_size;
        slump.setup.times = times;
        results.push_back(run(slump));
      }
      table.rows.push_back({fmt::format("{:g}", ocr), fmt::format("{:g}", cell_size / kMillimetre)});
      for (std::string& cell : heights_and_toes(results)) table.rows.back().push_back(std::move(cell));
    }
  }
  print("C_1 0.025 / 0.05 / 0.1 from other overconsolidation ratios, lengths in mm", std::move(table));
}

/// q and p' over those of the critical state along undrained triaxial compression at |D| = 1 /s.
void print_approach() {
  const std::vector<double> strains{0.01, 0.02, 0.05, 0.1, 0.3};  // |D| t
  bench::SectionTable table{{"OCR0", "C_1"}, {}};
  for (const char* quantity : {"q", "p'"}) {
    for (const double strain : strains) {
      table.head.push_back(fmt::format("{}, {:g} %", quantity, 100.0 * strain));
    }
  }
  for (const double ocr : {1.0, 1.5, 3.0}) {
    for (const double C_1 : kHypoplasticConstants) {
      datasets::SlumpFile slump = paper_slump("c1-0.1");
      set(slump, ParameterId::C_1, C_1);
      slump.setup.mud.overconsolidation_ratio = ocr;
      const mpm::InitialState initial = mpm::initial_state(slump.material, slump.setup.mud);
      model::State<double> state{};
      state.void_ratio = initial.void_ratio;
      state.stress << -initial.mean_effective_pressure * Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero();
      integrators::Stage stage;
      stage.increment.strain_rate << -2.0 / std::sqrt(6.0), 1.0 / std::sqrt(6.0), 1.0 / std::sqrt(6.0), 0.0,
          0.0,
          0.0;  // of norm 1
      std::vector<integrators::Stage> stages;
      double reached = 0.0;
      for (const double strain : strains) {
        stage.increment.duration = strain - reached;
        reached = strain;
        stages.push_back(stage);
      }
      const model::Law<double> law(slump.material);
      const auto rows = integrators::run_element_test(law, state, stages);
      if (!rows) throw std::runtime_error("undrained compression failed");
      const double strength = mpm::critical_state_strength(slump.material, initial, 1.0);
      std::vector<std::string> of_q;
      std::vector<std::string> of_p;
      for (std::size_t k = 1; k < rows->size(); ++k) {
        const auto& stress = (*rows)[k].state.stress;
        const double q = stress[1] - stress[0];
        const double p = -stress.head<3>().mean();
        of_q.push_back(fmt::format("{:.2f}", q / (2.0 * strength)));
        of_p.push_back(fmt::format("{:.2f}", p * law.critical_ratio() / (2.0 * strength)));
      }
      table.rows.push_back({fmt::format("{:g}", ocr), fmt::format("{:g}", C_1)});
      table.rows.back().insert(table.rows.back().end(), of_q.begin(), of_q.end());
      table.rows.back().insert(table.rows.back().end(), of_p.begin(), of_p.end());
    }
  }
  print("q and p' over those of the critical state at strains |D| t, undrained compression at |D| = 1 1/s",
        std::move(table));
}

}  // namespace

int main() try {
  constexpr double kD_r = 6.8e-7;
  print_strengths({kD_r, 1e-4, 1e-2, 1.0});
  print_approach();
  std::vector<std::string> tests;
  for (int k = 1; k <= 8; ++k) tests.push_back(fmt::format("test-{}", k));
  print_figure("Table 1", tests, {2.0, 5.0, 15.0, 30.0});
  print_figure("Figure 7", {"iv-0.03", "iv-0.05", "iv-0.06"}, {5.2, 15.2, 30.0});
  print_figure("Figure 8", {"c1-0.025", "c1-0.05", "c1-0.1"}, {4.05, 13.3, 30.0});
  print_figure("Figure 9", {"final-test-1", "final-test-3"}, {30.0});
  const std::string series = "I_v 0.03 / 0.05 / 0.06, lengths in mm: ";
  print_strength_rates(series + "70 mm lifted at 0.06 m/s", 0.07, 0.06, {kD_r, 1e-4, 1e-3, 1e-2, 1.0},
                       {1.0, 5.2, 15.2, 30.0});
  print_strength_rates(series + "140 mm lifted at 0.06 m/s", 0.14, 0.06, {kD_r, 1e-4, 1e-3, 1e-2, 1.0},
                       {1.0, 5.2, 15.2, 30.0});
  print_strength_rates(series + "140 mm lifted at 0.01 m/s", 0.14, 0.01, {kD_r, 1e-3, 1e-2, 1.0},
                       {5.2, 15.2, 30.0});
  print_overconsolidation({0.5, 1.0, 4.05, 13.3, 30.0});
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "seed_programme: {}\n", error.what());
  return 3;
}
