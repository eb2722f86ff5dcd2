// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A decoder of what reports encode, of its own.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace isotach::reports {

inline std::vector<unsigned char> from_base64(const std::string& text) {
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    std::uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      digit = static_cast<std::uint32_t>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint32_t>(c - '0') + 52;
    } else if (c == '+' || c == '/') {
      digit = c == '+' ? 62 : 63;
    } else {
      EXPECT_EQ(c, '=');
      break;
    }
    bits = (bits << 6U) | digit;
    if (++count % 4 != 1)
      bytes.push_back(static_cast<unsigned char>(bits >> (6U - 2U * static_cast<unsigned>((count - 1) % 4))));
  }
  return bytes;
}

}  // namespace isotach::reports
