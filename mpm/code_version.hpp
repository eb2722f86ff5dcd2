// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Which code made a result.
#pragma once

#include <string>

namespace isotach::mpm {

/// Goes up with every change of the law, its integration or the engine that moves a result in its last digit.
/// Results kept by another number are not taken for this one's.
inline constexpr int kEngineVersion = 5;

/// All of the code that a result depends on, to the last digit: Isotach's version, the engine's, the compiler
/// and the width of its vector registers.
[[nodiscard]] std::string code_version();

}  // namespace isotach::mpm
