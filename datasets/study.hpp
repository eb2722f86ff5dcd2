// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A study: a material to start from, what to fit, and the tests with their data read and reduced.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/oedometer.hpp"
#include "datasets/outline.hpp"
#include "datasets/text_file.hpp"
#include "effects/values.hpp"
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

/// What is known of a quantity before the data are seen: a normal distribution (of its logarithm where the
/// fit moves that).
struct Prior {
  double mean;       ///< SI
  double std_error;  ///< SI, > 0
};

/// Where an oedometer fit starts.
enum class FitStart {
  data,     ///< graphical constructions on the compression curves; what they cannot give from [material]
  material  ///< [material]
};

/// A parameter of an effect that a fit moves.
struct FreeEffect {
  effects::ParameterRef parameter;
  std::optional<Bounds> bounds;  ///< SI; nothing: those of the catalogue
};

/// A quantity of the state that slump tests start from.
enum class MudQuantity { overconsolidation_ratio, void_ratio };
/// "OCR0", "e0".
[[nodiscard]] std::string_view name_of(MudQuantity quantity);

/// One that a fit moves, for all slump tests at once; they state the same value of it, where the fit starts.
struct FreeMud {
  MudQuantity quantity;
  std::optional<Bounds> bounds;     ///< nothing: widely about the value stated
  std::optional<double> std_error;  ///< of the value stated, where the study says how well it is known
};

/// How a slump fit searches on simulations.
enum class SlumpRoute {
  bobyqa,  ///< NLopt's BOBYQA (COBYLA for a single parameter)
  sbplx,   ///< NLopt's SBPLX
  ceres    ///< Ceres, its derivatives by differences of simulations on the same grid
};

/// [fit]
struct FitSettings {
  std::vector<model::ParameterId> oedometer{model::ParameterId::e100, model::ParameterId::lambda,
                                            model::ParameterId::kappa, model::ParameterId::D_r};
  std::vector<FreeEffect> oedometer_effects;  ///< of effects that are on
  std::vector<FreeEffect> slump_effects;      ///< likewise
  std::vector<FreeMud> slump_mud;             ///< each once
  std::vector<model::ParameterId> slump{model::ParameterId::I_v, model::ParameterId::C_1};
  std::vector<SlumpRoute> slump_routes{SlumpRoute::bobyqa};  ///< of fit-slump, each once, at least one
  Gauge gauge = Gauge::crs_rate;
  std::optional<double>
      reference_rate;  ///< axial strain rate (1/s); default: of the first loading stage fitted
  std::array<std::optional<Bounds>, model::kParameterCount> bounds;  ///< in the order of ParameterId
  std::array<std::optional<Prior>, model::kParameterCount> priors;   ///< in the order of ParameterId
  FitStart start = FitStart::data;
  int starts = 12;    ///< of the multi-start, the first one included; >= 1
  int bootstrap = 0;  ///< samples of the block bootstrap; 0: none
  unsigned seed = 1;  ///< of all random choices of a fit
};

/// How K0 at the start of an oedometer test is known.
enum class InitialK0 {
  given,  ///< OedometerTest::initial_K0
  jaky,   ///< 1 - sin(phi_c), likewise stored in initial_K0
  steady  ///< of steady oedometric compression, by the law at the parameters of the moment; initial_K0 is
          ///< Jaky's, as a first guess
};

/// Whether a fit moves a quantity of one test's start, and what is known of it.
struct FreeStart {
  bool moves = false;
  std::optional<double> std_error;  ///< of the prior around the value given; of ln OCR, of K0 itself
};

/// When the readings of a load step begin to be compared: once primary consolidation is over.
struct EndOfPrimary {
  enum class Rule {
    taylor,      ///< each step's own, by the square-root-of-time construction
    casagrande,  ///< each step's own, by the log-time construction
    given,       ///< `seconds` after the load
    none         ///< all readings are compared
  };
  Rule rule = Rule::taylor;
  double seconds = 0.0;
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
  /// de0/dG_s where e0 was worked out with a specific gravity; nothing where it was given.
  std::optional<double> void_ratio_per_specific_gravity;
  double initial_K0;  ///< radial over axial effective stress at the start (-)
  InitialK0 K0_rule = InitialK0::given;
  FreeStart free_K0;
  /// p_B/p_B+ at the start. Then the void ratio that the law works with follows from it, and void_ratio only
  /// turns strains into the void ratios that are drawn.
  std::optional<double> initial_ocr;
  FreeStart free_ocr;
  std::optional<double>
      initial_axial_stress;     ///< Pa, at time 0 and strain 0; absent: the first row is the start
  EndOfPrimary end_of_primary;  ///< read only where the record is stress-controlled
  OedometerNoise noise;
  bool hold_out;  ///< not fitted, only predicted
};

/// Standard deviations of an outline's points (m).
struct SlumpNoise {
  double outline = 1e-3;    ///< of a point once the rim has left the mud, everything included
  double lifting = 2.5e-3;  ///< while the rim is below the top of the mud
  double shared = 0.7e-3;   ///< the part of `outline` that neighbouring points and times share; < outline
};

/// What a test's mud states of a quantity; nothing where it follows from the strength.
[[nodiscard]] std::optional<double> stated_value(const mpm::Mud& mud, MudQuantity quantity);

/// A mud with other values of the quantities that a fit moves.
[[nodiscard]] mpm::Mud with_values(mpm::Mud mud, const std::vector<FreeMud>& free,
                                   std::span<const double> values);

/// [[slump]], SI. The times of `setup` are those of `outlines`.
struct SlumpTest {
  std::string name;
  std::filesystem::path data;
  std::vector<Outline> outlines;
  mpm::SlumpSetup setup;
  SlumpNoise noise;
  bool hold_out;  ///< not fitted, only predicted
  /// Numerics that those of `setup` stand in for, where the study has them: they judge, and what a fit
  /// simulates is corrected to them.
  std::optional<mpm::Numerics> reference = {};

  /// The setup with the best numerics there are.
  [[nodiscard]] mpm::SlumpSetup best_setup() const;
};

/// A whole study.
struct Study {
  std::filesystem::path file;
  std::string note{};  ///< what a reader must know of the data, in the author's words; reports show it
  model::Parameters<double> material;
  effects::Values<double> effects{};  ///< [effects]; a test heeds those of its own kind
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
/// The same of a text in memory; `read_data` gets the paths of the data files.
[[nodiscard]] Study parse_study(std::string text, const std::filesystem::path& file,
                                const ReadText& read_data);

}  // namespace isotach::datasets
