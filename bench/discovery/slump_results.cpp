// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/slump_results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/discovery/plan.hpp"
#include "bench/discovery/results_table.hpp"

namespace isotach::bench {

namespace {

constexpr double kLongest = 600.0;  // s that a study may take, on two cores

bool is_null(const Record& record) {
  return record.kind == "null";
}
bool is_effect(const Record& record) {
  return record.kind == "effect";
}

std::vector<std::string> line_of(const Record& r) {
  const std::string outcome = outcome_of(r);
  const auto when = [&](bool there, double value) {
    return there && std::isfinite(value) ? fmt::format("{:.3g}", value) : std::string();
  };
  return {joined(r.hidden),
          is_null(r) ? "" : fmt::format("{:g}", r.wanted),
          fmt::format("{:g}", 1e3 * r.noise),
          outcome == "ambiguous" && set_holds_hidden(r) ? "ambiguous, holds it" : outcome,
          when(is_done(r), r.gap_before),
          when(is_done(r), r.held_out_before),
          when(is_done(r), r.held_out_after),
          r.true_amplitudes.empty() ? "" : fmt::format("{:.3g}", r.true_amplitudes.front()),
          when(true, r.amplitude),
          r.place ? (*r.place ? "yes" : "no") : "",
          is_done(r) ? fmt::format("{:.0f}", r.seconds) : ""};
}

}  // namespace

std::vector<Rate> slump_rates_of(const std::vector<Record>& records) {
  const auto plain = [](const Record& r) { return is_effect(r) && r.wanted >= 10.0; };
  std::vector<Rate> rates{
      share(records, "nulls given a name", {.most = 1.0}, is_null, is_named),
      share(records, "nulls rejected", {}, is_null, [](const Record& r) { return r.verdict != "adequate"; }),
      share(records, "wrong name", {.most = 2.0}, is_effect, is_wrong),
      share(records, "right name", {.least = 75.0}, is_effect, is_right),
      share(records, "right name, or an ambiguous set that holds it", {.least = 90.0}, is_effect,
            [](const Record& r) { return is_right(r) || set_holds_hidden(r); }),
      share(records, "right name, signal to noise 10 and 30", {}, plain, is_right)};
  for (const double visibility : kVisibilities) {
    rates.push_back(share(
        records, fmt::format("right name, signal to noise {:g}", visibility), {},
        [&](const Record& r) { return is_effect(r) && r.wanted == visibility; }, is_right));
  }
  rates.push_back(amplitude_error(
      records, "error of the named amplitude, signal to noise 10 and more, median", {.most = 15.0}, plain));
  rates.push_back(share(
      records, "zone ranked first, where the base is rejected", {.least = 85.0},
      [](const Record& r) { return r.place && r.verdict != "adequate"; },
      [](const Record& r) { return *r.place; }));
  rates.push_back(share(
      records, "within 10 minutes", {.least = 100.0}, [](const Record&) { return true; },
      [](const Record& r) { return r.seconds <= kLongest; }));
  return rates;
}

std::string slump_results_page(const std::vector<Record>& records, std::size_t planned, std::uint64_t seed) {
  std::string page = fmt::format(
      "# Discovery in slumps: results\n\nWritten by `slump_discovery_benchmark`; ../discovery-benchmark.md "
      "says what it does. Seed {}. Of {} studies planned {} were made.\n\n",
      seed, planned, records.size());
  add_rates(page, slump_rates_of(records), records.size(), planned);
  add_confusion(page, records, "Hidden and found", [](const Record&) { return true; });
  std::vector<std::vector<std::string>> rows;
  for (const Record& r : records) rows.push_back(line_of(r));
  page += "### Every study\n\n";
  add_table(page,
            {"hidden", "signal to noise", "noise (mm)", "outcome", "gap", "held out",
             "so, with what is named", "amplitude (SI), true", "named", "zone right", "s"},
            rows);
  page.pop_back();
  return page;
}

}  // namespace isotach::bench
