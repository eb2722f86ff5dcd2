// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Regenerates docs/mpm-verification.md: every problem of mpm_problems/, in full.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "bench/mpm_problems/breathing_cylinder.hpp"
#include "bench/mpm_problems/closed_box.hpp"
#include "bench/mpm_problems/elastic_bar.hpp"
#include "bench/mpm_problems/manufactured_cylinder.hpp"
#include "bench/mpm_problems/mud_a_outlines.hpp"
#include "bench/mpm_problems/section.hpp"
#include "bench/mpm_problems/self_weight_column.hpp"
#include "bench/mpm_problems/undrained_column.hpp"
#include "bench/mpm_problems/vhp_slump.hpp"
#include "bench/mpm_problems/yield_stress_flow.hpp"
#include "calibration/parallel.hpp"

namespace {

using isotach::bench::Section;

Section mud_a() {
  return isotach::bench::mud_a_section(ISOTACH_SOURCE_DIR "/datasets/mud-a/study.toml");
}

/// The problems in the order of the report.
const std::vector<std::function<Section()>>& problems() {
  static const std::vector<std::function<Section()>> all{isotach::bench::elastic_bar_section,
                                                         isotach::bench::self_weight_column_section,
                                                         isotach::bench::breathing_cylinder_section,
                                                         isotach::bench::manufactured_cylinder_section,
                                                         isotach::bench::undrained_section,
                                                         isotach::bench::locking_section,
                                                         isotach::bench::slump_section,
                                                         isotach::bench::spread_section,
                                                         isotach::bench::vhp_slump_section,
                                                         mud_a};
  return all;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: mpm_verification FILE.md\n");
    return 2;
  }
  const std::size_t count = problems().size();
  std::vector<std::string> sections(count);
  std::vector<std::exception_ptr> failures(count);
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  isotach::calibration::parallel_for(count, threads, [&](std::size_t k) {
    const std::size_t problem = count - 1 - k;  // the longest are the last
    try {
      const Section section = problems()[problem]();
      std::printf("%s\n", section.title.c_str());
      std::fflush(stdout);
      sections[problem] = markdown(section);
    } catch (...) {
      failures[problem] = std::current_exception();
    }
  });
  std::string report = "# Verification of the MPM engine\n\nWritten by `mpm_verification` (bench).\n\n";
  for (std::size_t k = 0; k < count; ++k) {
    if (failures[k]) std::rethrow_exception(failures[k]);
    report += sections[k];
  }
  std::ofstream file(argv[1]);
  file << report;
  return file.good() ? 0 : 1;
} catch (const std::exception& error) {  // a run that broke off; nothing is written
  std::fprintf(stderr, "mpm_verification: %s\n", error.what());
  return 3;
}
