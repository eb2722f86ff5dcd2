// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "mpm/code_version.hpp"

#include <fmt/format.h>

#include "mpm/packet_math.hpp"

namespace isotach::mpm {

std::string code_version() {
#ifdef __clang__
  constexpr const char* kCompiler = __VERSION__;
#else
  constexpr const char* kCompiler = "GCC " __VERSION__;
#endif
  return fmt::format("isotach {}, engine {}, {}, {} doubles a register", ISOTACH_VERSION, kEngineVersion,
                     kCompiler, kPacketSize);
}

}  // namespace isotach::mpm
