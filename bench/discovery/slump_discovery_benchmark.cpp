// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// How often discovery in slumps is right, on studies in which the effect is hidden:
// slump_discovery_benchmark FOLDER. docs/discovery-benchmark.md says what is done and what was found.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>

#include "bench/discovery/caught.hpp"
#include "bench/discovery/plan.hpp"
#include "bench/discovery/plan_run.hpp"
#include "bench/discovery/rates.hpp"
#include "bench/discovery/record.hpp"
#include "bench/discovery/slump_study.hpp"
#include "bench/discovery/wilson.hpp"

namespace {

using namespace isotach;
using bench::Record;

constexpr std::uint64_t kReported = 11;  // 1, 6, 7, 8 and 9 have been tuned on

std::vector<std::string> names_of(const discovery::SlumpTrial& trial) {
  std::vector<std::string> names;
  for (const effects::Effect* effect : trial.candidate.added) names.emplace_back(effect->name);
  std::sort(names.begin(), names.end());
  return names;
}

void note_answer(const discovery::SlumpDiscovery& found, Record& record) {
  record.verdict = name_of(found.verdict);
  record.p_value = found.p_value;
  record.gap_before = found.base.gap.fitted;
  record.held_out_before = found.base.gap.held_out;
  if (!found.trials.empty()) record.first = names_of(found.trials.front());
  for (const std::size_t k : found.equivalent) record.equivalent.push_back(names_of(found.trials[k]));
  for (const discovery::Condition& condition : found.conditions) {
    if (!condition.holds) record.refused.push_back(condition.text);
  }
  if (!found.chosen) return;
  const discovery::SlumpTrial& named = found.trials[*found.chosen];
  record.named = names_of(named);
  record.gap_after = named.gap.fitted;
  record.held_out_after = named.gap.held_out;
  if (record.named == record.hidden) {
    const effects::ParameterRef amplitude{named.candidate.added.front(), 0};
    record.amplitude = named.candidate.effects[amplitude];
  }
}

Record run_case(const bench::SlumpCase& one, std::uint64_t seed) {
  Record record;
  record.number = one.number;
  record.seed = seed;
  record.kind = one.effect == nullptr ? "null" : "effect";
  if (one.effect != nullptr) record.hidden.emplace_back(one.effect->name);
  record.programme = "slump";
  record.noise = one.noise;
  record.wanted = one.visibility;
  const double none = std::numeric_limits<double>::quiet_NaN();
  record.gap_after = record.held_out_after = record.amplitude = record.lower = record.upper = none;
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
    note_answer(*found, record);
  } else {
    record.why = found.error().message;
  }
  return record;
}

/// "| what | asked | 75 % (60 to 86) | 30 of 40 |"
std::string rate_row(const std::string& what, const std::string& asked, std::size_t hits, std::size_t count) {
  if (count == 0) return fmt::format("| {} | {} | none counted | |\n", what, asked);
  const bench::Interval interval = bench::wilson(hits, count);
  return fmt::format("| {} | {} | {:.0f} % ({:.0f} to {:.0f}) | {} of {} |\n", what, asked,
                     100.0 * static_cast<double>(hits) / static_cast<double>(count), 100.0 * interval.lower,
                     100.0 * interval.upper, hits, count);
}

std::string page(const std::vector<Record>& records, std::size_t planned) {
  std::string text = fmt::format(
      "# Discovery in slumps: results\n\nWritten by `slump_discovery_benchmark`; ../discovery-benchmark.md "
      "says what it does. Of {} studies planned {} were made.\n\n| what | asked | found (95 % interval) | "
      "counted |\n|---|---|---|---|\n",
      planned, records.size());
  const auto done = [](const Record& r) { return r.state == "done"; };
  const auto holds_truth = [](const Record& r) {
    return std::find(r.equivalent.begin(), r.equivalent.end(), r.hidden) != r.equivalent.end();
  };
  const auto share = [&](const std::string& what, const std::string& asked, auto&& counts, auto&& hit) {
    std::size_t count = 0;
    std::size_t hits = 0;
    for (const Record& r : records) {
      if (!done(r) || !counts(r)) continue;
      ++count;
      hits += hit(r) ? 1U : 0U;
    }
    text += rate_row(what, asked, hits, count);
  };
  const auto null = [](const Record& r) { return r.kind == "null"; };
  const auto effect = [](const Record& r) { return r.kind == "effect"; };
  const auto right = [](const Record& r) { return r.named == r.hidden; };
  share("nulls given a name", "at most 1 %", null, [](const Record& r) { return !r.named.empty(); });
  share("wrong name", "at most 2 %", effect, [&](const Record& r) { return !r.named.empty() && !right(r); });
  share("right name", "75 %", effect, right);
  share("right name or an ambiguous set that holds it", "90 %", effect,
        [&](const Record& r) { return right(r) || holds_truth(r); });
  share(
      "right name, signal to noise 10 and 30", "",
      [&](const Record& r) { return effect(r) && r.wanted >= 10.0; }, right);
  for (const double visibility : bench::kVisibilities) {
    share(
        fmt::format("right name, signal to noise {:g}", visibility), "",
        [&](const Record& r) { return effect(r) && r.wanted == visibility; }, right);
  }
  text +=
      "\n| hidden | signal to noise | noise (mm) | outcome | gap | held out | amplitude (SI), true | named | "
      "s |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Record& r : records) {
    const std::string outcome = bench::outcome_of(r);
    text += fmt::format("| {} | {:g} | {:g} | {}{} | {:.2f} | {:.2f} | {} | {} | {:.0f} |\n",
                        r.hidden.empty() ? "nothing" : r.hidden.front(), r.wanted, 1e3 * r.noise, outcome,
                        outcome == "ambiguous" && holds_truth(r) ? ", holds it" : "", r.gap_before,
                        r.held_out_before,
                        r.true_amplitudes.empty() ? "" : fmt::format("{:.3g}", r.true_amplitudes.front()),
                        std::isfinite(r.amplitude) ? fmt::format("{:.3g}", r.amplitude) : "", r.seconds);
  }
  return text;
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
    bench::write_page(folder / "slump-results.md", page(journal.of(run.seed), plan.size()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
