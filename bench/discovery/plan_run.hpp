// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the discovery benchmarks have in common: their command line, going through a plan, writing a page.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "bench/discovery/record.hpp"
#include "calibration/parallel.hpp"

namespace isotach::bench {

struct PlanRun {
  std::string folder;
  std::uint64_t seed = 0;
  std::size_t studies = std::numeric_limits<std::size_t>::max();  ///< the first so many of the plan
  std::vector<std::size_t> numbers;                               ///< only these of the plan; empty: all
  double minutes = std::numeric_limits<double>::infinity();       ///< no study is begun after so long
  int threads = 1;                                                ///< studies at once
};

/// The options of a benchmark, read into `run`, whose seed stands unless another is given.
void add_options(CLI::App& line, PlanRun& run);

/// Says on a line of standard output what a study came to.
void print(const Record& record);

/// Writes a text to a temporary name and renames it. Throws std::runtime_error where that fails.
void write_page(const std::filesystem::path& file, const std::string& text);

/// Makes those of the plan's studies that the run wants and the journal lacks: `make(one, seed)` is the
/// record of a case, which has a `number`.
template <class Case, class Make>
void run_plan(const std::vector<Case>& plan, const PlanRun& run, Journal& journal, const Make& make) {
  std::vector<const Case*> left;
  for (const Case& one : plan) {
    const bool wanted = run.numbers.empty() ||
                        std::find(run.numbers.begin(), run.numbers.end(), one.number) != run.numbers.end();
    if (wanted && one.number < run.studies && !journal.has(one.number, run.seed)) left.push_back(&one);
  }
  const auto begin = std::chrono::steady_clock::now();
  calibration::parallel_for(left.size(), run.threads, [&](std::size_t k) {
    const std::chrono::duration<double, std::ratio<60>> spent = std::chrono::steady_clock::now() - begin;
    if (spent.count() > run.minutes) return;
    const Record record = make(*left[k], run.seed);
    journal.add(record);
    print(record);
  });
}

}  // namespace isotach::bench
