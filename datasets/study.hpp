// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A study: a material to start from, what to fit, and the tests with their data read and reduced.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/oedometer.hpp"
#include "datasets/outline.hpp"
#include "datasets/text_file.hpp"
#include "model/parameters.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::datasets {

/// What makes e100 and D_r two numbers: data alone hold only one combination of them.
enum class Gauge {
  crs_rate,  ///< D_r is |D_vis| of steady oedometric compression at the reference rate
  fixed,     ///< D_r stays at its start value
  none       ///< both move freely; the fit reports the null direction
};

/// Where a fit may look for one parameter. SI (phi_c in rad), lower < upper, both admissible by themselves.
struct Bounds {
  double lower;
  double upper;
};

/// [fit]
struct FitSettings {
  std::vector<model::ParameterId> oedometer{model::ParameterId::e100, model::ParameterId::lambda,
                                            model::ParameterId::kappa, model::ParameterId::D_r};
  std::vector<model::ParameterId> slump{model::ParameterId::I_v, model::ParameterId::C_1};
  Gauge gauge = Gauge::crs_rate;
  std::optional<double>
      reference_rate;  ///< axial strain rate (1/s); default: of the first loading stage fitted
  std::array<std::optional<Bounds>, model::kParameterCount> bounds;  ///< in the order of ParameterId
};

/// Standard deviations of an oedometer test's readings; the defaults are those of an ordinary apparatus.
struct OedometerNoise {
  double stress_relative = 0.01;  ///< of the stress (-), adds in square to the floor
  double stress_floor = 100.0;    ///< Pa
  double strain = 1e-4;           ///< (-)
};

/// [[oedometer]], SI.
struct OedometerTest {
  std::string name;
  OedometerRecord record;
  double height;                   ///< H0 (m)
  std::optional<double> diameter;  ///< m
  double void_ratio;               ///< e0 (-) at time 0
  std::string void_ratio_source;   ///< how e0 was obtained, in words
  double initial_K0;               ///< radial over axial effective stress at the start (-)
  std::optional<double>
      initial_axial_stress;  ///< Pa, at time 0 and strain 0; absent: the first row is the start
  OedometerNoise noise;
  bool hold_out;  ///< not fitted, only predicted
};

/// Standard deviations of an outline's points (m).
struct SlumpNoise {
  double outline = 1e-3;
  double lifting = 2.5e-3;  ///< while the rim is below the top of the mud
};

/// [[slump]], SI. The times of `setup` are those of `outlines`.
struct SlumpTest {
  std::string name;
  std::filesystem::path data;
  std::vector<Outline> outlines;
  mpm::SlumpSetup setup;
  SlumpNoise noise;
  bool hold_out;  ///< not fitted, only predicted
};

/// A whole study.
struct Study {
  std::filesystem::path file;
  std::string note{};  ///< what a reader must know of the data, in the author's words; reports show it
  model::Parameters<double> material;
  FitSettings fit;
  std::vector<OedometerTest> oedometer_tests;
  std::vector<SlumpTest> slump_tests;
  std::vector<std::string>
      assumptions;  ///< each physical quantity that was not given, and what stands for it
};

/// Reads a study and the data files it names, relative to its own folder. At least one test, no name twice.
/// InputError: no such file, not TOML, a key missing, unknown or out of range, and whatever the readers of
/// the data refuse.
[[nodiscard]] Study read_study(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace isotach::datasets
