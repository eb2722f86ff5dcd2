// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How often discovery in slumps is right, on studies in which the effect is hidden:
// slump_discovery_benchmark FOLDER. docs/discovery-benchmark.md says what is done and what was found.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <filesystem>

#include "bench/discovery/caught.hpp"
#include "bench/discovery/note_answer.hpp"
#include "bench/discovery/plan_run.hpp"
#include "bench/discovery/rate.hpp"
#include "bench/discovery/slump_results.hpp"
#include "bench/discovery/slump_study.hpp"

namespace {

using namespace isotach;
using bench::Record;

constexpr std::uint64_t kReported = 12;  // 1, 6, 7, 8 and 9 have been tuned on, 11 has been looked at

Record run_case(const bench::SlumpCase& one, std::uint64_t seed) {
  Record record = bench::blank_record(one.number, seed);
  record.kind = one.effect == nullptr ? "null" : "effect";
  if (one.effect != nullptr) record.hidden.emplace_back(one.effect->name);
  record.programme = "slump";
  record.noise = one.noise;
  record.wanted = one.visibility;
  const auto made = bench::make_slump_study(one, seed);
  if (!made) {
    record.state = "failed";
    record.why = "making: " + made.error();
    return record;
  }
  record.visibility = made->visibility;
  if (one.effect != nullptr) record.true_amplitudes.push_back(made->amplitude);
  if (!made->reached) {
    record.state = "out of reach";
    return record;
  }
  discovery::SlumpDiscoverOptions options;
  options.knowledge = made->knowledge;
  const auto begin = std::chrono::steady_clock::now();
  const auto found = bench::caught([&] { return discovery::discover_slump(made->study, options); });
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  record.state = found ? "done" : "failed";
  if (found) {
    bench::note_answer(*found, record);
    if (made->part) record.place = bench::first_part(found->disagreement) == made->part;
    if (found->chosen && is_right(record)) {
      const discovery::SlumpCandidate& named = found->trials[*found->chosen].candidate;
      record.amplitude = named.effects[effects::ParameterRef{named.added.front(), 0}];
    }
  } else {
    record.why = found.error().message;
  }
  return record;
}

}  // namespace

int main(int argc, char** argv) {
  bench::PlanRun run;
  run.seed = kReported;
  CLI::App line("Makes slump studies with hidden effects and counts how often discovery is right");
  bench::add_options(line, run);
  CLI11_PARSE(line, argc, argv);
  try {
    const std::filesystem::path folder = run.folder;
    std::filesystem::create_directories(folder);
    bench::Journal journal(folder / "slump-journal.jsonl");
    const auto plan = bench::slump_plan();
    bench::run_plan(plan, run, journal, run_case);
    bench::write_page(folder / "slump-results.md",
                      bench::slump_results_page(journal.of(run.seed), plan.size(), run.seed));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
