// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How often discovery is right, on studies in which the effect is hidden: discovery_benchmark FOLDER.
// docs/discovery-benchmark.md says what is done and what was found.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "bench/discovery/plan_run.hpp"
#include "bench/discovery/rates.hpp"
#include "bench/discovery/run_case.hpp"

namespace {

using namespace isotach;

constexpr std::uint64_t kReported = 12;  // 1 to 6 and 1000 have been tuned on

void report(const std::filesystem::path& folder, const std::vector<bench::Record>& records,
            std::size_t planned, std::uint64_t seed) {
  bench::write_page(folder / "results.md", bench::results_page(records, planned, seed));
  bench::write_page(folder / "outcomes.csv", bench::outcomes_csv(records));
  bench::write_page(folder / "rates.csv", bench::rates_csv(bench::rates_of(records)));
}

}  // namespace

int main(int argc, char** argv) {
  bench::PlanRun run;
  run.seed = kReported;
  CLI::App line(
      "Makes studies with hidden effects, gives them to discovery and counts how often it is right");
  bench::add_options(line, run);
  CLI11_PARSE(line, argc, argv);
  try {
    const std::filesystem::path folder = run.folder;
    std::filesystem::create_directories(folder);
    bench::Journal journal(folder / "journal.jsonl");
    const auto plan = bench::full_plan();
    bench::run_plan(plan, run, journal, bench::run_case);
    report(folder, journal.of(run.seed), plan.size(), run.seed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
