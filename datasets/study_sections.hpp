// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The sections that studies and slump files share: material, mould, mud, base, numerics.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "datasets/toml_table.hpp"
#include "model/parameters.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::datasets {

/// Collects what a reader took for granted about one subject ("slump test slump-1").
class Assumptions {
 public:
  Assumptions(std::string subject, std::vector<std::string>& texts)
      : subject_(std::move(subject)), texts_(&texts) {}
  void add(std::string_view text) { texts_->push_back(subject_ + ": " + std::string(text)); }

 private:
  std::string subject_;
  std::vector<std::string>* texts_;  // owned by the caller
};

/// [material]: all parameters of model::kParameterTable by their keys (C_2, C_3 optional, 0), lode_dependence
/// ("matsuoka-nakai" or "none", optional).
[[nodiscard]] model::Parameters<double> read_material(TomlTable material);

/// The key name of a test, which must not occur twice (`names`): results are listed and files are named by
/// it.
[[nodiscard]] std::string read_test_name(TomlTable& test, std::set<std::string>& names);

/// diameter_mm, fill_height_mm, lift_speed_m_per_s; wall = "smooth" (assumed where absent) or "rough".
[[nodiscard]] mpm::Mould read_mould(TomlTable mould, Assumptions& assumptions);

/// void_ratio, or undrained_strength_kPa with an optional strength_rate_per_s; specific_gravity and ocr,
/// which are assumed where absent.
[[nodiscard]] mpm::Mud read_mud(TomlTable mud, Assumptions& assumptions);

/// kind = "rough" (assumed where absent), "limited" with shear_limit_kPa and friction, "navier" with
/// slip_length_mm, or "elastic" with thickness_mm, length_mm, youngs_modulus_kPa and poissons_ratio, which
/// are assumed where absent. `parent` is the table that may hold [base].
[[nodiscard]] mpm::Base read_base(TomlTable& parent, Assumptions& assumptions);

/// [numerics] of `root`, every key optional.
[[nodiscard]] mpm::Numerics read_numerics(TomlTable& root);

/// [numerics] of a study.
struct StudyNumerics {
  mpm::Numerics own;
  std::optional<mpm::Numerics> reference =
      {};  ///< [numerics.reference]: keys that it lacks are those of `own`
};
[[nodiscard]] StudyNumerics read_study_numerics(TomlTable& root);

/// InputError where an elastic base is no wider than the mould, or softer than a simulation can follow.
/// `parent` is the table that holds [base].
void check_slab(TomlTable& parent, const model::Parameters<double>& material, const mpm::SlumpSetup& setup);

/// InputError where the cells of [numerics] in `root` are larger than the mould's radius.
void check_cell_size(TomlTable& root, const mpm::SlumpSetup& setup);

/// Specific gravity of the grains (-) taken where none is given, a mineral soil's.
inline constexpr double kAssumedSpecificGravity = 2.65;
/// The same of a peat.
inline constexpr double kAssumedPeatGravity = 1.5;
/// Accepted specific gravity (-): organic soils come down to 1.4, heavy ores to 5 and more.
inline constexpr Range kSpecificGravity{1.0, 8.0, true, false};
/// Accepted void ratio (-); fluid muds reach 30.
inline constexpr Range kVoidRatio{0.0, 100.0, true, false};

}  // namespace isotach::datasets
