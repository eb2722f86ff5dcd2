// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/discovery/wilson.hpp"

namespace isotach::bench {

namespace {

void find(Rate& rate, const Asked& asked, double percent) {
  rate.found = fmt::format("{:.1f} %", percent);
  if (asked.anything()) rate.met = asked.met_by(percent);
}

}  // namespace

bool is_done(const Record& record) {
  return record.state == "done";
}
bool is_named(const Record& record) {
  return !record.named.empty();
}
bool is_right(const Record& record) {
  return record.named == record.hidden;
}
bool is_wrong(const Record& record) {
  return is_named(record) && !is_right(record);
}
bool set_holds_hidden(const Record& record) {
  return std::find(record.equivalent.begin(), record.equivalent.end(), record.hidden) !=
         record.equivalent.end();
}

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, " + "));
}

std::string outcome_of(const Record& record) {
  if (!is_done(record)) return record.state;
  return is_named(record) ? joined(record.named) : record.verdict;
}

std::string Asked::words() const {
  if (!anything()) return "";
  if (least == 0.0) return fmt::format("at most {:g} %", most);
  if (most == 100.0) return fmt::format("{:g} %", least);
  return fmt::format("{:g} to {:g} %", least, most);
}

Rate share(const std::vector<Record>& records, std::string what, const Asked& asked, const RecordTest& of,
           const RecordTest& hit) {
  std::size_t all = 0;
  std::size_t hits = 0;
  for (const Record& r : records) {
    if (!is_done(r) || !of(r)) continue;
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

Rate amplitude_error(const std::vector<Record>& records, std::string what, const Asked& asked,
                     const RecordTest& of) {
  std::vector<double> errors;
  for (const Record& r : records) {
    if (!is_done(r) || !of(r) || !std::isfinite(r.amplitude)) continue;
    errors.push_back(std::abs(r.amplitude / r.true_amplitudes.front() - 1.0));
  }
  return median(std::move(errors), std::move(what), asked);
}

std::string rates_csv(const std::vector<Rate>& rates) {
  std::string csv = "what,asked,found,interval_95,counted\n";
  for (const Rate& rate : rates) {
    csv +=
        fmt::format("\"{}\",{},{},{},{}\n", rate.what, rate.asked, rate.found, rate.interval, rate.counted);
  }
  return csv;
}

}  // namespace isotach::bench
