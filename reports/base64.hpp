// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Bytes as text.
#pragma once

#include <span>
#include <string>

namespace isotach::reports {

/// RFC 4648 with padding, in one line.
[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

}  // namespace isotach::reports
