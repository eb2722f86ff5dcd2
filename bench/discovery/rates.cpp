// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>

#include "bench/discovery/wilson.hpp"

namespace isotach::bench {

namespace {

using Test = std::function<bool(const Record&)>;

constexpr double kLeastBefore = 2.0;  // gap on held-out tests from which its closing is judged
constexpr double kLeastBeside = 5.0;  // sigma from which a deleted effect counts

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : " + ") + name;
  return all.empty() ? "nothing" : all;
}

bool done(const Record& r) {
  return r.state == "done";
}
bool is_named(const Record& r) {
  return !r.named.empty();
}
bool is_right(const Record& r) {
  return r.named == r.hidden;
}

/// What a share or a median is to be, in per cent.
struct Asked {
  double least = 0.0;
  double most = 100.0;

  [[nodiscard]] bool anything() const { return least > 0.0 || most < 100.0; }
  [[nodiscard]] bool met_by(double found) const { return found >= least && found <= most; }
  [[nodiscard]] std::string words() const {
    if (!anything()) return "";
    if (least == 0.0) return fmt::format("at most {:g} %", most);
    if (most == 100.0) return fmt::format("{:g} %", least);
    return fmt::format("{:g} to {:g} %", least, most);
  }
};

void find(Rate& rate, const Asked& asked, double percent) {
  rate.found = fmt::format("{:.1f} %", percent);
  if (asked.anything()) rate.met = asked.met_by(percent);
}

Rate count(const std::vector<Record>& records, std::string what, const Asked& asked, const Test& of,
           const Test& hit) {
  std::size_t all = 0;
  std::size_t hits = 0;
  for (const Record& r : records) {
    if (!done(r) || !of(r)) continue;
    ++all;
    if (hit(r)) ++hits;
  }
  Rate rate{std::move(what), asked.words(), "-", "", fmt::format("{} of {}", hits, all)};
  if (all == 0) return rate;
  const Interval interval = wilson(hits, all);
  find(rate, asked, 100.0 * static_cast<double>(hits) / static_cast<double>(all));
  rate.interval = fmt::format("{:.1f} to {:.1f} %", 100.0 * interval.lower, 100.0 * interval.upper);
  return rate;
}

Rate median(std::vector<double> values, std::string what, const Asked& asked) {
  Rate rate{std::move(what), asked.words(), "-", "", fmt::format("{} studies", values.size())};
  if (values.empty()) return rate;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double middle = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
  find(rate, asked, 100.0 * middle);
  return rate;
}

/// Share of the held-out gap's square, beyond the noise, that the named effect takes away; below any where
/// the test held out can no longer be predicted with it.
double closed(const Record& r) {
  if (!std::isfinite(r.held_out_after)) return -std::numeric_limits<double>::infinity();
  return (r.held_out_before * r.held_out_before - r.held_out_after * r.held_out_after) /
         (r.held_out_before * r.held_out_before - 1.0);
}

void add_table(std::string& page, const std::vector<std::string>& head,
               const std::vector<std::vector<std::string>>& rows) {
  const auto line = [&](const std::vector<std::string>& cells) {
    page += '|';
    for (const std::string& cell : cells) page += " " + cell + " |";
    page += '\n';
  };
  line(head);
  page += '|';
  for (std::size_t k = 0; k < head.size(); ++k) page += "---|";
  page += '\n';
  for (const auto& row : rows) line(row);
  page += '\n';
}

/// Hidden against outcome, of the records that `of` takes.
void add_confusion(std::string& page, const std::vector<Record>& records, const std::string& title,
                   const Test& of) {
  std::map<std::string, std::map<std::string, int>> counts;
  std::map<std::string, int> outcomes;
  for (const Record& r : records) {
    if (!of(r)) continue;
    const std::string outcome = outcome_of(r);
    ++counts[joined(r.hidden)][outcome];
    ++outcomes[outcome];
  }
  if (counts.empty()) return;
  page += "### " + title + "\n\n";
  std::vector<std::string> head{"hidden"};
  for (const auto& [outcome, number] : outcomes) head.push_back(outcome);
  std::vector<std::vector<std::string>> rows;
  for (auto& [hidden, row] : counts) {
    rows.push_back({hidden});
    for (const auto& [outcome, number] : outcomes) {
      rows.back().push_back(row[outcome] == 0 ? "" : std::to_string(row[outcome]));
    }
  }
  add_table(page, head, rows);
}

/// What is asked and not met, in one sentence, and that a part of the plan is no more than that.
void add_shortfalls(std::string& page, const std::vector<Rate>& rates, std::size_t made,
                    std::size_t planned) {
  std::vector<std::string> missed;
  for (const Rate& rate : rates) {
    if (rate.met && !*rate.met) {
      missed.push_back(fmt::format("{} ({}, asked {})", rate.what, rate.found, rate.asked));
    }
  }
  page += missed.empty() ? std::string("Nothing that is asked is missed.")
                         : fmt::format("Falls short: {}.", fmt::join(missed, "; "));
  if (made < planned) {
    page += fmt::format(
        " {:.0f} % of the plan was run: a rate from few studies may lie anywhere in its interval.",
        100.0 * static_cast<double>(made) / static_cast<double>(planned));
  }
  page += "\n\n";
}

