// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Regenerates docs/mpm-verification.md: every problem of mpm_problems/, in full.
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "bench/mpm_problems/section.hpp"

namespace {

using isotach::bench::Section;

/// The problems in the order of the report.
const std::vector<std::function<Section()>>& problems() {
  static const std::vector<std::function<Section()>> all{};
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: mpm_verification FILE.md\n");
    return 2;
  }
  std::string report = "# Verification of the MPM engine\n\nWritten by `mpm_verification` (bench).\n\n";
  for (const auto& problem : problems()) {
    const Section section = problem();
    std::printf("%s\n", section.title.c_str());
    std::fflush(stdout);
    report += markdown(section);
  }
  std::ofstream file(argv[1]);
  file << report;
  return file.good() ? 0 : 1;
}
