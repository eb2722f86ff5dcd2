// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The initial void ratio of a specimen from what is known of its masses, densities and water.
#pragma once

#include <optional>
#include <string>

#include "datasets/specimen.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {

/// Density of water (kg/m3), to which specific gravities refer.
inline constexpr double kWaterDensity = 1000.0;

/// Degrees of saturation (-) of an ordinary specimen below the water table; others are remarked upon.
inline constexpr Range kOrdinarySaturation{0.9, 1.05};

/// Grains of a kind that specific gravities are assumed for.
enum class Soil { mineral, peat };

/// What the study states of a specimen's void ratio. SI.
struct VoidRatioKeys {
  std::optional<double> void_ratio;        ///< (-)
  std::optional<double> water_content;     ///< (-)
  std::optional<double> bulk_density;      ///< kg/m3
  std::optional<double> dry_mass;          ///< kg
  std::optional<double> specific_gravity;  ///< (-)
  std::optional<Soil> soil;
};

/// Reads void_ratio, water_content, bulk_density_g_per_cm3, dry_mass_g, specific_gravity, soil.
/// InputError: out of range, or more than one of void_ratio, water_content and dry_mass_g.
[[nodiscard]] VoidRatioKeys read_void_ratio_keys(TomlTable& test);

/// e0 (-), how it was obtained, and de0/dG_s where a specific gravity went into it.
struct VoidRatio {
  double value;
  std::string source;
  std::optional<double> per_specific_gravity;
};

/// The initial void ratio, from the study's keys; where these hold none of void_ratio, water_content and
/// dry_mass_g, from the file's own data:
///
///   given;
///   (1 + w) G_s rho_w/rho - 1        with a bulk density, the degree of saturation then being w G_s/e0;
///   w G_s                            without, saturated;
///   G_s rho_w V/m_d - 1              from the dry mass m_d in the volume V of the specimen.
///
/// A specific gravity that is not known is assumed by the kind of soil and named; not silently where the
/// water content is above 1.5, as of an organic soil.
/// `test` is the [[oedometer]] table, for messages. InputError: nothing to work from, no diameter or height
/// for a volume, a void ratio that cannot be.
[[nodiscard]] VoidRatio work_out_void_ratio(const TomlTable& test, const VoidRatioKeys& keys,
                                            const SpecimenData& specimen, Assumptions& assumptions);

}  // namespace isotach::datasets
