// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/base64.hpp"

#include <cstddef>
#include <cstdint>

namespace isotach::reports {

std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      triple = (triple << 8U) | (i + k < bytes.size() ? std::uint32_t{bytes[i + k]} : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padding = i + k > bytes.size();
      text += padding ? '=' : kDigits[(triple >> (18U - 6U * static_cast<unsigned>(k))) & 63U];
    }
  }
  return text;
}

}  // namespace isotach::reports
