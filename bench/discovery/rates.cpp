// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "bench/discovery/results_table.hpp"

namespace isotach::bench {

namespace {

constexpr double kLeastBefore = 2.0;  // gap on held-out tests from which its closing is judged
constexpr double kLeastBeside = 5.0;  // sigma from which a deleted effect counts

/// Share of the held-out gap's square, beyond the noise, that the named effect takes away; below any where
/// the test held out can no longer be predicted with it.
double closed(const Record& r) {
  if (!std::isfinite(r.held_out_after)) return -std::numeric_limits<double>::infinity();
  return (r.held_out_before * r.held_out_before - r.held_out_after * r.held_out_after) /
         (r.held_out_before * r.held_out_before - 1.0);
}

void add_cells(std::string& page, const std::vector<Record>& records) {
  struct Count {
    int right = 0, wrong = 0, all = 0;
  };
  std::map<std::tuple<std::string, double, double>, Count> cells;
  for (const Record& r : records) {
    if (!is_done(r) || r.kind != "effect") continue;
    Count& cell = cells[{r.programme, r.wanted, r.noise}];
    ++cell.all;
    if (is_right(r)) ++cell.right;
    if (is_wrong(r)) ++cell.wrong;
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& [key, cell] : cells) {
    const auto& [programme, visibility, noise] = key;
    rows.push_back({programme, fmt::format("{:g}", visibility), fmt::format("{:g} %", 100.0 * noise),
                    std::to_string(cell.all), std::to_string(cell.right), std::to_string(cell.wrong)});
  }
  page += "## Names by cell, effects of the catalogue\n\n";
  add_table(page, {"protocol", "signal to noise", "noise", "studies", "right name", "wrong name"}, rows);
}

void add_refusals(std::string& page, const std::vector<Record>& records) {
  std::map<std::string, int> why;
  for (const Record& r : records) {
    if (!is_done(r) || r.kind != "effect" || r.first != r.hidden || is_named(r)) continue;
    std::string words = "verdict " + r.verdict;
    for (const std::string& condition : r.refused) {
      const std::string first = condition.starts_with("with ") ? "not all is met, or more is called for"
                                                               : condition.substr(0, condition.find(" ("));
      words += "; not: " + (first.starts_with("its BIC") ? std::string("BIC leads by enough") : first);
    }
    ++why[words];
  }
  if (why.empty()) return;
  page += "## Where the hidden effect fitted best and was not named\n\n";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [words, number] : why) rows.push_back({words, std::to_string(number)});
  add_table(page, {"what was said instead", "studies"}, rows);
}

}  // namespace

