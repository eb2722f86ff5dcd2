// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/results_table.hpp"

#include <fmt/format.h>

#include <map>

namespace isotach::bench {

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

void add_rates(std::string& page, const std::vector<Rate>& rates, std::size_t made, std::size_t planned) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> missed;
  for (const Rate& rate : rates) {
    const std::string met = !rate.met ? "" : *rate.met ? "yes" : "no";
    rows.push_back({rate.what, rate.asked, rate.found, rate.interval, rate.counted, met});
    if (rate.met && !*rate.met) {
      missed.push_back(fmt::format("{} ({}, asked {})", rate.what, rate.found, rate.asked));
    }
  }
  add_table(page, {"what", "asked", "found", "95 % interval", "counted", "met"}, rows);
  page += missed.empty() ? std::string("Nothing that is asked is missed.")
                         : fmt::format("Falls short: {}.", fmt::join(missed, "; "));
  if (made < planned) {
    page += fmt::format(
        " {:.0f} % of the plan was run: a rate from few studies may lie anywhere in its interval.",
        100.0 * static_cast<double>(made) / static_cast<double>(planned));
  }
  page += "\n\n";
}

void add_confusion(std::string& page, const std::vector<Record>& records, const std::string& title,
                   const RecordTest& of) {
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

}  // namespace isotach::bench