void add_cells(std::string& page, const std::vector<Record>& records) {
  struct Count {
    int right = 0, wrong = 0, all = 0;
  };
  std::map<std::tuple<std::string, double, double>, Count> cells;
  for (const Record& r : records) {
    if (!done(r) || r.kind != "effect") continue;
    Count& cell = cells[{r.programme, r.wanted, r.noise}];
    ++cell.all;
    if (is_right(r)) ++cell.right;
    if (is_named(r) && !is_right(r)) ++cell.wrong;
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
    if (!done(r) || r.kind != "effect" || r.first != r.hidden || is_named(r)) continue;
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

std::string outcome_of(const Record& record) {
  if (!done(record)) return record.state;
  return is_named(record) ? joined(record.named) : record.verdict;
}

std::vector<Rate> rates_of(const std::vector<Record>& records) {
  const auto kind = [](const char* name) { return [name](const Record& r) { return r.kind == name; }; };
  const auto rich = [](const char* name, double visibility) {
    return [name, visibility](const Record& r) {
      return r.kind == name && r.programme == "rich" && (visibility == 0.0 || r.wanted == visibility);
    };
  };
  const Test wrong = [](const Record& r) { return is_named(r) && !is_right(r); };
  const Test unknown = [](const Record& r) { return r.verdict == "unknown"; };
  const auto judged = [](const Record& r) {
    return done(r) && is_named(r) && r.kind != "null" && r.held_out_before >= kLeastBefore;
  };
  const auto measured = [](const Record& r) {
    return r.kind == "effect" && is_right(r) && r.wanted >= 10.0 && std::isfinite(r.amplitude);
  };
  std::vector<double> shares;
  std::vector<double> errors;
  for (const Record& r : records) {
    if (judged(r)) shares.push_back(closed(r));
    if (done(r) && measured(r)) {
      errors.push_back(std::abs(r.amplitude / r.true_amplitudes.front() - 1.0));
    }
  }
  std::vector<Rate> rates{
      count(records, "nulls given a name", {.most = 1.0}, kind("null"), is_named),
      count(records, "wrong name, effect in catalogue", {.most = 2.0}, kind("effect"), wrong),
      count(records, "right name, rich protocol, signal to noise 30", {.least = 95.0}, rich("effect", 30.0),
            is_right),
      count(records, "right name, rich protocol, signal to noise 10", {.least = 75.0}, rich("effect", 10.0),
            is_right),
      count(records, "outside the catalogue called unknown, rich protocol", {.least = 85.0},
            rich("outside", 0.0), unknown),
      count(records, "so, given a name", {}, rich("outside", 0.0), is_named),
      count(
          records, "so, called unknown where 5 sigma are left beside the best effect", {},
          [&](const Record& r) { return rich("outside", 0.0)(r) && r.beside >= kLeastBeside; }, unknown),
      count(
          records, "hidden effect deleted, called unknown, rich protocol, 5 sigma left", {.least = 75.0},
          [&](const Record& r) { return rich("deleted", 0.0)(r) && r.beside >= kLeastBeside; }, unknown),
      count(
          records, "so, given a name", {},
          [&](const Record& r) { return rich("deleted", 0.0)(r) && r.beside >= kLeastBeside; }, is_named),
      median(shares, "held-out gap closed when named, median", {.least = 90.0}),
      count(records, "held-out gap grown when named", {.most = 5.0}, judged,
            [](const Record& r) { return closed(r) < 0.0; }),
      median(errors, "error of the named amplitude, signal to noise 10 and more, median", {.most = 15.0}),
      count(records, "its 90 % interval covers the truth", {.least = 84.0, .most = 96.0}, measured,
            [](const Record& r) {
              return r.lower <= r.true_amplitudes.front() && r.true_amplitudes.front() <= r.upper;
            }),
      count(
          records, "place ranked first, where the base is rejected", {.least = 85.0},
          [](const Record& r) { return r.place && r.kind != "null" && r.verdict != "adequate"; },
          [](const Record& r) { return *r.place; }),
      count(records, "two effects at once: both named", {}, kind("pair"), is_right),
      count(records, "two effects at once: named otherwise", {}, kind("pair"), wrong),
      count(
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

std::string rates_csv(const std::vector<Rate>& rates) {
  std::string csv = "what,asked,found,interval_95,counted\n";
  for (const Rate& rate : rates) {
    csv +=
        fmt::format("\"{}\",{},{},{},{}\n", rate.what, rate.asked, rate.found, rate.interval, rate.counted);
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
  std::vector<std::vector<std::string>> rows;
  for (const Rate& rate : rates_of(records)) {
    const std::string met = !rate.met ? "" : *rate.met ? "yes" : "no";
    rows.push_back({rate.what, rate.asked, rate.found, rate.interval, rate.counted, met});
  }
  add_table(page, {"what", "asked", "found", "95 % interval", "counted", "met"}, rows);
  add_shortfalls(page, rates_of(records), records.size(), planned);
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
