// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The entry point that libFuzzer calls with each of its inputs.
#include <cstddef>
#include <cstdint>

#include "fuzz/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isotach::fuzz::read_bytes({data, size});
  return 0;
}
