// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An element test file: a material, the state a material point starts from, and the stages it is led through.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/text_file.hpp"
#include "integrators/element_test.hpp"
#include "model/parameters.hpp"

namespace isotach::datasets {

/// What an element test file states, in SI and tension positive.
struct ElementFile {
  std::filesystem::path file;
  std::optional<std::string> note;  ///< what the file says of itself
  model::Parameters<double> material;
  model::State<double> start;
  std::vector<integrators::Stage> stages;  ///< repeated ones written out
};

/// Reads a TOML file of `note` (optional), [material], [state] and [[stage]]; docs/files.md has every key.
///
/// [state] has stress_kPa (11, 22, 33, 12, 13, 23), compression positive; void_ratio or ocr, from which e
/// follows by p_B = OCR p_B+; and optionally omega, six tensor components with the sign of sigma*/p where
/// sigma is compression positive (Omega = C_3 sigma*/p is the steady one), that is the negative of the law's,
/// which is compared with T*/p. Likewise every stress and strain component, shear too, is the negative of the
/// tension-positive one; the spin is that of the motion, W_ij = (dv_i/dx_j - dv_j/dx_i)/2.
///
/// InputError: no such file, not TOML, a key missing, unknown or out of range, a component named twice, a
/// state outside of the law's domain.
[[nodiscard]] ElementFile read_element_file(const std::filesystem::path& file,
                                            const ReadOptions& options = {});

}  // namespace isotach::datasets
