// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "bench/discovery/run_case.hpp"

#include <algorithm>
#include <chrono>

#include "bench/discovery/caught.hpp"
#include "bench/discovery/made_study.hpp"
#include "bench/discovery/note_answer.hpp"
#include "bench/discovery/rate.hpp"
#include "discovery/discover.hpp"

namespace isotach::bench {

namespace {

/// Whether, of the fitted stages where discovery finds the base to disagree, the first is the one where what
/// the base cannot take up of the hidden is largest.
std::optional<bool> place_is_right(const MadeStudy& made, const discovery::Discovery& found) {
  double largest = -1.0;
  std::optional<bool> first;
  bool right = false;
  for (const discovery::Disagreement& place : found.disagreement) {
    if (place.held_out) continue;
    double sum = 0.0;
    std::size_t fitted = 0;
    for (const datasets::OedometerTest& test : made.study.oedometer_tests) {
      if (test.hold_out) continue;
      const Eigen::VectorXd& left = made.left.plain[fitted++];
      if (test.name != place.test) continue;
      for (Eigen::Index i = 0; i < left.size(); ++i) {
        const double time = test.record.rows[static_cast<std::size_t>(i)].time;
        if (time >= place.stage.from_time && time <= place.stage.to_time) sum += left[i] * left[i];
      }
    }
    const bool is_first = !first;
    first = true;
    if (sum > largest) {
      largest = sum;
      right = is_first;
    }
  }
  return first ? std::optional(right) : std::nullopt;
}

void note_amplitude(const datasets::Study& study, const discovery::Candidate& named, Record& record) {
  constexpr double kLevel = 0.9;
  const discovery::AmplitudeInterval interval =
      discovery::amplitude_intervals(study, named, kLevel, 1, {}).front();
  record.amplitude = interval.value;
  record.lower = interval.lower;
  record.upper = interval.upper;
}

}  // namespace

Record run_case(const Case& one, std::uint64_t seed) {
  Record record = blank_record(one.number, seed);
  record.kind = name_of(one.kind);
  for (const effects::Effect* effect : one.effects) record.hidden.emplace_back(effect->name);
  if (one.outside) record.hidden.emplace_back(info_of(*one.outside).name);
  std::sort(record.hidden.begin(), record.hidden.end());
  record.programme = name_of(one.programme);
  record.noise = one.noise;
  record.wanted = one.visibility;
  const auto made = make_study(one, seed);
  if (!made) {
    record.state = "failed";
    record.why = "making: " + made.error();
    return record;
  }
  record.visibility = made->visibility;
  record.beside = made->beside_another;
  for (const auto& effect : made->hidden.effects) record.true_amplitudes.push_back(effect.si[0]);
  if (made->hidden.outside) record.true_amplitudes.push_back(made->hidden.outside->amplitude);
  if (!made->reached) {
    record.state = "out of reach";
    return record;
  }
  discovery::DiscoverOptions options;
  if (one.kind == Kind::deleted) options.without = one.effects;
  const auto begin = std::chrono::steady_clock::now();
  const auto found = caught([&] { return discovery::discover_oedometer(made->study, options); });
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  record.state = found ? "done" : "failed";
  if (found) {
    note_answer(*found, record);
    if (one.kind != Kind::null) record.place = place_is_right(*made, *found);
    if (one.kind == Kind::effect && found->chosen && is_right(record)) {
      note_amplitude(made->study, found->trials[*found->chosen].candidate, record);
    }
  } else {
    record.why = found.error().message;
  }
  return record;
}

}  // namespace isotach::bench
