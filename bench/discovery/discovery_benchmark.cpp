// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How often discovery is right, on studies in which the effect is hidden: discovery_benchmark FOLDER.
// docs/discovery-benchmark.md says what is done and what was found.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "bench/discovery/rates.hpp"
#include "bench/discovery/run_case.hpp"
#include "calibration/parallel.hpp"

namespace {

using namespace isotach;

constexpr std::uint64_t kReported = 6;  // 1 to 5 and 1000 have been tuned on

void write(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = file.string() + ".part";
  std::ofstream stream(temporary);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error("cannot write " + file.string());
  stream.close();
  std::filesystem::rename(temporary, file);
}

void report(const std::filesystem::path& folder, const std::vector<bench::Record>& records,
            std::size_t planned, std::uint64_t seed) {
  write(folder / "results.md", bench::results_page(records, planned, seed));
  write(folder / "outcomes.csv", bench::outcomes_csv(records));
  write(folder / "rates.csv", bench::rates_csv(bench::rates_of(records)));
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  std::uint64_t seed = kReported;
  std::size_t studies = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> numbers;
  double minutes = std::numeric_limits<double>::infinity();
  int threads = 1;
  CLI::App line(
      "Makes studies with hidden effects, gives them to discovery and counts how often it is right");
  line.add_option("folder", folder, "Where the journal and the results are kept")->required();
  line.add_option("--seed", seed, "Seed of all studies")->capture_default_str();
  line.add_option("--studies", studies, "Only the first so many of the plan");
  line.add_option("--numbers", numbers, "Only these of the plan");
  line.add_option("--minutes", minutes, "Begin no study after so long");
  line.add_option("--threads", threads, "Studies at once")->capture_default_str()->check(CLI::PositiveNumber);
  CLI11_PARSE(line, argc, argv);
  try {
    std::filesystem::create_directories(folder);
    bench::Journal journal(std::filesystem::path(folder) / "journal.jsonl");
    const auto plan = bench::full_plan();
    const std::set<std::size_t> only(numbers.begin(), numbers.end());
    std::vector<const bench::Case*> left;
    for (const bench::Case& one : plan) {
      if (one.number >= studies || journal.has(one.number, seed)) continue;
      if (!only.empty() && !only.contains(one.number)) continue;
      left.push_back(&one);
    }
    const auto begin = std::chrono::steady_clock::now();
    calibration::parallel_for(left.size(), threads, [&](std::size_t k) {
      const std::chrono::duration<double, std::ratio<60>> spent = std::chrono::steady_clock::now() - begin;
      if (spent.count() > minutes) return;
      const bench::Record record = bench::run_case(*left[k], seed);
      journal.add(record);
      fmt::print("{} {} {} {} % of noise, {:g} sigma: {} {:.1f} s {}\n", record.number, record.kind,
                 fmt::join(record.hidden, " + "), 100.0 * record.noise, record.wanted,
                 bench::outcome_of(record), record.seconds, record.why);
      std::fflush(stdout);
    });
    report(folder, journal.of(seed), plan.size(), seed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