std::vector<Rate> rates_of(const std::vector<Record>& records) {
  const auto kind = [](const char* name) { return [name](const Record& r) { return r.kind == name; }; };
  const auto rich = [](const char* name, double visibility) {
    return [name, visibility](const Record& r) {
      return r.kind == name && r.programme == "rich" && (visibility == 0.0 || r.wanted == visibility);
    };
  };
  const RecordTest unknown = [](const Record& r) { return r.verdict == "unknown"; };
  const auto judged = [](const Record& r) {
    return is_done(r) && is_named(r) && r.kind != "null" && r.held_out_before >= kLeastBefore;
  };
  const auto measured = [](const Record& r) {
    return r.kind == "effect" && is_right(r) && r.wanted >= 10.0 && std::isfinite(r.amplitude);
  };
  std::vector<double> shares;
  for (const Record& r : records) {
    if (judged(r)) shares.push_back(closed(r));
  }
  std::vector<Rate> rates{
      share(records, "nulls given a name", {.most = 1.0}, kind("null"), is_named),
      share(records, "wrong name, effect in catalogue", {.most = 2.0}, kind("effect"), is_wrong),
      share(records, "right name, rich protocol, signal to noise 30", {.least = 95.0}, rich("effect", 30.0),
            is_right),
      share(records, "right name, rich protocol, signal to noise 10", {.least = 75.0}, rich("effect", 10.0),
            is_right),
      share(records, "outside the catalogue called unknown, rich protocol", {.least = 85.0},
            rich("outside", 0.0), unknown),
      share(records, "so, given a name", {}, rich("outside", 0.0), is_named),
      share(
          records, "so, called unknown where 5 sigma are left beside the best effect", {},
          [&](const Record& r) { return rich("outside", 0.0)(r) && r.beside >= kLeastBeside; }, unknown),
      share(
          records, "hidden effect deleted, called unknown, rich protocol, 5 sigma left", {.least = 75.0},
          [&](const Record& r) { return rich("deleted", 0.0)(r) && r.beside >= kLeastBeside; }, unknown),
      share(
          records, "so, given a name", {},
          [&](const Record& r) { return rich("deleted", 0.0)(r) && r.beside >= kLeastBeside; }, is_named),
      median(shares, "held-out gap closed when named, median", {.least = 90.0}),
      share(records, "held-out gap grown when named", {.most = 5.0}, judged,
            [](const Record& r) { return closed(r) < 0.0; }),
      amplitude_error(records, "error of the named amplitude, signal to noise 10 and more, median",
                      {.most = 15.0}, measured),
      share(records, "its 90 % interval covers the truth", {.least = 84.0, .most = 96.0}, measured,
            [](const Record& r) {
              return r.lower <= r.true_amplitudes.front() && r.true_amplitudes.front() <= r.upper;
            }),
      share(
          records, "place ranked first, where the base is rejected", {.least = 85.0},
          [](const Record& r) { return r.place && r.kind != "null" && r.verdict != "adequate"; },
          [](const Record& r) { return *r.place; }),
      share(records, "two effects at once: both named", {}, kind("pair"), is_right),
      share(records, "two effects at once: named otherwise", {}, kind("pair"), is_wrong),
      share(
          records, "within 30 s on one thread", {.least = 100.0}, [](const Record&) { return true; },
          [](const Record& r) { return r.seconds <= 30.0; }),
  };
  return rates;
}

std::string outcomes_csv(const std::vector<Record>& records) {
  std::map<std::tuple<std::string, std::string, std::string, double, double, std::string>, int> counts;
  for (const Record& r : records) {
    ++counts[{r.kind, joined(r.hidden), r.programme, r.noise, r.wanted, outcome_of(r)}];
  }
  std::string csv = "kind,hidden,protocol,noise,signal_to_noise,outcome,count\n";
  for (const auto& [key, number] : counts) {
    const auto& [kind, hidden, programme, noise, wanted, outcome] = key;
    csv += fmt::format("{},{},{},{:g},{:g},{},{}\n", kind, hidden, programme, noise, wanted, outcome, number);
  }
  return csv;
}

std::string results_page(const std::vector<Record>& records, std::size_t planned, std::uint64_t seed) {
  const auto in_state = [&](const char* state) {
    return std::count_if(records.begin(), records.end(), [&](const Record& r) { return r.state == state; });
  };
  std::string page = fmt::format(
      "# Discovery benchmark: results\n\nWritten by `discovery_benchmark`; ../discovery-benchmark.md says "
      "what "
      "it does. Seed {}. Of {} studies planned {} were made: {} done, {} out of reach (no admissible "
      "amplitude shows as plainly as asked), {} failed.\n\n",
      seed, planned, records.size(), in_state("done"), in_state("out of reach"), in_state("failed"));
  page += "## Rates\n\n";
  add_rates(page, rates_of(records), records.size(), planned);
  add_cells(page, records);
  page += "## Confusion matrices\n\n";
  for (const auto& [kind, words] : {std::pair{"null", "Nothing hidden"},
                                    {"effect", "Effects of the catalogue"},
                                    {"outside", "Outside the catalogue"},
                                    {"deleted", "Deleted from the catalogue"},
                                    {"pair", "Two at once"}}) {
    for (const char* programme : {"rich", "poor"}) {
      add_confusion(page, records, fmt::format("{}, {} protocol", words, programme),
                    [k = std::string(kind), p = std::string(programme)](const Record& r) {
                      return r.kind == k && r.programme == p;
                    });
    }
  }
  add_refusals(page, records);
  while (page.ends_with("\n\n")) page.pop_back();
  return page;
}

}  // namespace isotach::bench
