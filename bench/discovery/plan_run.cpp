// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/plan_run.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "bench/discovery/rate.hpp"

namespace isotach::bench {

void add_options(CLI::App& line, PlanRun& run) {
  line.add_option("folder", run.folder, "Where the journal and the results are kept")->required();
  line.add_option("--seed", run.seed, "Seed of all studies")->capture_default_str();
  line.add_option("--studies", run.studies, "Only the first so many of the plan");
  line.add_option("--numbers", run.numbers, "Only these of the plan");
  line.add_option("--minutes", run.minutes, "Begin no study after so long");
  line.add_option("--threads", run.threads, "Studies at once")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
}

void print(const Record& record) {
  fmt::print("{} {} {}, {} of noise, {:g} sigma: {} {:.1f} s {}\n", record.number, record.kind,
             fmt::join(record.hidden, " + "), record.noise, record.wanted, outcome_of(record), record.seconds,
             record.why);
  std::fflush(stdout);
}

void write_page(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = file.string() + ".part";
  std::ofstream stream(temporary);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error("cannot write " + file.string());
  stream.close();
  std::filesystem::rename(temporary, file);
}

}  // namespace isotach::bench
