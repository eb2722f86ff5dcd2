// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A slump file: one slump test to simulate, with its material.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/text_file.hpp"
#include "effects/values.hpp"
#include "model/parameters.hpp"
#include "mpm/slump_setup.hpp"

namespace isotach::datasets {

/// What a slump file states, in SI.
struct SlumpFile {
  std::filesystem::path file;
  model::Parameters<double> material;
  mpm::SlumpSetup setup;            ///< with the effects
  effects::Values<double> effects;  ///< [effects]; those of oedometer tests do nothing here
  std::vector<std::string>
      assumptions;  ///< each physical quantity that was not given, and what stands for it
};

/// Reads a TOML file of [material] [effects] [mud] [mould] [base] [numerics] [output] (effects, base and
/// numerics optional).
/// InputError: no such file, not TOML, a key missing, unknown or out of range; see study_sections.hpp.
[[nodiscard]] SlumpFile read_slump_file(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace isotach::datasets
