// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Hands arbitrary bytes to the readers of user files, in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isotach::fuzz {

/// Reads `bytes` with the reader that the first byte chooses (modulo kReaders, so that the digits 0 to 5 do):
/// 0 an oedometer table, 1 a stress-controlled one, 2 outlines, 3 a study with its data, 4 columns of the
/// BRO, 5 AGS4 groups. In a study the data begin behind the first line that is "----"; they are all its
/// tests'.
///
/// Returns whether the text was accepted. An InputError means it was not; any other exception, and whatever
/// a sanitizer sees, is a defect. So is a record that was accepted and breaks what its header promises, for
/// which std::logic_error is thrown.
bool read_bytes(std::span<const std::uint8_t> bytes);

inline constexpr unsigned kReaders = 6;

}  // namespace isotach::fuzz
